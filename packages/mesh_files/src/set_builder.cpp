#include "set_builder.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>

#include "over_ranks.hpp"
#include "perimorph/base/directory.hpp"

namespace perimorph::mesh_files {

using mesh::Mesh;
using mesh::Side;

namespace {

constexpr GlobalId none = TagDirectory::none;  // place or id of a node
constexpr int unknown = -1;                    // owner

/// The local index of what has a global id, -1 if it is not here; the first n_owned of them ascend, and so do the
/// others.
int local_index(const std::vector<GlobalId>& ids, int n_owned, GlobalId id) {
  const auto end_of_owned = ids.begin() + n_owned;
  for (const auto& [first, end] : {std::pair(ids.begin(), end_of_owned), std::pair(end_of_owned, ids.end())}) {
    const auto found = std::lower_bound(first, end, id);
    if (found != end && *found == id) return static_cast<int>(found - ids.begin());
  }
  return -1;
}

template <class T, class Less>
void sort_unique(std::vector<T>& items, Less less) {
  std::sort(items.begin(), items.end(), less);
  const auto same = [&](const T& a, const T& b) { return !less(a, b) && !less(b, a); };
  items.erase(std::unique(items.begin(), items.end(), same), items.end());
}

template <int dim>
class SetBuilder {
 public:
  SetBuilder(const base::Comm& comm, const MeshFile& slice, const FileGroups& groups, const PartSides<dim>& sides,
             Mesh<dim>& part, Remarks& remarks)
      : comm_(comm), slice_(slice), groups_(groups), sides_(sides), part_(part), remarks_(remarks) {
    sets_.resize(static_cast<std::size_t>(groups.n()));
  }

  std::vector<std::string> build(const FileNodes<dim>& nodes) {
    find_elements();
    find_nodes(nodes);
    read_elements();
    send_nodes();
    send_sides(sides_of_owners());
    agree_on_elements_without_side();
    for (Set& set : sets_) {
      sort_unique(set.nodes, std::less<>());
      sort_unique(set.sides, std::less<>());
    }
    name_all();
    return std::move(sides_follow_from_);
  }

 private:
  /// Of one group: the nodes and sides of it that are this rank's own; and in all ranks' elements the first that is no
  /// side, though it should be.
  struct Set {
    std::vector<int> nodes;
    std::vector<Side> sides;
    std::optional<std::int64_t> element_without_side;
  };

  // Messages.
  struct NodeInGroup {
    int group;
    GlobalId node;
  };
  struct ElementInGroup {
    int group;
    GlobalId place;  // of the element among all ranks'
    std::int64_t tag;
    std::array<GlobalId, 4> nodes;  // as many as there are, then -1
  };
  struct SideInGroup {
    int group;
    GlobalId element;
    int side;
  };

  int dimension_of_group(int group) const { return groups_.key(group).first; }

  // ---- elements of the slice ----

  /// Elements of groups of lower dimension.
  void find_elements() {
    for (std::size_t e = 0; e < slice_.n_elements(); ++e) {
      if (dimension(slice_.shapes[e]) >= dim || groups_of(e).empty()) continue;
      elements_.push_back(e);
      for (std::size_t i = slice_.first_node[e]; i < slice_.first_node[e + 1]; ++i) {
        numbers_.push_back(tags_.number_of(slice_.element_nodes[i]));
      }
    }
  }

  const std::vector<int>& groups_of(std::size_t element) const {
    return slice_.group_lists[slice_.element_groups[element]];
  }

  /// Where the elements' nodes are in the file and in the mesh, and which rank owns them.
  void find_nodes(const FileNodes<dim>& nodes) {
    places_ = nodes.places_of(tags_.tags());
    base::on_all_ranks(comm_, [&] { check_nodes(); });
    ids_ = nodes.ids_of(places_);
    find_owners(nodes.n_used());
  }

  /// By a directory of all nodes of the mesh, which their owners tell that they are.
  void find_owners(GlobalId n_nodes) {
    owners_.assign(ids_.size(), 0);
    if (comm_.getSize() == 1) return;
    std::vector<GlobalId> items(part_.node_ids.begin(), part_.node_ids.begin() + part_.n_owned_nodes);
    std::copy_if(ids_.begin(), ids_.end(), std::back_inserter(items), [](GlobalId id) { return id != none; });
    const base::Directory directory(comm_, n_nodes, items);
    std::vector<int> owners(items.size(), unknown);
    std::fill_n(owners.begin(), part_.n_owned_nodes, comm_.getRank());
    owners = directory.answers(directory.collect(owners, unknown, [](int& owner, int said) {
      if (said != unknown) owner = said;
    }));
    auto next = owners.begin() + part_.n_owned_nodes;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (ids_[i] != none) owners_[i] = *next++;
    }
  }

  void check_nodes() const {
    auto number = numbers_.begin();
    for (const std::size_t e : elements_) {
      for (std::size_t i = slice_.first_node[e]; i < slice_.first_node[e + 1]; ++i) {
        if (places_[*number++] != none) continue;
        remarks_.fail("element {} has node {}, which the file does not list", slice_.element_tags[e],
                      slice_.element_nodes[i]);
      }
    }
  }

  /// Fills the messages to those who own the nodes.
  void read_elements() {
    nodes_to_.resize(static_cast<std::size_t>(comm_.getSize()));
    elements_to_.resize(nodes_to_.size());
    const GlobalId first = base::Slices::of(comm_, elements_.size()).begin(comm_.getRank());
    auto number = numbers_.begin();
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      const std::size_t e = elements_[i];
      std::vector<int> nodes(number, number + n_nodes(slice_.shapes[e]));
      number += n_nodes(slice_.shapes[e]);
      sort_unique(nodes, [&](int a, int b) { return places_[a] < places_[b]; });
      for (const int group : groups_of(e)) {
        read_element(groups_.index_of({dimension(slice_.shapes[e]), group}), e, first + static_cast<GlobalId>(i),
                     nodes);
      }
    }
  }

  /// @param nodes each once, in the file's order, by their numbers here
  void read_element(int group, std::size_t element, GlobalId place, const std::vector<int>& nodes) {
    ElementInGroup message = {group, place, slice_.element_tags[element], {-1, -1, -1, -1}};
    std::size_t n_used = 0;
    int owner_of_first = -1;
    for (const int node : nodes) {
      if (ids_[node] == none) continue;
      const int owner = owners_[node];
      nodes_to_[owner].push_back({group, ids_[node]});
      if (n_used == 0) owner_of_first = owner;
      message.nodes[n_used++] = ids_[node];
    }
    if (dimension_of_group(group) != dim - 1 || nodes.size() < dim)
      return;  // repeated nodes may leave nothing of a side
    if (n_used < nodes.size()) {
      is_without_side(message);
    } else {
      elements_to_[owner_of_first].push_back(message);
    }
  }

  void is_without_side(const ElementInGroup& element) {
    const auto [entry, is_new] = without_side_.emplace(element.group, element);
    if (!is_new && element.place < entry->second.place) entry->second = element;
  }

  // ---- at the owners of nodes and elements ----

  void send_nodes() {
    for (const auto& some : base::exchange(comm_, nodes_to_)) {
      for (const auto& [group, node] : some) {
        sets_[group].nodes.push_back(local_index(part_.node_ids, part_.n_owned_nodes, node));
      }
    }
  }

  /// The sides that the elements are: whoever owns a node has all elements around it.
  std::vector<std::vector<SideInGroup>> sides_of_owners() {
    std::vector<std::vector<SideInGroup>> found(nodes_to_.size());
    for (const auto& some : base::exchange(comm_, elements_to_)) {
      for (const ElementInGroup& element : some) {
        if (const Side side = side_of(element); side.element >= 0) {
          found[part_.element_owners[side.element]].push_back(
              {element.group, part_.element_ids[side.element], side.side});
        } else {
          is_without_side(element);
        }
      }
    }
    return found;
  }

  /// Of element -1 if there is none.
  Side side_of(const ElementInGroup& element) const {
    std::vector<int> nodes;
    for (const GlobalId id : element.nodes) {
      if (id < 0) break;
      nodes.push_back(local_index(part_.node_ids, part_.n_owned_nodes, id));
      if (nodes.back() < 0) return {-1, 0};
    }
    return sides_.side_with(nodes);
  }

  void send_sides(const std::vector<std::vector<SideInGroup>>& found) {
    for (const auto& some : base::exchange(comm_, found)) {
      for (const auto& [group, element, side] : some) {
        sets_[group].sides.push_back({local_index(part_.element_ids, part_.n_owned_elements, element), side});
      }
    }
  }

  void agree_on_elements_without_side() {
    std::vector<ElementInGroup> all;
    for (const auto& [group, element] : without_side_) all.push_back(element);
    all = base::gather_on_all(comm_, all);
    for (const ElementInGroup& element : all) is_without_side(element);
    for (const auto& [group, element] : without_side_) sets_[group].element_without_side = element.tag;
  }

  // ---- names ----

  void name_all() {
    std::map<std::string, std::vector<int>> groups_by_name;
    for (int group = 0; group < groups_.n(); ++group) {
      if (dimension_of_group(group) >= dim || !groups_.has_elements(group)) continue;
      groups_by_name[groups_.name(group)].push_back(group);
    }
    std::vector<double> n_ranks_that_differ, n_nodes, n_sides;
    for (const auto& [name, groups] : groups_by_name) {
      const bool all_alike = std::all_of(groups.begin(), groups.end(), [&, first = groups[0]](int group) {
        return sets_[group].nodes == sets_[first].nodes;
      });
      n_ranks_that_differ.push_back(all_alike ? 0. : 1.);
    }
    for (const Set& set : sets_) {
      n_nodes.push_back(static_cast<double>(set.nodes.size()));
      n_sides.push_back(static_cast<double>(set.sides.size()));
    }
    for (auto* counts : {&n_ranks_that_differ, &n_nodes, &n_sides}) base::sum(comm_, *counts);
    auto n_differ = n_ranks_that_differ.begin();
    for (const auto& [name, groups] : groups_by_name) {
      name_sets(name, groups, *n_differ++ == 0., n_nodes[groups[0]] > 0., n_sides);
    }
  }

  /// Only what a case uses must fit the mesh: of what does not, it finds that the group is not there.
  void name_sets(const std::string& name, const std::vector<int>& groups, bool are_alike, bool have_nodes,
                 const std::vector<double>& n_sides) {
    if (!are_alike) {
      return remarks_.note("the groups called \"{}\" are left out, since their nodes differ: give each its own name",
                           name);
    }
    if (!have_nodes) return remarks_.note("the group \"{}\" is left out: no {}D element has a node of it", name, dim);
    part_.node_sets[name] = sets_[groups[0]].nodes;
    bool has_nodes_only = true;
    for (const int group : groups) {
      has_nodes_only = has_nodes_only && dimension_of_group(group) == 0;
      if (dimension_of_group(group) == dim - 1) add_side_set(name, sets_[group], n_sides[group] > 0.);
    }
    if (has_nodes_only && slice_.sides_follow_from_node_sets) sides_follow_from_.push_back(name);
  }

  void add_side_set(const std::string& name, const Set& set, bool has_sides) {
    if (set.element_without_side) {
      return remarks_.note("the group \"{}\" has nodes but no sides: element {} of it is no side of any {}D element",
                           name, *set.element_without_side, dim);
    }
    if (!has_sides) {
      return remarks_.note("the group \"{}\" has nodes but no sides: repeated nodes leave nothing of them", name);
    }
    std::vector<Side>& sides_of_set = part_.side_sets[name];
    sides_of_set.insert(sides_of_set.end(), set.sides.begin(), set.sides.end());
    sort_unique(sides_of_set, std::less<>());
  }

  const base::Comm& comm_;
  const MeshFile& slice_;
  const FileGroups& groups_;
  const PartSides<dim>& sides_;
  Mesh<dim>& part_;
  Remarks& remarks_;

  std::vector<std::size_t> elements_;                     // of lower dimension in groups, in the slice
  TagNumbers tags_;                                       // of their nodes
  std::vector<int> numbers_;                              // of their nodes, one element after the other
  std::vector<GlobalId> places_, ids_;                    // of each node, in the file and in the mesh
  std::vector<int> owners_;                               // of each node of the mesh
  std::vector<std::vector<NodeInGroup>> nodes_to_;        // by rank
  std::vector<std::vector<ElementInGroup>> elements_to_;  // by rank
  std::map<int, ElementInGroup> without_side_;            // by group the first
  std::vector<Set> sets_;                                 // by group
  std::vector<std::string> sides_follow_from_;
};

}  // namespace

template <int dim>
std::vector<std::string> add_sets(const base::Comm& comm, const MeshFile& slice, const FileGroups& groups,
                                  const FileNodes<dim>& nodes, const PartSides<dim>& sides, Mesh<dim>& part,
                                  Remarks& remarks) {
  return SetBuilder<dim>(comm, slice, groups, sides, part, remarks).build(nodes);
}

template <int dim>
void add_sides_between(const base::Comm& comm, const std::vector<std::string>& sets, Mesh<dim>& part) {
  for (const std::string& name : sets) {
    const std::vector<int>& nodes = part.node_sets.at(name);
    const auto is_in_set = [&](int node) { return std::binary_search(nodes.begin(), nodes.end(), node); };
    std::vector<Side> between;
    for (const Side& side : part.boundary) {
      const std::vector<int> corners = side_nodes(part, side);
      if (std::all_of(corners.begin(), corners.end(), is_in_set)) between.push_back(side);
    }
    if (sum(comm, between.size()) > 0) part.side_sets[name] = std::move(between);
  }
}

#define PERIMORPH_INSTANTIATE(dim)                                                                                \
  template std::vector<std::string> add_sets(const base::Comm&, const MeshFile&, const FileGroups&,               \
                                             const FileNodes<dim>&, const PartSides<dim>&, Mesh<dim>&, Remarks&); \
  template void add_sides_between(const base::Comm&, const std::vector<std::string>&, Mesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh_files
