#include "perimorph/mesh/pre_crack.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <map>
#include <numeric>

#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/sorted_sides.hpp"

namespace perimorph::mesh {

namespace {

constexpr double relative_tolerance = 1e-6;  // of a side's length

template <int dim>
using Points = std::vector<Point<dim>>;

/// Distance from a point to a simplex (point, segment or triangle): to its foot on the simplex' plane if that lies
/// inside, otherwise to the nearest of the simplex' own sides.
template <int dim>
double distance(const Point<dim>& point, const Points<dim>& simplex) {
  const int n_edges = static_cast<int>(simplex.size()) - 1;
  if (n_edges == 0) return (point - simplex[0]).norm();
  Eigen::MatrixXd edges(dim, n_edges);
  for (int e = 0; e < n_edges; ++e) edges.col(e) = simplex[e + 1] - simplex[0];
  const Eigen::VectorXd weights = edges.colPivHouseholderQr().solve(point - simplex[0]);
  if (weights.minCoeff() >= 0. && weights.sum() <= 1.) return (point - simplex[0] - edges * weights).norm();

  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t left_out = 0; left_out < simplex.size(); ++left_out) {
    Points<dim> side = simplex;
    side.erase(side.begin() + static_cast<long>(left_out));
    nearest = std::min(nearest, distance<dim>(point, side));
  }
  return nearest;
}

template <int dim>
bool are_finite(const std::vector<CrackFacet<dim>>& facets) {
  return std::all_of(facets.begin(), facets.end(), [](const CrackFacet<dim>& facet) {
    return std::all_of(facet.begin(), facet.end(), [](const auto& corner) { return corner.allFinite(); });
  });
}

/// A pre-crack that can be asked whether a side of an element lies on it.
template <int dim>
class Crack {
 public:
  explicit Crack(const std::vector<CrackFacet<dim>>& facets) {
    for (const auto& facet : facets) {
      facets_.emplace_back(facet.begin(), facet.end());
      for (const auto& corner : facet) box_.extend(corner);
    }
  }

  /// Corners and centre are tested: the corners alone could lie on the two arms of a kink.
  bool contains_side(const Points<dim>& corners) const {
    const double tolerance = relative_tolerance * (corners[1] - corners[0]).norm();
    Point<dim> sum = Point<dim>::Zero();
    for (const auto& corner : corners) {
      if (!contains(corner, tolerance)) return false;
      sum += corner;
    }
    return contains(sum / static_cast<double>(corners.size()), tolerance);
  }

 private:
  bool contains(const Point<dim>& point, double tolerance) const {
    if (box_.squaredExteriorDistance(point) > tolerance * tolerance) return false;
    return std::any_of(facets_.begin(), facets_.end(),
                       [&](const auto& facet) { return distance<dim>(point, facet) <= tolerance; });
  }

  std::vector<Points<dim>> facets_;
  Eigen::AlignedBox<double, dim> box_;
};

/// A side that two elements share.
struct InnerSide {
  SideKey nodes;
  Side lower, upper;
  bool on_crack;

  bool contains(int node) const { return std::find(nodes.begin(), nodes.end(), node) != nodes.end(); }
};

template <int dim>
std::vector<InnerSide> inner_sides(const Mesh<dim>& mesh, const Crack<dim>& crack) {
  const std::vector<KeyedSide> all = sorted_sides(mesh);
  std::vector<InnerSide> inner;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    if (all[i].key != all[i + 1].key) continue;
    inner.push_back({all[i].key, all[i].side, all[i + 1].side, crack.contains_side(corner_points(mesh, all[i].side))});
  }
  return inner;
}

/// The elements around one node, and which of them are connected by sides through that node.
class Fan {
 public:
  void add(int element) { group_of_[element] = element; }

  void connect(int a, int b) {
    const int lower = std::min(group_of_.at(a), group_of_.at(b)), upper = std::max(group_of_.at(a), group_of_.at(b));
    for (auto& [element, group] : group_of_) {
      if (group == upper) group = lower;
    }
  }

  /// Lists of connected elements, by ascending lowest element.
  std::vector<std::vector<int>> groups() const {
    std::map<int, std::vector<int>> lists;
    for (const auto& [element, group] : group_of_) lists[group].push_back(element);
    std::vector<std::vector<int>> ordered;
    for (const auto& [lowest, elements] : lists) ordered.push_back(elements);
    return ordered;
  }

 private:
  std::map<int, int> group_of_;  // each element's group, named by its lowest element
};

/// The fan of every node on a crack's sides.
template <int dim>
std::map<int, Fan> fans_along_crack(const Mesh<dim>& mesh, const std::vector<InnerSide>& inner) {
  std::map<int, Fan> fans;
  for (const auto& side : inner) {
    if (!side.on_crack) continue;
    for (const int node : side.nodes) {
      if (node >= 0) fans[node];
    }
  }
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int c = 0; c < mesh.n_corners(e); ++c) {
      if (const auto fan = fans.find(mesh.corners_of(e)[c]); fan != fans.end()) fan->second.add(e);
    }
  }
  for (const auto& side : inner) {
    if (side.on_crack) continue;
    for (const int node : side.nodes) {
      if (const auto fan = fans.find(node); fan != fans.end())
        fan->second.connect(side.lower.element, side.upper.element);
    }
  }
  return fans;
}

/// Appends a copy of a node and gives it to some of the elements around the old one.
template <int dim>
int double_node(Mesh<dim>& mesh, int node, const std::vector<int>& elements) {
  const int copy = mesh.n_nodes();
  const Point<dim> position = mesh.coordinates[node];
  mesh.coordinates.push_back(position);
  mesh.node_ids.push_back(copy);
  mesh.node_owners.push_back(mesh.rank);
  mesh.n_owned_nodes = copy + 1;
  mesh.n_global_nodes = copy + 1;
  for (const int e : elements) {
    const auto first = mesh.corners.begin() + mesh.first_corner[e];
    std::replace(first, first + mesh.n_corners(e), node, copy);
  }
  return copy;
}

/// Copies have the highest numbers: appending them keeps a set ascending once they are sorted.
void add_copies(std::vector<int>& node_set, const std::map<int, std::vector<int>>& copies) {
  std::vector<int> added;
  for (const int node : node_set) {
    if (const auto found = copies.find(node); found != copies.end()) {
      added.insert(added.end(), found->second.begin(), found->second.end());
    }
  }
  std::sort(added.begin(), added.end());
  node_set.insert(node_set.end(), added.begin(), added.end());
}

/// The two elements of an inner side no longer have all its nodes in common.
template <int dim>
bool is_open(const Mesh<dim>& mesh, const InnerSide& side) {
  return side_key(side_nodes(mesh, side.lower)) != side_key(side_nodes(mesh, side.upper));
}

}  // namespace

std::vector<CrackFacet<2>> polyline(const std::vector<Point<2>>& corners) {
  PERIMORPH_ASSERT(corners.size() >= 2, "a line through {} points", corners.size());
  std::vector<CrackFacet<2>> segments;
  for (std::size_t i = 1; i < corners.size(); ++i) segments.push_back({corners[i - 1], corners[i]});
  return segments;
}

std::vector<CrackFacet<3>> polygon(const std::vector<Point<3>>& corners) {
  PERIMORPH_ASSERT(corners.size() >= 3, "a polygon of {} corners", corners.size());
  std::vector<CrackFacet<3>> triangles;
  for (std::size_t i = 2; i < corners.size(); ++i) triangles.push_back({corners[0], corners[i - 1], corners[i]});
  return triangles;
}

std::vector<CrackFacet<3>> disc(const Point<3>& center, const Point<3>& normal, double radius) {
  constexpr int n_sides = 64;
  constexpr double pi = 3.14159265358979323846;
  PERIMORPH_ASSERT(radius > 0., "a disc of radius {}", radius);
  PERIMORPH_ASSERT(normal.norm() > 0., "a normal of length {}", normal.norm());
  const Point<3> across = normal.normalized().unitOrthogonal(), along = normal.normalized().cross(across);
  const double to_corner = radius / std::cos(pi / n_sides);
  const auto corner = [&](int i) -> Point<3> {
    const double angle = 2. * pi * (i % n_sides) / n_sides;
    return center + to_corner * (std::cos(angle) * across + std::sin(angle) * along);
  };
  std::vector<CrackFacet<3>> triangles;
  for (int i = 0; i < n_sides; ++i) triangles.push_back({center, corner(i), corner(i + 1)});
  return triangles;
}

template <int dim>
int open_along(Mesh<dim>& whole, const std::vector<CrackFacet<dim>>& crack) {
  PERIMORPH_ASSERT(whole.is_whole(), "{} of {} elements are here", whole.n_elements(), whole.n_global_elements);
  PERIMORPH_ASSERT(are_finite<dim>(crack), "one of {} facets is nowhere", crack.size());
  const std::vector<InnerSide> inner = inner_sides(whole, Crack<dim>(crack));

  std::map<int, std::vector<int>> copies;
  for (const auto& [node, fan] : fans_along_crack(whole, inner)) {
    const std::vector<std::vector<int>> groups = fan.groups();
    for (std::size_t g = 1; g < groups.size(); ++g) copies[node].push_back(double_node(whole, node, groups[g]));
  }
  for (auto& [name, nodes] : whole.node_sets) add_copies(nodes, copies);
  int n_open = 0;
  for (const auto& side : inner) {
    if (!side.on_crack || !is_open(whole, side)) continue;
    whole.boundary.insert(whole.boundary.end(), {side.lower, side.upper});
    ++n_open;
  }
  std::sort(whole.boundary.begin(), whole.boundary.end());
  return n_open;
}

template int open_along<2>(Mesh<2>&, const std::vector<CrackFacet<2>>&);
template int open_along<3>(Mesh<3>&, const std::vector<CrackFacet<3>>&);

}  // namespace perimorph::mesh
