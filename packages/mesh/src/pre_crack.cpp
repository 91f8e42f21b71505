#include "perimorph/mesh/pre_crack.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Teuchos_DefaultSerialComm.hpp>
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/sorted_sides.hpp"
#include "pieces.hpp"

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
  /// @param element local; what is lowest is so by the id, whichever rank looks
  void add(int element, GlobalId id) {
    local_[id] = element;
    group_of_[id] = id;
  }

  void connect(GlobalId a, GlobalId b) {
    const GlobalId lower = std::min(group_of_.at(a), group_of_.at(b)),
                   upper = std::max(group_of_.at(a), group_of_.at(b));
    for (auto& [element, group] : group_of_) {
      if (group == upper) group = lower;
    }
  }

  /// Lists of connected local elements, by ascending lowest id.
  std::vector<std::vector<int>> groups() const {
    std::map<GlobalId, std::vector<int>> lists;
    for (const auto& [id, group] : group_of_) lists[group].push_back(local_.at(id));
    std::vector<std::vector<int>> ordered;
    for (const auto& [lowest, elements] : lists) ordered.push_back(elements);
    return ordered;
  }

 private:
  std::map<GlobalId, int> local_;
  std::map<GlobalId, GlobalId> group_of_;  // each element's group, named by its lowest element
};

/// The fan of every node on a crack's sides that the part owns: it has all elements around these.
template <int dim>
std::map<int, Fan> fans_along_crack(const Mesh<dim>& part, const std::vector<InnerSide>& inner) {
  std::map<int, Fan> fans;
  for (const auto& side : inner) {
    if (!side.on_crack) continue;
    for (const int node : side.nodes) {
      if (node >= 0 && node < part.n_owned_nodes) fans[node];
    }
  }
  for (int e = 0; e < part.n_elements(); ++e) {
    for (int c = 0; c < part.n_corners(e); ++c) {
      if (const auto fan = fans.find(part.corners_of(e)[c]); fan != fans.end()) fan->second.add(e, part.element_ids[e]);
    }
  }
  for (const auto& side : inner) {
    if (side.on_crack) continue;
    for (const int node : side.nodes) {
      if (const auto fan = fans.find(node); fan != fans.end()) {
        fan->second.connect(part.element_ids[side.lower.element], part.element_ids[side.upper.element]);
      }
    }
  }
  return fans;
}

/// How many copies a node gets.
struct Copies {
  GlobalId node, n;
};

/// An element gets a copy of a node in place of it.
struct Replacement {
  GlobalId element, copy;
  int corner;
};

/// A side that has become one of the boundary.
struct OpenSide {
  GlobalId element;
  int side;
  int is_lower;  ///< of the two elements that had it, this is the one with the lower id
};

/// What a rank finds out about the nodes that it owns, for the owners of the elements around them.
struct Changes {
  std::vector<std::vector<Replacement>> replacements;  ///< per rank
  std::vector<std::vector<OpenSide>> sides;            ///< per rank
};

/// The number of the first copy of each node that is doubled, beyond all nodes of the whole, by ascending node; and how
/// many copies there are. Collective.
std::pair<std::map<GlobalId, GlobalId>, GlobalId> numbers_of_copies(const base::Comm& comm,
                                                                    const std::vector<Copies>& own,
                                                                    GlobalId n_global_nodes) {
  std::map<GlobalId, GlobalId> first;
  for (const auto& [node, n] : base::gather_on_all(comm, own)) first[node] = n;
  GlobalId next = n_global_nodes;
  for (auto& [node, number] : first) next += std::exchange(number, next);
  return {std::move(first), next - n_global_nodes};
}

template <int dim>
Changes changes_along(const Mesh<dim>& part, const std::vector<InnerSide>& inner, const std::map<int, Fan>& fans,
                      const std::map<GlobalId, GlobalId>& first_copies, int n_ranks) {
  Changes changes{std::vector<std::vector<Replacement>>(n_ranks), std::vector<std::vector<OpenSide>>(n_ranks)};
  std::map<int, std::map<int, GlobalId>> copy_for;  // by node and element, where it is another than the node
  for (const auto& [node, fan] : fans) {
    const auto groups = fan.groups();
    for (std::size_t g = 1; g < groups.size(); ++g) {
      const GlobalId copy = first_copies.at(part.node_ids[node]) + static_cast<GlobalId>(g) - 1;
      for (const int e : groups[g]) {
        const int* corners = part.corners_of(e);
        const auto corner = static_cast<int>(std::find(corners, corners + part.n_corners(e), node) - corners);
        changes.replacements[part.element_owners[e]].push_back({part.element_ids[e], copy, corner});
        copy_for[node][e] = copy;
      }
    }
  }
  const auto node_of = [&](int node, int element) {
    const auto around = copy_for.find(node);
    if (around == copy_for.end()) return part.node_ids[node];
    const auto copy = around->second.find(element);
    return copy == around->second.end() ? part.node_ids[node] : copy->second;
  };
  for (const auto& side : inner) {
    const bool opens = side.on_crack && std::any_of(side.nodes.begin(), side.nodes.end(), [&](int node) {
                         return node >= 0 && node_of(node, side.lower.element) != node_of(node, side.upper.element);
                       });
    if (!opens) continue;
    for (const Side& one : {side.lower, side.upper}) {
      const GlobalId other =
          part.element_ids[one.element == side.lower.element ? side.upper.element : side.lower.element];
      const GlobalId id = part.element_ids[one.element];
      changes.sides[part.element_owners[one.element]].push_back({id, one.side, static_cast<int>(id < other)});
    }
  }
  return changes;
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

/// Carries out on a rank's own elements what the owners of their nodes have found out; returns how many sides are open
/// of which the lower element is here. Copies have the highest numbers: appending them keeps lists ascending. Local.
template <int dim>
GlobalId apply(Mesh<dim>& part, const std::vector<std::vector<Replacement>>& replacements,
               const std::vector<std::vector<OpenSide>>& sides) {
  const auto local_element = [&](GlobalId id) {
    const auto begin = part.element_ids.begin(), end = begin + part.n_owned_elements;
    return static_cast<int>(std::lower_bound(begin, end, id) - begin);
  };
  std::map<GlobalId, std::pair<int, std::vector<int*>>> corners_of_copy;  // and the node of which it is one
  for (const auto& some : replacements) {
    for (const auto& [element, copy, corner] : some) {
      int* place = part.corners.data() + part.first_corner[local_element(element)] + corner;
      auto& [original, places] = corners_of_copy[copy];
      original = *place;
      places.push_back(place);
    }
  }
  std::map<int, std::vector<int>> copies;
  for (const auto& [copy, entry] : corners_of_copy) {
    const auto& [original, places] = entry;
    for (int* place : places) *place = part.n_nodes();
    copies[original].push_back(part.n_nodes());
    part.coordinates.push_back(Point<dim>(part.coordinates[original]));
    part.node_ids.push_back(copy);
    part.node_owners.push_back(part.rank);
  }
  for (auto& [name, nodes] : part.node_sets) add_copies(nodes, copies);
  GlobalId n_open = 0;
  std::set<std::pair<GlobalId, int>> open;
  for (const auto& some : sides) {
    for (const auto& [element, side, is_lower] : some) {
      if (!open.insert({element, side}).second) continue;
      part.boundary.push_back({local_element(element), side});
      n_open += is_lower;
    }
  }
  std::sort(part.boundary.begin(), part.boundary.end());
  return n_open;
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
GlobalId open_along(const base::Comm& comm, Mesh<dim>& part, const std::vector<CrackFacet<dim>>& crack) {
  PERIMORPH_ASSERT(are_finite<dim>(crack), "one of {} facets is nowhere", crack.size());
  PERIMORPH_ASSERT(part.hanging_nodes.empty() || part.is_whole(), "{} hanging nodes of a part",
                   part.hanging_nodes.size());
  Mesh<dim> nothing;
  auto& mesh = part.rank == comm.getRank() ? part : nothing;
  std::vector<InnerSide> inner;
  std::map<int, Fan> fans;
  std::vector<Copies> doubled;
  base::on_all_ranks(comm, [&] {
    inner = inner_sides(mesh, Crack<dim>(crack));
    fans = fans_along_crack(mesh, inner);
    for (const auto& [node, fan] : fans) {
      const auto n_groups = static_cast<GlobalId>(fan.groups().size());
      if (n_groups > 1) doubled.push_back({mesh.node_ids[node], n_groups - 1});
    }
  });
  const auto [first_copies, n_copies] = numbers_of_copies(comm, doubled, base::max(comm, mesh.n_global_nodes));
  const auto changes = changes_along(mesh, inner, fans, first_copies, comm.getSize());
  const auto replacements = base::exchange(comm, changes.replacements);
  const auto open_sides = base::exchange(comm, changes.sides);
  const bool has_all = mesh.n_owned_elements == mesh.n_global_elements;
  const GlobalId n_open = apply(mesh, replacements, open_sides);
  mesh.n_global_nodes += n_copies;
  if (has_all) {
    mesh.n_owned_nodes = mesh.n_nodes();
  } else {
    mesh = own_elements(mesh);
  }
  return base::sum(comm, n_open);
}

template <int dim>
int open_along(Mesh<dim>& whole, const std::vector<CrackFacet<dim>>& crack) {
  PERIMORPH_ASSERT(whole.is_whole(), "{} of {} elements are here", whole.n_elements(), whole.n_global_elements);
  return static_cast<int>(open_along<dim>(Teuchos::SerialComm<int>(), whole, crack));
}

template GlobalId open_along<2>(const base::Comm&, Mesh<2>&, const std::vector<CrackFacet<2>>&);
template GlobalId open_along<3>(const base::Comm&, Mesh<3>&, const std::vector<CrackFacet<3>>&);
template int open_along<2>(Mesh<2>&, const std::vector<CrackFacet<2>>&);
template int open_along<3>(Mesh<3>&, const std::vector<CrackFacet<3>>&);

}  // namespace perimorph::mesh
