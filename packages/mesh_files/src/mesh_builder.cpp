#include "mesh_builder.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/mesh/orientation.hpp"
#include "perimorph/mesh/sorted_sides.hpp"

namespace perimorph::mesh_files {

using base::Point;
using mesh::KeyedSide;
using mesh::Mesh;
using mesh::Side;
using mesh::SideKey;

namespace {

constexpr double smallest_allowed_volume = 1e-10;  // at a corner, relative to its edges
constexpr double flatness = 1e-10;                 // of z, relative to the body's size
constexpr std::size_t most_listed = 5;             // items shown in an error message
constexpr std::size_t longest_name = 200;
constexpr double largest_coordinate = 1e100;  // so that squares and volumes are finite numbers, too

/// What gmsh calls an entity of a dimension.
const char* entity_name(int dimension) {
  static constexpr std::array<const char*, 4> names = {"point", "curve", "surface", "volume"};
  return names.at(static_cast<std::size_t>(dimension));
}

/// Asserts that a reader has filled lists that belong together with as many items.
void check_lengths(const MeshFile& file) {
  const std::size_t n = file.n_elements();
  PERIMORPH_ASSERT(file.node_tags.size() == file.coordinates.size(), "{} nodes, {} places", file.node_tags.size(),
                   file.coordinates.size());
  PERIMORPH_ASSERT(file.shapes.size() == n && file.element_groups.size() == n, "{} elements, {} shapes, {} groups", n,
                   file.shapes.size(), file.element_groups.size());
  PERIMORPH_ASSERT(file.first_node.size() == n + 1 && file.first_node.back() == file.element_nodes.size(),
                   "{} elements, {} lists of nodes up to {} of {}", n, file.first_node.size(), file.first_node.back(),
                   file.element_nodes.size());
}

template <int dim>
class MeshBuilder {
 public:
  MeshBuilder(const MeshFile& file, double scale) : file_(file), scale_(scale) {}

  Mesh<dim> build() {
    check_dimensions();
    add_nodes();
    name_blocks();
    add_elements();
    check_every_node_is_used();
    check_orientation();
    check_sides();
    find_boundary(mesh_);
    add_sets();
    give_to_rank_0();
    return std::move(mesh_);
  }

 private:
  template <class... Arguments>
  [[noreturn]] void fail(fmt::format_string<Arguments...> what, Arguments&&... arguments) const {
    throw base::UserError(file_.name + ": " + fmt::format(what, std::forward<Arguments>(arguments)...));
  }

  int dimension_of(std::size_t element) const { return dimension(file_.shapes[element]); }
  const std::vector<int>& groups_of(std::size_t element) const {
    return file_.group_lists[file_.element_groups[element]];
  }

  std::string group_name(const GroupKey& group) const {
    const std::string& name = file_.group_names.at(group);
    if (name.empty() || name.size() > longest_name || base::has_control_characters(name)) {
      fail("{} {} has a name of {} characters; allowed are readable names of at most {}", entity_name(group.first),
           group.second, name.size(), longest_name);
    }
    return name;
  }

  // ---- nodes ----

  void add_nodes() {
    if (std::max(file_.node_tags.size(), file_.element_nodes.size()) > std::numeric_limits<int>::max()) {
      fail("more than {} nodes or corners of elements", std::numeric_limits<int>::max());
    }
    check_flat();
    node_of_tag_.reserve(file_.node_tags.size());
    for (std::size_t n = 0; n < file_.node_tags.size(); ++n) {
      if (!node_of_tag_.emplace(file_.node_tags[n], static_cast<int>(n)).second) {
        fail("two nodes have the number {}", file_.node_tags[n]);
      }
      const Point<dim> scaled = scale_ * Eigen::Map<const Point<dim>>(file_.coordinates[n].data());
      if (!(scaled.cwiseAbs().maxCoeff() < largest_coordinate)) {
        fail("node {} has a coordinate of {} after scaling by {}; allowed are absolute values < {}", file_.node_tags[n],
             scaled.cwiseAbs().maxCoeff(), scale_, largest_coordinate);
      }
      mesh_.coordinates.push_back(scaled);
    }
  }

  /// The coordinates that a mesh of this dimension leaves out are all equal.
  void check_flat() const {
    if (file_.coordinates.empty()) return;
    Eigen::Array3d lowest = Eigen::Map<const Eigen::Array3d>(file_.coordinates.front().data()), highest = lowest;
    for (const auto& point : file_.coordinates) {
      lowest = lowest.min(Eigen::Map<const Eigen::Array3d>(point.data()));
      highest = highest.max(Eigen::Map<const Eigen::Array3d>(point.data()));
    }
    const Eigen::Array3d extent = highest - lowest;
    if ((extent.tail(3 - dim) > flatness * extent.maxCoeff()).any()) {
      fail("a {}D mesh must lie in the plane z = constant, but its nodes have z from {} to {}", dim, lowest[2],
           highest[2]);
    }
  }

  int node_of(std::size_t element, std::int64_t tag) const {
    const auto found = node_of_tag_.find(tag);
    if (found == node_of_tag_.end()) {
      fail("element {} has node {}, which the file does not list", file_.element_tags[element], tag);
    }
    return found->second;
  }

  std::vector<int> nodes_of(std::size_t element) const {
    std::vector<int> nodes;
    for (std::size_t i = file_.first_node[element]; i < file_.first_node[element + 1]; ++i) {
      nodes.push_back(node_of(element, file_.element_nodes[i]));
    }
    return nodes;
  }

  // ---- elements and blocks ----

  void check_dimensions() const {
    int highest = -1;
    for (std::size_t e = 0; e < file_.n_elements(); ++e) {
      highest = std::max(highest, dimension_of(e));
      if (dimension_of(e) > dim && !groups_of(e).empty()) {
        fail("element {} is of dimension {}, but the case has dimension {}", file_.element_tags[e], dimension_of(e),
             dim);
      }
    }
    if (highest < 0) fail("the mesh has no elements");
    if (highest < dim) {
      fail("the mesh has no elements of dimension {}, its highest is {}: {}", dim, highest, file_.advice.no_elements);
    }
  }

  /// Every group of the mesh's dimension becomes a block; without any, all is one block "body".
  void name_blocks() {
    for (std::size_t e = 0; e < file_.n_elements(); ++e) {
      if (dimension_of(e) == dim) {
        for (const int group : groups_of(e)) block_of_group_[group] = 0;
      }
    }
    for (auto& [group, block] : block_of_group_) {
      block = static_cast<int>(mesh_.block_names.size());
      mesh_.block_names.push_back(unique_name({dim, group}, block_names_));
    }
    if (block_of_group_.empty()) mesh_.block_names = {"body"};
  }

  std::string unique_name(const GroupKey& group, std::map<std::string, GroupKey>& used) const {
    std::string name = group_name(group);
    const auto [entry, is_new] = used.emplace(name, group);
    if (!is_new && entry->second != group) {
      fail("two groups are named \"{}\": {} {} and {} {}; give each its own name", name,
           entity_name(entry->second.first), entry->second.second, entity_name(group.first), group.second);
    }
    return name;
  }

  void add_elements() {
    for (std::size_t e = 0; e < file_.n_elements(); ++e) {
      if (dimension_of(e) != dim) continue;
      const std::vector<int> nodes = nodes_of(e);
      mesh_.types.push_back(element_type(file_.shapes[e]));
      mesh_.blocks.push_back(block_of(e));
      mesh_.corners.insert(mesh_.corners.end(), nodes.begin(), nodes.end());
      mesh_.first_corner.push_back(static_cast<int>(mesh_.corners.size()));
      file_tags_.push_back(file_.element_tags[e]);
    }
  }

  int block_of(std::size_t element) const {
    const std::vector<int>& groups = groups_of(element);
    if (groups.size() == 1) return block_of_group_.at(groups[0]);
    if (groups.size() > 1) {
      fail("element {} is in two groups, \"{}\" and \"{}\": each element must be in exactly one",
           file_.element_tags[element], group_name({dim, groups[0]}), group_name({dim, groups[1]}));
    }
    if (!block_of_group_.empty()) {
      fail(
          "element {} is in no group, but others are (blocks {}): each element must be in exactly one, or all "
          "in none",
          file_.element_tags[element], base::quoted_list(mesh_.block_names));
    }
    return 0;
  }

  // ---- checks of the whole mesh ----

  void check_every_node_is_used() const {
    std::vector<char> used(mesh_.coordinates.size(), 0);
    for (const int node : mesh_.corners) used[node] = 1;
    std::vector<std::int64_t> unused;
    for (std::size_t n = 0; n < used.size(); ++n) {
      if (!used[n]) unused.push_back(file_.node_tags[n]);
    }
    if (unused.empty()) return;
    const std::size_t n_unused = unused.size();
    unused.resize(std::min(n_unused, most_listed));
    fail("{} node(s) belong to no {}D element: {}{}. {}", n_unused, dim, fmt::join(unused, ", "),
         n_unused > most_listed ? ", ..." : "", file_.advice.unused_nodes);
  }

  void check_orientation() const {
    int n_wrong = 0, first_wrong = -1;
    double volume = 0.;
    for (int e = 0; e < mesh_.n_elements(); ++e) {
      const double smallest = smallest_corner_volume(mesh_, e);
      if (smallest > smallest_allowed_volume) continue;
      if (n_wrong++ == 0) {
        first_wrong = e;
        volume = smallest;
      }
    }
    if (n_wrong == 0) return;
    if (n_wrong == mesh_.n_elements()) {
      fail("all {} elements are inverted (the first is element {}). {}", n_wrong, file_tags_[first_wrong],
           file_.advice.reversed);
    }
    fail("element {} is {} ({} of {} elements are inverted or degenerate). {}", file_tags_[first_wrong],
         volume < -smallest_allowed_volume ? "inverted" : "degenerate", n_wrong, mesh_.n_elements(),
         file_.advice.reversed);
  }

  /// A side has two elements, which see it from opposite sides; anything else is an overlap.
  void check_sides() {
    sides_ = sorted_sides(mesh_);
    for (std::size_t i = 0; i + 1 < sides_.size(); ++i) {
      if (sides_[i].key != sides_[i + 1].key) continue;
      const int first = sides_[i].side.element, second = sides_[i + 1].side.element;
      if (same_nodes(first, second)) fail_twice(first, second);
      if (i + 2 < sides_.size() && sides_[i].key == sides_[i + 2].key) {
        fail("elements {}, {} and {} share one side: they overlap", file_tags_[first], file_tags_[second],
             file_tags_[sides_[i + 2].side.element]);
      }
    }
  }

  bool same_nodes(int a, int b) const {
    return mesh_.n_corners(a) == mesh_.n_corners(b) &&
           std::is_permutation(mesh_.corners_of(a), mesh_.corners_of(a) + mesh_.n_corners(a), mesh_.corners_of(b));
  }

  /// MSH 2.2 repeats an element for each of its groups.
  [[noreturn]] void fail_twice(int first, int second) const {
    const std::string &a = mesh_.block_names[mesh_.blocks[first]], &b = mesh_.block_names[mesh_.blocks[second]];
    if (a == b) fail("elements {} and {} have the same nodes", file_tags_[first], file_tags_[second]);
    fail(
        "element {} is in two groups, \"{}\" and \"{}\" (there as element {}): each element must be in "
        "exactly "
        "one",
        file_tags_[first], a, b, file_tags_[second]);
  }

  // ---- node sets and side sets ----

  void add_sets() {
    for (std::size_t e = 0; e < file_.n_elements(); ++e) {
      if (dimension_of(e) >= dim) continue;
      for (const int group : groups_of(e)) add_to_sets(e, {dimension_of(e), group});
    }
    for (auto& [name, nodes] : mesh_.node_sets) sort_unique(nodes, std::less<>());
    if (file_.sides_follow_from_node_sets) add_sides_of_node_sets();
    for (auto& [name, sides_of_set] : mesh_.side_sets) sort_unique(sides_of_set, std::less<>());
  }

  void add_to_sets(std::size_t element, const GroupKey& group) {
    const std::vector<int> nodes = nodes_of(element);
    const std::string name = unique_name(group, set_names_);
    std::vector<int>& node_set = mesh_.node_sets[name];
    node_set.insert(node_set.end(), nodes.begin(), nodes.end());
    if (group.first == dim - 1) mesh_.side_sets[name].push_back(side_with(nodes, element, name));
  }

  Side side_with(const std::vector<int>& nodes, std::size_t element, const std::string& set) const {
    const SideKey key = mesh::side_key(nodes);
    const auto found = std::lower_bound(sides_.begin(), sides_.end(), key,
                                        [](const KeyedSide& side, const SideKey& k) { return side.key < k; });
    if (found == sides_.end() || found->key != key) {
      fail("element {} of the group \"{}\" is no side of any {}D element", file_.element_tags[element], set, dim);
    }
    return found->side;
  }

  /// Requires node sets in ascending order.
  void add_sides_of_node_sets() {
    for (const auto& [name, nodes] : mesh_.node_sets) {
      const auto is_in_set = [&members = nodes](int node) {
        return std::binary_search(members.begin(), members.end(), node);
      };
      for (const Side& side : mesh_.boundary) {
        const std::vector<int> corners_of_side = side_nodes(mesh_, side);
        if (std::all_of(corners_of_side.begin(), corners_of_side.end(), is_in_set)) {
          mesh_.side_sets[name].push_back(side);
        }
      }
    }
  }

  template <class T, class Less>
  static void sort_unique(std::vector<T>& items, Less less) {
    std::sort(items.begin(), items.end(), less);
    const auto same = [&](const T& a, const T& b) { return !less(a, b) && !less(b, a); };
    items.erase(std::unique(items.begin(), items.end(), same), items.end());
  }

  void give_to_rank_0() {
    mesh_.n_owned_nodes = mesh_.n_nodes();
    mesh_.n_owned_elements = mesh_.n_elements();
    mesh_.n_global_nodes = mesh_.n_owned_nodes;
    mesh_.n_global_elements = mesh_.n_owned_elements;
    mesh_.node_owners.assign(mesh_.n_owned_nodes, 0);
    mesh_.element_owners.assign(mesh_.n_owned_elements, 0);
    mesh_.node_ids.resize(mesh_.n_owned_nodes);
    mesh_.element_ids.resize(mesh_.n_owned_elements);
    std::iota(mesh_.node_ids.begin(), mesh_.node_ids.end(), base::GlobalId{0});
    std::iota(mesh_.element_ids.begin(), mesh_.element_ids.end(), base::GlobalId{0});
  }

  const MeshFile& file_;
  double scale_;
  Mesh<dim> mesh_;
  std::vector<std::int64_t> file_tags_;  // of the mesh's elements
  std::unordered_map<std::int64_t, int> node_of_tag_;
  std::map<int, int> block_of_group_;
  std::map<std::string, GroupKey> block_names_, set_names_;
  std::vector<KeyedSide> sides_;
};

}  // namespace

template <int dim>
Mesh<dim> build_mesh(const MeshFile& file, double scale) {
  check_lengths(file);
  PERIMORPH_ASSERT(scale > 0., "coordinates are scaled by {}", scale);
  return MeshBuilder<dim>(file, scale).build();
}

template Mesh<2> build_mesh(const MeshFile&, double);
template Mesh<3> build_mesh(const MeshFile&, double);

}  // namespace perimorph::mesh_files
