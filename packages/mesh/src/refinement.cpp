#include "perimorph/mesh/refinement.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "division.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/perturbation.hpp"
#include "perimorph/mesh/sorted_sides.hpp"

namespace perimorph::mesh {

namespace {

constexpr int bits_per_level = 4;

/// Their order is that of a walk down the tree.
std::pair<int, std::uint64_t> place_in_order(const ElementPath& path) {
  return {path.root, path.children << bits_per_level * (max_levels - path.level)};
}

bool leads_through(const ElementPath& path, const ElementPath& ancestor) {
  return path.root == ancestor.root && path.level >= ancestor.level &&
         path.children >> bits_per_level * (path.level - ancestor.level) == ancestor.children;
}

/// An element of the tree.
struct Cell {
  ElementPath path;
  std::array<int, max_corners> corners;  ///< nodes
  std::array<int, 6> sides;              ///< those of the root element that they lie on, or -1
};

struct HashOfKey {
  std::size_t operator()(const SideKey& key) const {
    std::uint64_t hash = 0;
    for (const int node : key) hash = (hash ^ static_cast<std::uint32_t>(node)) * 0x9E3779B97F4A7C15u;
    return hash ^ hash >> 32u;
  }
};

/// The elements of a refined mesh as they are divided.
template <int dim>
class Tree {
 public:
  explicit Tree(const Mesh<dim>& root) : root_(root), coordinates_(root.coordinates) {}

  void divide_by(const LevelRule<dim>& level_at) {
    for (int e = 0; e < root_.n_elements(); ++e) {
      Cell cell{{e, 0, 0}, {}, {}};
      std::copy_n(root_.corners_of(e), root_.n_corners(e), cell.corners.begin());
      std::iota(cell.sides.begin(), cell.sides.end(), 0);
      divide_by(level_at, mean_edge(cell), cell);
    }
  }

  /// Divides until no element has a node at which there are elements that are smaller by two levels.
  void balance() {
    std::vector<Cell> to_divide;
    do {
      find_levels_at_nodes();
      const auto first =
          std::stable_partition(leaves_.begin(), leaves_.end(), [&](const Cell& cell) { return !is_too_large(cell); });
      to_divide.assign(first, leaves_.end());
      leaves_.erase(first, leaves_.end());
      for (const Cell& cell : to_divide) divide(cell, [&](const Cell& child) { leaves_.push_back(child); });
    } while (!to_divide.empty());
  }

  RefinedMesh<dim> mesh() {
    std::sort(leaves_.begin(), leaves_.end(),
              [](const Cell& a, const Cell& b) { return place_in_order(a.path) < place_in_order(b.path); });
    number_nodes();
    RefinedMesh<dim> refined;
    auto& mesh = refined.mesh;
    mesh.block_names = root_.block_names;
    mesh.notes = root_.notes;
    add_nodes(mesh);
    for (const Cell& cell : leaves_) {
      add_element(mesh, cell);
      refined.paths.push_back(cell.path);
    }
    mesh.n_owned_elements = mesh.n_elements();
    mesh.n_global_elements = mesh.n_elements();
    for (const auto& [name, sides] : root_.side_sets) mesh.side_sets[name] = sides_on(sides);
    mesh.boundary = sides_on(root_.boundary);
    for (const auto& [name, nodes] : root_.node_sets) mesh.node_sets[name] = nodes_in(mesh, name, nodes);
    mesh.hanging_nodes = hanging_nodes();
    refined.node_keys = keys();
    return refined;
  }

 private:
  const Mesh<dim>& root_;
  std::vector<Cell> leaves_;
  std::vector<Point<dim>> coordinates_;                  ///< of nodes: the root's, and others as they came
  std::vector<std::vector<int>> parents_;                ///< of these others, nodes
  std::unordered_map<SideKey, int, HashOfKey> middles_;  ///< nodes, of edges and faces
  std::vector<int> levels_at_nodes_;                     ///< largest of the leaves
  int deepest_ = 0;                                      ///< the largest of these
  std::vector<int> numbers_;                             ///< of nodes in the mesh

  ElementType type_of(const Cell& cell) const { return root_.types[cell.path.root]; }
  int n_corners_of(const Cell& cell) const { return n_corners(type_of(cell)); }

  std::vector<int> nodes_of(const Cell& cell, const std::vector<int>& corners) const {
    std::vector<int> nodes;
    for (const int corner : corners) nodes.push_back(cell.corners[corner]);
    return nodes;
  }

  Point<dim> mean(const std::vector<int>& nodes) const {
    Point<dim> sum = Point<dim>::Zero();
    for (const int node : nodes) sum += coordinates_[node];
    return sum / static_cast<double>(nodes.size());
  }

  double length(int one, int other) const { return (coordinates_[one] - coordinates_[other]).norm(); }

  double mean_edge(const Cell& cell) const {
    const auto& all = edges(type_of(cell));
    double sum = 0.;
    for (const auto& edge : all) sum += length(cell.corners[edge[0]], cell.corners[edge[1]]);
    return sum / static_cast<double>(all.size());
  }

  void divide_by(const LevelRule<dim>& level_at, double root_edge, const Cell& cell) {
    const std::vector<int> corners(cell.corners.begin(), cell.corners.begin() + n_corners_of(cell));
    const auto centroid = mean(corners);
    double radius = 0.;
    for (const int node : corners) radius = std::max(radius, (coordinates_[node] - centroid).norm());
    if (cell.path.level >= std::min(max_levels, level_at(centroid, radius, root_edge))) {
      leaves_.push_back(cell);
      return;
    }
    divide(cell, [&](const Cell& child) { divide_by(level_at, root_edge, child); });
  }

  const Division& division(const Cell& cell) const {
    const Division* found = division_of(type_of(cell));
    if (found != nullptr) return *found;
    const auto x = centroid(root_, cell.path.root);
    throw base::UserError(
        fmt::format("the {} at ({:.6g}) would have to be divided, where cracks are or may come; allowed are triangles, "
                    "quadrilaterals, tetrahedra and hexahedra there",
                    exodus_name(type_of(cell)), fmt::join(x.begin(), x.end(), ", ")));
  }

  /// Of a tetrahedron the shortest diagonal, so that its children are as well shaped as they can be.
  int diagonal_of(const Division& division, const std::vector<int>& nodes) const {
    const auto& all = division.diagonals;
    if (all.empty()) return 0;
    const auto shortest = std::min_element(all.begin(), all.end(), [&](const auto& a, const auto& b) {
      return length(nodes[a[0]], nodes[a[1]]) < length(nodes[b[0]], nodes[b[1]]);
    });
    return static_cast<int>(shortest - all.begin());
  }

  /// Calls visit(child) for each.
  template <class Visit>
  void divide(const Cell& cell, Visit visit) {
    const Division& division = this->division(cell);
    std::vector<int> nodes;
    for (const auto& corners : division.nodes) nodes.push_back(middle_of(nodes_of(cell, corners)));
    for (const int place : division.children_around(diagonal_of(division, nodes))) {
      const auto& [root, level, children] = cell.path;
      Cell child{{root, level + 1, children << bits_per_level | static_cast<unsigned>(place)}, {}, {}};
      const auto& corners = division.children[place];
      std::transform(corners.begin(), corners.end(), child.corners.begin(), [&](int node) { return nodes[node]; });
      const auto& sides = division.sides[place];
      std::transform(sides.begin(), sides.end(), child.sides.begin(),
                     [&](int side) { return side < 0 ? -1 : cell.sides[side]; });
      visit(child);
    }
  }

  /// Itself, of an edge, of a face, or of an element.
  int middle_of(std::vector<int> nodes) {
    if (nodes.size() == 1) return nodes[0];
    std::sort(nodes.begin(), nodes.end());  // so that it is rounded alike from all sides
    const int next = static_cast<int>(coordinates_.size());
    if (nodes.size() <= std::tuple_size<SideKey>()) {
      const auto [found, is_new] = middles_.try_emplace(side_key(nodes), next);
      if (!is_new) return found->second;
    }
    coordinates_.push_back(mean(nodes));
    parents_.push_back(std::move(nodes));
    return next;
  }

  /// Calls visit(node, its parents) for the middles of a leaf's edges and faces that smaller elements have.
  template <class Visit>
  void visit_middles(const Cell& cell, Visit visit) const {
    const auto look_up = [&](const std::vector<int>& corners) {
      const auto nodes = nodes_of(cell, corners);
      const auto found = middles_.find(side_key(nodes));
      if (found != middles_.end()) visit(found->second, nodes);
    };
    for (const auto& edge : edges(type_of(cell))) look_up(edge);
    for (const auto& side : sides(type_of(cell))) {
      if (side.size() == 4) look_up(side);
    }
  }

  void find_levels_at_nodes() {
    levels_at_nodes_.assign(coordinates_.size(), 0);
    for (const Cell& cell : leaves_) {
      for (int k = 0; k < n_corners_of(cell); ++k) {
        int& level = levels_at_nodes_[cell.corners[k]];
        level = std::max(level, cell.path.level);
      }
      deepest_ = std::max(deepest_, cell.path.level);
    }
  }

  bool is_too_large(const Cell& cell) const {
    const int largest = cell.path.level + 1;
    if (deepest_ <= largest) return false;
    bool is_so = std::any_of(cell.corners.begin(), cell.corners.begin() + n_corners_of(cell),
                             [&](int node) { return levels_at_nodes_[node] > largest; });
    visit_middles(cell, [&](int node, const auto&) { is_so = is_so || levels_at_nodes_[node] > largest; });
    return is_so;
  }

  /// Those of the root as they are there, others as the elements have them.
  void number_nodes() {
    numbers_.assign(coordinates_.size(), -1);
    int next = root_.n_nodes();
    std::iota(numbers_.begin(), numbers_.begin() + next, 0);
    for (const Cell& cell : leaves_) {
      for (int k = 0; k < n_corners_of(cell); ++k) {
        int& number = numbers_[cell.corners[k]];
        if (number < 0) number = next++;
      }
    }
    PERIMORPH_ASSERT(next == static_cast<int>(coordinates_.size()), "{} nodes, {} of them at elements",
                     coordinates_.size(), next);
  }

  void add_nodes(Mesh<dim>& mesh) const {
    const auto n = static_cast<int>(coordinates_.size());
    mesh.coordinates.resize(n);
    for (int node = 0; node < n; ++node) mesh.coordinates[numbers_[node]] = coordinates_[node];
    mesh.node_ids.resize(n);
    std::iota(mesh.node_ids.begin(), mesh.node_ids.end(), 0);
    mesh.node_owners.assign(n, 0);
    mesh.n_owned_nodes = n;
    mesh.n_global_nodes = n;
  }

  /// Those of the root's nodes are their own; others' follow from their parents'.
  std::vector<std::uint64_t> keys() const {
    auto by_creation = node_keys(root_.n_nodes());
    for (const auto& parents : parents_) {
      std::uint64_t sum = parents.size();
      for (const int parent : parents) sum += 31 * by_creation[parent];  // in any order
      by_creation.push_back(sum);
    }
    std::vector<std::uint64_t> all(by_creation.size());
    for (std::size_t node = 0; node < all.size(); ++node) all[numbers_[node]] = by_creation[node];
    return all;
  }

  void add_element(Mesh<dim>& mesh, const Cell& cell) const {
    mesh.types.push_back(type_of(cell));
    mesh.blocks.push_back(root_.blocks[cell.path.root]);
    mesh.element_ids.push_back(static_cast<GlobalId>(mesh.element_ids.size()));
    mesh.element_owners.push_back(0);
    for (int k = 0; k < n_corners_of(cell); ++k) mesh.corners.push_back(numbers_[cell.corners[k]]);
    mesh.first_corner.push_back(static_cast<int>(mesh.corners.size()));
  }

  /// What has become of some of the root's sides.
  std::vector<Side> sides_on(const std::vector<Side>& sides_of_root) const {
    std::vector<unsigned> are_meant(root_.n_elements(), 0);  // bit by bit
    for (const auto& [element, side] : sides_of_root) are_meant[element] |= 1u << static_cast<unsigned>(side);
    std::vector<Side> found;
    for (std::size_t e = 0; e < leaves_.size(); ++e) {
      const auto n_sides = sides(type_of(leaves_[e])).size();
      for (std::size_t s = 0; s < n_sides; ++s) {
        const int side = leaves_[e].sides[s];
        if (side < 0 || (are_meant[leaves_[e].path.root] >> static_cast<unsigned>(side) & 1u) == 0) continue;
        found.push_back({static_cast<int>(e), static_cast<int>(s)});
      }
    }
    return found;
  }

  std::vector<int> nodes_in(const Mesh<dim>& mesh, const std::string& name, const std::vector<int>& of_root) const {
    std::vector<char> are_in(coordinates_.size(), 0);  // by number
    for (const int node : of_root) are_in[node] = 1;
    const auto sides = mesh.side_sets.find(name);
    if (sides != mesh.side_sets.end() && !sides->second.empty()) {
      for (const auto& side : sides->second) {
        for (const int node : side_nodes(mesh, side)) are_in[node] = 1;
      }
    } else {
      for (std::size_t i = 0; i < parents_.size(); ++i) {
        are_in[numbers_[root_.coordinates.size() + i]] = static_cast<char>(std::all_of(
            parents_[i].begin(), parents_[i].end(), [&](int parent) { return are_in[numbers_[parent]] != 0; }));
      }
    }
    std::vector<int> all;
    for (std::size_t n = 0; n < are_in.size(); ++n) {
      if (are_in[n] != 0) all.push_back(static_cast<int>(n));
    }
    return all;
  }

  std::vector<HangingNode> hanging_nodes() const {
    std::vector<HangingNode> all;
    for (const Cell& cell : leaves_) {
      visit_middles(cell, [&](int node, const std::vector<int>& parents) {
        all.push_back({numbers_[node], static_cast<int>(parents.size()), {}});
        std::transform(parents.begin(), parents.end(), all.back().parents.begin(),
                       [&](int parent) { return numbers_[parent]; });
        std::sort(all.back().parents.begin(), all.back().parents.begin() + all.back().n_parents);
      });
    }
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
    const auto is_same = [](const auto& a, const auto& b) { return a.node == b.node; };
    all.erase(std::unique(all.begin(), all.end(), is_same), all.end());
    return all;
  }
};

/// Weights of an element's corners in each corner's place of what a way leads to.
std::vector<std::vector<double>> weights_down(ElementType type, const ElementPath& path, int from_level) {
  const Division& division = *division_of(type);
  const auto n = static_cast<std::size_t>(n_corners(type));
  std::vector<std::vector<double>> weights(n, std::vector<double>(n, 0.));
  for (std::size_t k = 0; k < n; ++k) weights[k][k] = 1.;
  for (int level = from_level; level < path.level; ++level) {
    const auto place = path.children >> bits_per_level * (path.level - level - 1) & ((1u << bits_per_level) - 1);
    std::vector<std::vector<double>> of_child(n, std::vector<double>(n, 0.));
    for (std::size_t k = 0; k < n; ++k) {
      const auto& corners = division.nodes[division.children[place][k]];
      for (const int corner : corners) {
        for (std::size_t c = 0; c < n; ++c) {
          of_child[k][c] += weights[corner][c] / static_cast<double>(corners.size());
        }
      }
    }
    weights = std::move(of_child);
  }
  return weights;
}

}  // namespace

template <int dim>
RefinedMesh<dim> refine(const Mesh<dim>& root, const LevelRule<dim>& level_at) {
  PERIMORPH_ASSERT(root.is_whole() && root.hanging_nodes.empty(), "{} of {} elements, {} hanging nodes",
                   root.n_elements(), root.n_global_elements, root.hanging_nodes.size());
  Tree<dim> tree(root);
  tree.divide_by(level_at);
  tree.balance();
  auto refined = tree.mesh();
  check_consistency(refined.mesh);
  return refined;
}

template <int dim>
std::vector<Descent> descents(const RefinedMesh<dim>& coarser, const RefinedMesh<dim>& finer) {
  std::vector<Descent> all;
  std::size_t ancestor = 0;
  for (std::size_t e = 0; e < finer.paths.size(); ++e) {
    const auto& path = finer.paths[e];
    while (ancestor < coarser.paths.size() && !leads_through(path, coarser.paths[ancestor])) ++ancestor;
    PERIMORPH_ASSERT(ancestor < coarser.paths.size(), "element {} is in none of a coarser mesh", e);
    const auto& from = coarser.paths[ancestor];
    all.push_back({static_cast<int>(ancestor), {}});
    if (path.level > from.level) all.back().weights = weights_down(finer.mesh.types[e], path, from.level);
  }
  return all;
}

#define PERIMORPH_INSTANTIATE(dim)                                           \
  template RefinedMesh<dim> refine(const Mesh<dim>&, const LevelRule<dim>&); \
  template std::vector<Descent> descents(const RefinedMesh<dim>&, const RefinedMesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh
