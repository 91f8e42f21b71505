#include "mesh_builder.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/mesh/orientation.hpp"
#include "perimorph/mesh/sorted_sides.hpp"
#include "repeated_nodes.hpp"

namespace perimorph::mesh_files {

using base::Point;
using mesh::KeyedSide;
using mesh::Mesh;
using mesh::Side;
using mesh::SideKey;

namespace {

constexpr int unused = -1, unnumbered = 0;         // nodes of the file: without, and as yet without number in the mesh
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

template <int dim>
class MeshBuilder {
 public:
  MeshBuilder(const MeshFile& file, double scale) : file_(file), scale_(scale) {}

  Mesh<dim> build() {
    for (const std::string& passed_over : file_.notes) note("{}", passed_over);
    check_dimensions();
    find_nodes();
    name_blocks();
    add_elements();
    add_used_nodes();
    turn_reversed_elements();
    check_sides();
    find_boundary(mesh_);
    add_sets();
    give_to_rank_0();
    return std::move(mesh_);
  }

 private:
  /// Of one group: its nodes; and its sides if it is of lines (2D) or faces (3D).
  struct Set {
    int dimension = 0;
    std::vector<int> nodes;
    std::vector<Side> sides;
    std::optional<std::int64_t> element_without_side;  // the first
  };

  template <class... Arguments>
  [[noreturn]] void fail(fmt::format_string<Arguments...> what, Arguments&&... arguments) const {
    throw base::UserError(file_.name + ": " + fmt::format(what, std::forward<Arguments>(arguments)...));
  }

  template <class... Arguments>
  void note(fmt::format_string<Arguments...> what, Arguments&&... arguments) {
    mesh_.notes.push_back(file_.name + ": " + fmt::format(what, std::forward<Arguments>(arguments)...));
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

  void find_nodes() {
    if (std::max(file_.node_tags.size(), file_.element_nodes.size()) > std::numeric_limits<int>::max()) {
      fail("more than {} nodes or corners of elements", std::numeric_limits<int>::max());
    }
    place_of_tag_.reserve(file_.node_tags.size());
    for (std::size_t n = 0; n < file_.node_tags.size(); ++n) {
      if (!place_of_tag_.emplace(file_.node_tags[n], static_cast<int>(n)).second) {
        fail("two nodes have the number {}", file_.node_tags[n]);
      }
    }
  }

  /// Nodes that elements use become the mesh's, in the file's order; the elements' corners, until here places in the
  /// file, become their numbers.
  void add_used_nodes() {
    node_at_place_.assign(file_.node_tags.size(), unused);
    for (const int place : mesh_.corners) node_at_place_[place] = unnumbered;
    check_flat();
    for (std::size_t n = 0; n < node_at_place_.size(); ++n) {
      if (node_at_place_[n] != unused) add_node(n);
    }
    for (int& corner : mesh_.corners) corner = node_at_place_[corner];
    note_unused_nodes();
  }

  void add_node(std::size_t place) {
    const Point<dim> scaled = scale_ * Eigen::Map<const Point<dim>>(file_.coordinates[place].data());
    if (!(scaled.cwiseAbs().maxCoeff() < largest_coordinate)) {
      fail("node {} has a coordinate of {} after scaling by {}; allowed are absolute values < {}",
           file_.node_tags[place], scaled.cwiseAbs().maxCoeff(), scale_, largest_coordinate);
    }
    node_at_place_[place] = mesh_.n_nodes();
    mesh_.coordinates.push_back(scaled);
  }

  /// The coordinates that a mesh of this dimension leaves out are all equal.
  void check_flat() const {
    Eigen::Array3d lowest = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity()), highest = -lowest;
    for (std::size_t n = 0; n < node_at_place_.size(); ++n) {
      if (node_at_place_[n] == unused) continue;
      lowest = lowest.min(Eigen::Map<const Eigen::Array3d>(file_.coordinates[n].data()));
      highest = highest.max(Eigen::Map<const Eigen::Array3d>(file_.coordinates[n].data()));
    }
    const Eigen::Array3d extent = highest - lowest;
    if ((extent.tail(3 - dim) > flatness * extent.maxCoeff()).any()) {
      fail("a {}D mesh must lie in the plane z = constant, but its nodes have z from {} to {}", dim, lowest[2],
           highest[2]);
    }
  }

  void note_unused_nodes() {
    std::vector<std::int64_t> mid_nodes = file_.mid_nodes, others;
    sort_unique(mid_nodes, std::less<>());
    std::size_t n_mid_nodes = 0;
    for (std::size_t n = 0; n < node_at_place_.size(); ++n) {
      if (node_at_place_[n] != unused) continue;
      if (std::binary_search(mid_nodes.begin(), mid_nodes.end(), file_.node_tags[n])) {
        ++n_mid_nodes;
      } else {
        others.push_back(file_.node_tags[n]);
      }
    }
    if (const std::size_t n = file_.n_second_order[dim]; n > 0) {
      note(
          "{} of {} elements are of second order: they are taken by their corners, with straight edges, and {} "
          "between the corners are dropped",
          n, mesh_.n_elements(), base::counted(n_mid_nodes, "node"));
    }
    if (others.empty()) return;
    const std::size_t n_others = others.size();
    others.resize(std::min(n_others, most_listed));
    note("dropped: {} in no {}D element ({}{})", base::counted(n_others, "node"), dim, fmt::join(others, ", "),
         n_others > most_listed ? ", ..." : "");
  }

  int place_of(std::size_t element, std::int64_t tag) const {
    const auto found = place_of_tag_.find(tag);
    if (found == place_of_tag_.end()) {
      fail("element {} has node {}, which the file does not list", file_.element_tags[element], tag);
    }
    return found->second;
  }

  /// Of an element's corners, where their nodes stand in the file.
  std::vector<int> places_of(std::size_t element) const {
    std::vector<int> places;
    for (std::size_t i = file_.first_node[element]; i < file_.first_node[element + 1]; ++i) {
      places.push_back(place_of(element, file_.element_nodes[i]));
    }
    return places;
  }

  /// Of places in the file: the mesh's nodes, without those that are not used.
  std::vector<int> used_nodes(const std::vector<int>& places) const {
    std::vector<int> nodes;
    for (const int place : places) {
      if (node_at_place_[place] != unused) nodes.push_back(node_at_place_[place]);
    }
    return nodes;
  }

  // ---- elements and blocks ----

  void check_dimensions() {
    int highest = -1;
    bool has_body = false;
    for (std::size_t e = 0; e < file_.n_elements(); ++e) {
      highest = std::max(highest, dimension_of(e));
      has_body = has_body || dimension_of(e) == dim;
      if (dimension_of(e) > dim && !groups_of(e).empty()) {
        fail("element {} is of dimension {}, but the case has dimension {}", file_.element_tags[e], dimension_of(e),
             dim);
      }
    }
    if (highest < 0) fail("the mesh has no elements");
    if (!has_body) {
      fail("the mesh has no elements of dimension {}, its highest is {}: {}", dim, highest, file_.advice);
    }
    if (dim == 3 && file_.n_plane_bodies > 0) {
      note("{} plane elements (shells) have no body in three dimensions: they are groups of sides only",
           file_.n_plane_bodies);
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
      mesh_.block_names.push_back(unique_name({dim, group}));
    }
    if (block_of_group_.empty()) mesh_.block_names = {"body"};
  }

  std::string unique_name(const GroupKey& group) {
    std::string name = group_name(group);
    const auto [entry, is_new] = block_names_.emplace(name, group);
    if (!is_new && entry->second != group) {
      fail("two groups are named \"{}\": {} {} and {} {}; give each its own name", name,
           entity_name(entry->second.first), entry->second.second, entity_name(group.first), group.second);
    }
    return name;
  }

  void add_elements() {
    int n_reduced = 0;
    for (std::size_t e = 0; e < file_.n_elements(); ++e) {
      if (dimension_of(e) != dim) continue;
      const auto [shape, nodes] = corners_of(e);
      if (shape != file_.shapes[e]) ++n_reduced;
      mesh_.types.push_back(element_type(shape));
      mesh_.blocks.push_back(block_of(e));
      mesh_.corners.insert(mesh_.corners.end(), nodes.begin(), nodes.end());
      mesh_.first_corner.push_back(static_cast<int>(mesh_.corners.size()));
      file_tags_.push_back(file_.element_tags[e]);
    }
    if (n_reduced == 0) return;
    note("{} of {} elements have repeated nodes: each is taken as the {} that is left of it", n_reduced,
         mesh_.n_elements(), dim == 2 ? "triangle" : "wedge, pyramid or tetrahedron");
  }

  Corners corners_of(std::size_t element) const {
    if (auto corners = without_repeated_nodes(file_.shapes[element], places_of(element))) return std::move(*corners);
    const auto nodes = file_.element_nodes.begin();
    fail("element {} has nodes {}, which are the corners of no {}", file_.element_tags[element],
         fmt::join(nodes + static_cast<std::ptrdiff_t>(file_.first_node[element]),
                   nodes + static_cast<std::ptrdiff_t>(file_.first_node[element + 1]), ", "),
         dim == 2 ? "triangle or quadrangle" : "hexahedron, wedge, pyramid or tetrahedron");
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

  void turn_reversed_elements() {
    int n_turned = 0, first_turned = -1, n_wrong = 0, first_wrong = -1;
    for (int e = 0; e < mesh_.n_elements(); ++e) {
      if (smallest_corner_volume(mesh_, e) > smallest_allowed_volume) continue;
      turn(e);
      if (smallest_corner_volume(mesh_, e) > smallest_allowed_volume) {
        if (n_turned++ == 0) first_turned = e;
      } else if (n_wrong++ == 0) {
        first_wrong = e;
      }
    }
    if (n_wrong > 0) {
      fail("element {} is degenerate or not convex ({} of {} elements are): at each corner, the edges must span {}",
           file_tags_[first_wrong], n_wrong, mesh_.n_elements(), dim == 2 ? "an area" : "a volume");
    }
    if (n_turned > 0) {
      note("{} of {} elements have their nodes in reversed order and are turned (the first is element {})", n_turned,
           mesh_.n_elements(), file_tags_[first_turned]);
    }
  }

  /// Mirrors the order of an element's corners.
  void turn(int element) {
    int* corners = mesh_.corners.data() + mesh_.first_corner[element];
    const int n = mesh_.n_corners(element);
    const int n_base = dim == 2 ? n : n == 4 || n == 6 ? 3 : 4;  // corners of its first face
    std::reverse(corners + 1, corners + n_base);
    if (n == 2 * n_base) std::reverse(corners + n_base + 1, corners + n);
  }

  /// A side has two elements, which see it from opposite sides; anything else is an overlap.
  void check_sides() {
    sides_ = sorted_sides(mesh_);
    for (std::size_t i = 0; i + 1 < sides_.size(); ++i) {
      if (sides_[i].key != sides_[i + 1].key) continue;
      const int first = sides_[i].side.element, second = sides_[i + 1].side.element;
      if (same_nodes(first, second)) fail_duplicate(first, second);
      if (i + 2 < sides_.size() && sides_[i].key == sides_[i + 2].key) {
        fail("elements {}, {} and {} share one side: they overlap", file_tags_[first], file_tags_[second],
             file_tags_[sides_[i + 2].side.element]);
      }
      if (run_alike(sides_[i].side, sides_[i + 1].side)) {
        fail("elements {} and {} lie on the same side of the side they share: they overlap", file_tags_[first],
             file_tags_[second]);
      }
    }
  }

  /// Whether two sides with the same nodes run round them in the same sense.
  bool run_alike(const Side& a, const Side& b) const {
    const std::vector<int>&corners_a = corners_of(a), &corners_b = corners_of(b);
    const int *nodes_a = mesh_.corners_of(a.element), *nodes_b = mesh_.corners_of(b.element);
    std::size_t start = 0;
    while (nodes_b[corners_b[start]] != nodes_a[corners_a[0]]) ++start;
    if (dim == 2) return start == 0;
    return nodes_b[corners_b[(start + 1) % corners_b.size()]] == nodes_a[corners_a[1]];
  }

  const std::vector<int>& corners_of(const Side& side) const {
    return mesh::sides(mesh_.types[side.element])[static_cast<std::size_t>(side.side)];
  }

  bool same_nodes(int a, int b) const {
    return mesh_.n_corners(a) == mesh_.n_corners(b) &&
           std::is_permutation(mesh_.corners_of(a), mesh_.corners_of(a) + mesh_.n_corners(a), mesh_.corners_of(b));
  }

  /// MSH 2.2 repeats an element for each of its groups.
  [[noreturn]] void fail_duplicate(int first, int second) const {
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
      for (const int group : groups_of(e)) add_to_set(e, {dimension_of(e), group});
    }
    std::map<std::string, std::vector<const Set*>> sets_by_name;
    for (auto& [group, set] : sets_) {
      sort_unique(set.nodes, std::less<>());
      sets_by_name[group_name(group)].push_back(&set);
    }
    for (const auto& [name, sets] : sets_by_name) name_sets(name, sets);
    for (auto& [name, sides_of_set] : mesh_.side_sets) sort_unique(sides_of_set, std::less<>());
  }

  void add_to_set(std::size_t element, const GroupKey& group) {
    std::vector<int> places = places_of(element);
    sort_unique(places, std::less<>());
    const std::vector<int> nodes = used_nodes(places);
    Set& set = sets_[group];
    set.dimension = group.first;
    set.nodes.insert(set.nodes.end(), nodes.begin(), nodes.end());
    if (group.first != dim - 1 || places.size() < dim) return;  // repeated nodes may leave nothing of a side
    if (const Side side = nodes.size() < places.size() ? Side{-1, 0} : side_with(nodes); side.element >= 0) {
      set.sides.push_back(side);
    } else if (!set.element_without_side) {
      set.element_without_side = file_.element_tags[element];
    }
  }

  /// Only what a case uses must fit the mesh: of what does not, it finds that the group is not there.
  void name_sets(const std::string& name, const std::vector<const Set*>& sets) {
    const std::vector<int>& nodes = sets[0]->nodes;
    if (!std::all_of(sets.begin(), sets.end(), [&](const Set* set) { return set->nodes == nodes; })) {
      return note("the groups called \"{}\" are left out, since their nodes differ: give each its own name", name);
    }
    if (nodes.empty()) return note("the group \"{}\" is left out: no {}D element has a node of it", name, dim);
    mesh_.node_sets[name] = nodes;
    bool has_nodes_only = true;
    for (const Set* set : sets) {
      has_nodes_only = has_nodes_only && set->dimension == 0;
      if (set->dimension == dim - 1) add_side_set(name, *set);
    }
    if (has_nodes_only && file_.sides_follow_from_node_sets) add_sides_between(nodes, name);
  }

  void add_side_set(const std::string& name, const Set& set) {
    if (set.element_without_side) {
      return note("the group \"{}\" has nodes but no sides: element {} of it is no side of any {}D element", name,
                  *set.element_without_side, dim);
    }
    if (set.sides.empty()) {
      return note("the group \"{}\" has nodes but no sides: repeated nodes leave nothing of them", name);
    }
    std::vector<Side>& sides_of_set = mesh_.side_sets[name];
    sides_of_set.insert(sides_of_set.end(), set.sides.begin(), set.sides.end());
  }

  /// @param nodes in ascending order
  void add_sides_between(const std::vector<int>& nodes, const std::string& name) {
    const auto is_in_set = [&](int node) { return std::binary_search(nodes.begin(), nodes.end(), node); };
    for (const Side& side : mesh_.boundary) {
      const std::vector<int> corners = side_nodes(mesh_, side);
      if (std::all_of(corners.begin(), corners.end(), is_in_set)) mesh_.side_sets[name].push_back(side);
    }
  }

  /// A side with these nodes, of element -1 if there is none.
  Side side_with(const std::vector<int>& nodes) const {
    const SideKey key = mesh::side_key(nodes);
    const auto found = std::lower_bound(sides_.begin(), sides_.end(), key,
                                        [](const KeyedSide& side, const SideKey& k) { return side.key < k; });
    return found == sides_.end() || found->key != key ? Side{-1, 0} : found->side;
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
  std::vector<std::int64_t> file_tags_;                 // of the mesh's elements
  std::unordered_map<std::int64_t, int> place_of_tag_;  // where the node stands in the file
  std::vector<int> node_at_place_;                      // of the mesh, or unused
  std::map<int, int> block_of_group_;
  std::map<std::string, GroupKey> block_names_;
  std::map<GroupKey, Set> sets_;
  std::vector<KeyedSide> sides_;
};

}  // namespace

template <int dim>
Mesh<dim> build_mesh(const MeshFile& file, double scale) {
  file.check_lengths();
  PERIMORPH_ASSERT(scale > 0., "coordinates are scaled by {}", scale);
  return MeshBuilder<dim>(file, scale).build();
}

template Mesh<2> build_mesh(const MeshFile&, double);
template Mesh<3> build_mesh(const MeshFile&, double);

}  // namespace perimorph::mesh_files
