#include "mesh_builder.hpp"

#include <Teuchos_DefaultSerialComm.hpp>
#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "file_groups.hpp"
#include "file_nodes.hpp"
#include "over_ranks.hpp"
#include "part_sides.hpp"
#include "perimorph/base/slices.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/mesh/distribute.hpp"
#include "perimorph/mesh/orientation.hpp"
#include "remarks.hpp"
#include "repeated_nodes.hpp"
#include "set_builder.hpp"

namespace perimorph::mesh_files {

using mesh::Mesh;

namespace {

constexpr double smallest_allowed_volume = 1e-10;  // at a corner, relative to its edges

template <int dim>
class MeshBuilder {
 public:
  MeshBuilder(const base::Comm& comm, const MeshFile& slice, double scale)
      : comm_(comm), slice_(slice), scale_(scale), remarks_(slice.name) {}

  Mesh<dim> build() {
    for (const std::string& passed_over : slice_.notes) remarks_.note("{}", passed_over);
    check_dimensions();
    FileNodes<dim> nodes(comm_, slice_, scale_, remarks_);
    const FileGroups groups(comm_, slice_, remarks_);
    name_blocks(groups);
    add_elements(nodes, groups);
    turn_reversed_elements();
    distribute();
    const std::vector<std::string> sides_follow_from = add_boundary_and_sets(nodes, groups);
    distribute();  // now all know of their halo's boundary and sets
    add_sides_between(comm_, sides_follow_from, mesh_);
    if (comm_.getRank() == 0) mesh_.notes = remarks_.notes();
    return std::move(mesh_);
  }

 private:
  bool is_of_body(std::size_t element) const { return dimension(slice_.shapes[element]) == dim; }
  const std::vector<int>& groups_of(std::size_t element) const {
    return slice_.group_lists[slice_.element_groups[element]];
  }

  /// Whoever owns a node then has all elements around it; whoever owns an element, all beside it.
  void distribute() {
    if (comm_.getSize() > 1) mesh_ = mesh::distribute(comm_, mesh_, 0.);
  }

  // ---- the file ----

  void check_dimensions() {
    GlobalId highest = -1, has_body = 0;
    base::on_all_ranks(comm_, [&] {
      check_counts();
      for (std::size_t e = 0; e < slice_.n_elements(); ++e) {
        const int dimension_here = dimension(slice_.shapes[e]);
        highest = std::max<GlobalId>(highest, dimension_here);
        if (dimension_here == dim) has_body = 1;
        if (dimension_here > dim && !groups_of(e).empty()) {
          remarks_.fail("element {} is of dimension {}, but the case has dimension {}", slice_.element_tags[e],
                        dimension_here, dim);
        }
      }
    });
    highest = base::max(comm_, highest);
    if (highest < 0) remarks_.fail("the mesh has no elements");
    if (base::max(comm_, has_body) == 0) {
      remarks_.fail("the mesh has no elements of dimension {}, its highest is {}: {}", dim, highest, slice_.advice);
    }
    const std::size_t n_plane_bodies = sum(comm_, slice_.n_plane_bodies);
    if (dim == 3 && n_plane_bodies > 0) {
      remarks_.note("{} plane elements (shells) have no body in three dimensions: they are groups of sides only",
                    n_plane_bodies);
    }
  }

  void check_counts() const {
    slice_.check_lengths();
    if (std::max(slice_.node_tags.size(), slice_.element_nodes.size()) > std::numeric_limits<int>::max()) {
      remarks_.fail("more than {} nodes or corners of elements", std::numeric_limits<int>::max());
    }
  }

  // ---- blocks ----

  /// Every group of the mesh's dimension becomes a block; without any, all is one block "body".
  void name_blocks(const FileGroups& groups) {
    std::map<std::string, int> group_of_name;
    for (int group = 0; group < groups.n(); ++group) {
      const GroupKey& key = groups.key(group);
      if (key.first != dim || !groups.has_elements(group)) continue;
      const auto [entry, is_new] = group_of_name.emplace(groups.name(group), group);
      if (!is_new) {
        const GroupKey& other = groups.key(entry->second);
        remarks_.fail("two groups are named \"{}\": {} {} and {} {}; give each its own name", entry->first,
                      entity_name(other.first), other.second, entity_name(key.first), key.second);
      }
      block_of_group_[key.second] = static_cast<int>(mesh_.block_names.size());
      mesh_.block_names.push_back(entry->first);
    }
    if (block_of_group_.empty()) mesh_.block_names = {"body"};
  }

  int block_of(std::size_t element, const FileGroups& groups) const {
    const std::vector<int>& numbers = groups_of(element);
    if (numbers.size() == 1) return block_of_group_.at(numbers[0]);
    if (numbers.size() > 1) {
      const auto name = [&](int number) { return groups.name(groups.index_of({dim, number})); };
      remarks_.fail("element {} is in two groups, \"{}\" and \"{}\": each element must be in exactly one",
                    slice_.element_tags[element], name(numbers[0]), name(numbers[1]));
    }
    if (!block_of_group_.empty()) {
      remarks_.fail(
          "element {} is in no group, but others are (blocks {}): each element must be in exactly one, or all "
          "in none",
          slice_.element_tags[element], base::quoted_list(mesh_.block_names));
    }
    return 0;
  }

  // ---- elements and nodes ----

  /// The slice's elements, with the nodes that they use.
  void add_elements(FileNodes<dim>& nodes, const FileGroups& groups) {
    TagNumbers tags;
    for (std::size_t e = 0; e < slice_.n_elements(); ++e) {
      if (!is_of_body(e)) continue;
      for (std::size_t i = slice_.first_node[e]; i < slice_.first_node[e + 1]; ++i) {
        mesh_.corners.push_back(tags.number_of(slice_.element_nodes[i]));
      }
    }
    const std::vector<GlobalId> places = nodes.places_of(tags.tags());
    std::size_t n_reduced = 0;
    base::on_all_ranks(comm_, [&] { n_reduced = add_elements(places, groups); });
    n_reduced = sum(comm_, n_reduced);
    number_elements();
    if (n_reduced > 0) {
      remarks_.note("{} of {} elements have repeated nodes: each is taken as the {} that is left of it", n_reduced,
                    mesh_.n_global_elements, dim == 2 ? "triangle" : "wedge, pyramid or tetrahedron");
    }
    add_nodes(nodes.use(places));
    mesh_.n_global_nodes = nodes.n_used();
    nodes.note_unused(mesh_.n_global_elements, remarks_);
  }

  /// Makes elements of lists of nodes, which may be repeated in an element.
  /// @param places of the nodes in the file
  /// @return of how many less is left than their shape has
  std::size_t add_elements(const std::vector<GlobalId>& places, const FileGroups& groups) {
    std::size_t n_reduced = 0;
    std::vector<int> all_nodes;
    all_nodes.swap(mesh_.corners);
    mesh_.corners.reserve(all_nodes.size());
    auto next = all_nodes.begin();
    for (std::size_t e = 0; e < slice_.n_elements(); ++e) {
      if (!is_of_body(e)) continue;
      const std::vector<int> listed(next, next + n_nodes(slice_.shapes[e]));
      next += n_nodes(slice_.shapes[e]);
      const auto [shape, nodes] = corners_of(e, listed, places);
      if (shape != slice_.shapes[e]) ++n_reduced;
      mesh_.types.push_back(element_type(shape));
      mesh_.blocks.push_back(block_of(e, groups));
      mesh_.corners.insert(mesh_.corners.end(), nodes.begin(), nodes.end());
      mesh_.first_corner.push_back(static_cast<int>(mesh_.corners.size()));
      file_tags_.push_back(slice_.element_tags[e]);
    }
    return n_reduced;
  }

  Corners corners_of(std::size_t element, const std::vector<int>& nodes, const std::vector<GlobalId>& places) const {
    const auto tags = slice_.element_nodes.begin() + static_cast<std::ptrdiff_t>(slice_.first_node[element]);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (places[nodes[i]] != FileNodes<dim>::none) continue;
      remarks_.fail("element {} has node {}, which the file does not list", slice_.element_tags[element], tags[i]);
    }
    if (auto corners = without_repeated_nodes(slice_.shapes[element], nodes)) return std::move(*corners);
    remarks_.fail("element {} has nodes {}, which are the corners of no {}", slice_.element_tags[element],
                  fmt::join(tags, tags + static_cast<std::ptrdiff_t>(nodes.size()), ", "),
                  dim == 2 ? "triangle or quadrangle" : "hexahedron, wedge, pyramid or tetrahedron");
  }

  void number_elements() {
    const auto slices = base::Slices::of(comm_, file_tags_.size());
    mesh_.rank = comm_.getRank();
    first_element_ = slices.begin(mesh_.rank);
    mesh_.element_ids.resize(file_tags_.size());
    std::iota(mesh_.element_ids.begin(), mesh_.element_ids.end(), first_element_);
    mesh_.n_owned_elements = mesh_.n_elements();
    mesh_.element_owners.assign(file_tags_.size(), mesh_.rank);
    mesh_.n_global_elements = slices.n();
  }

  /// @param nodes that the corners are numbers in; they become the mesh's by ascending id
  void add_nodes(const std::vector<UsedNode<dim>>& nodes) {
    std::vector<int> order(nodes.size()), place_in_order(nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return nodes[a].id < nodes[b].id; });
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto& [id, x] = nodes[order[i]];
      place_in_order[order[i]] = static_cast<int>(i);
      mesh_.node_ids.push_back(id);
      mesh_.coordinates.push_back(Eigen::Map<const base::Point<dim>>(x.data()));
    }
    for (int& corner : mesh_.corners) corner = place_in_order[corner];
    mesh_.n_owned_nodes = comm_.getSize() == 1 ? mesh_.n_nodes() : 0;  // whose they are, distribute() finds
    mesh_.node_owners.assign(nodes.size(), 0);
  }

  void turn_reversed_elements() {
    std::size_t n_turned = 0, n_wrong = 0;
    std::optional<std::int64_t> first_turned, first_wrong;
    for (int e = 0; e < mesh_.n_elements(); ++e) {
      if (smallest_corner_volume(mesh_, e) > smallest_allowed_volume) continue;
      turn(e);
      if (smallest_corner_volume(mesh_, e) > smallest_allowed_volume) {
        if (n_turned++ == 0) first_turned = file_tags_[e];
      } else if (n_wrong++ == 0) {
        first_wrong = file_tags_[e];
      }
    }
    n_turned = sum(comm_, n_turned);
    n_wrong = sum(comm_, n_wrong);
    first_turned = first(comm_, first_turned);
    first_wrong = first(comm_, first_wrong);
    if (first_wrong) {
      remarks_.fail(
          "element {} is degenerate or not convex ({} of {} elements are): at each corner, the edges must span {}",
          *first_wrong, n_wrong, mesh_.n_global_elements, dim == 2 ? "an area" : "a volume");
    }
    if (first_turned) {
      remarks_.note("{} of {} elements have their nodes in reversed order and are turned (the first is element {})",
                    n_turned, mesh_.n_global_elements, *first_turned);
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

  // ---- sides and sets of the parts ----

  /// @return what add_sets() does
  std::vector<std::string> add_boundary_and_sets(const FileNodes<dim>& nodes, const FileGroups& groups) {
    const PartSides<dim> sides(mesh_);
    const auto lower = [](const Overlap& a, const Overlap& b) { return a.side < b.side; };
    if (const auto overlap = least(comm_, sides.first_overlap(), lower)) fail(*overlap);
    mesh_.boundary = sides.boundary();
    return add_sets(comm_, slice_, groups, nodes, sides, mesh_, remarks_);
  }

  /// Collective: the elements' tags are on the ranks that have read them.
  [[noreturn]] void fail(const Overlap& overlap) const {
    const auto& [first, second, third] = overlap.elements;
    const std::int64_t a = tag_of(first), b = tag_of(second);
    if (overlap.kind == Overlap::Kind::three_on_a_side) {
      remarks_.fail("elements {}, {} and {} share one side: they overlap", a, b, tag_of(third));
    }
    if (overlap.kind == Overlap::Kind::same_side) {
      remarks_.fail("elements {} and {} lie on the same side of the side they share: they overlap", a, b);
    }
    const auto& [block_a, block_b] = overlap.blocks;
    if (block_a == block_b) remarks_.fail("elements {} and {} have the same nodes", a, b);
    // MSH 2.2 repeats an element for each of its groups.
    remarks_.fail(
        "element {} is in two groups, \"{}\" and \"{}\" (there as element {}): each element must be in exactly one", a,
        mesh_.block_names[block_a], mesh_.block_names[block_b], b);
  }

  std::int64_t tag_of(GlobalId element) const {
    const auto index = static_cast<std::size_t>(element - first_element_);
    const bool is_here = element >= first_element_ && index < file_tags_.size();
    return base::sum(comm_, static_cast<GlobalId>(is_here ? file_tags_[index] : 0));
  }

  const base::Comm& comm_;
  const MeshFile& slice_;
  double scale_;
  Remarks remarks_;
  Mesh<dim> mesh_;                       // of the slice, then this rank's part
  std::vector<std::int64_t> file_tags_;  // of the slice's elements
  GlobalId first_element_ = 0;           // of the slice, its number in the mesh
  std::map<int, int> block_of_group_;
};

}  // namespace

template <int dim>
Mesh<dim> build_parts(const base::Comm& comm, const MeshFile& slice, double scale) {
  PERIMORPH_ASSERT(scale > 0., "coordinates are scaled by {}", scale);
  return MeshBuilder<dim>(comm, slice, scale).build();
}

template <int dim>
Mesh<dim> build_mesh(const MeshFile& file, double scale) {
  return build_parts<dim>(Teuchos::SerialComm<int>(), file, scale);
}

#define PERIMORPH_INSTANTIATE(dim)                                            \
  template Mesh<dim> build_parts(const base::Comm&, const MeshFile&, double); \
  template Mesh<dim> build_mesh(const MeshFile&, double);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh_files
