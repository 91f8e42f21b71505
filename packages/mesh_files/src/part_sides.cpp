#include "part_sides.hpp"

#include <algorithm>

#include "perimorph/base/errors.hpp"

namespace perimorph::mesh_files {

using base::GlobalId;
using mesh::KeyedSide;
using mesh::Side;
using mesh::SideKey;

template <int dim>
PartSides<dim>::PartSides(const mesh::Mesh<dim>& part) : part_(part), sides_(mesh::sorted_sides(part)) {}

/// Visits the sides in groups of those with the same nodes: their key, and the sides, the one of the element with the
/// lowest global id first.
template <int dim>
template <class Visit>
void PartSides<dim>::for_all(const Visit& visit) const {
  const auto by_id = [&](const Side& a, const Side& b) {
    return part_.element_ids[a.element] < part_.element_ids[b.element];
  };
  Sides together;
  for (std::size_t first = 0, next = 0; first < sides_.size(); first = next) {
    together.clear();
    for (next = first; next < sides_.size() && sides_[next].key == sides_[first].key; ++next) {
      together.push_back(sides_[next].side);
    }
    std::sort(together.begin(), together.end(), by_id);
    visit(sides_[first].key, together);
  }
}

template <int dim>
bool PartSides<dim>::has_own_node(const SideKey& key) const {
  return std::any_of(key.begin(), key.end(), [&](int node) { return node >= 0 && node < part_.n_owned_nodes; });
}

template <int dim>
std::optional<Overlap> PartSides<dim>::first_overlap() const {
  std::optional<Overlap> lowest;
  for_all([&](const SideKey& key, const Sides& sides) {
    if (sides.size() == 1 || !has_own_node(key)) return;
    const auto overlap = overlap_at(key, sides);
    if (overlap && (!lowest || overlap->side < lowest->side)) lowest = overlap;
  });
  return lowest;
}

/// A side has two elements, which see it from opposite sides; anything else is an overlap.
template <int dim>
std::optional<Overlap> PartSides<dim>::overlap_at(const SideKey& key, const Sides& sides) const {
  const int first = sides[0].element, second = sides[1].element;
  Overlap overlap = {{-1, -1, -1, -1},
                     Overlap::Kind::same_nodes,
                     {part_.element_ids[first], part_.element_ids[second], -1},
                     {part_.blocks[first], part_.blocks[second]}};
  for (std::size_t i = 0; i < key.size(); ++i) {
    if (key[i] >= 0) overlap.side[i] = part_.node_ids[key[i]];
  }
  std::sort(overlap.side.begin(), overlap.side.end());
  if (same_nodes(first, second)) return overlap;
  if (sides.size() > 2) {
    overlap.kind = Overlap::Kind::three_on_a_side;
    overlap.elements[2] = part_.element_ids[sides[2].element];
    return overlap;
  }
  overlap.kind = Overlap::Kind::same_side;
  return run_alike(sides[0], sides[1]) ? std::optional(overlap) : std::nullopt;
}

/// Whether two sides with the same nodes run round them in the same sense.
template <int dim>
bool PartSides<dim>::run_alike(const Side& a, const Side& b) const {
  const std::vector<int> nodes_a = side_nodes(part_, a), nodes_b = side_nodes(part_, b);
  const auto start = static_cast<std::size_t>(std::find(nodes_b.begin(), nodes_b.end(), nodes_a[0]) - nodes_b.begin());
  if (dim == 2) return start == 0;
  return nodes_b[(start + 1) % nodes_b.size()] == nodes_a[1];
}

template <int dim>
bool PartSides<dim>::same_nodes(int a, int b) const {
  const int n = part_.n_corners(a);
  return n == part_.n_corners(b) &&
         std::is_permutation(part_.corners_of(a), part_.corners_of(a) + n, part_.corners_of(b));
}

template <int dim>
std::vector<Side> PartSides<dim>::boundary() const {
  std::vector<Side> boundary;
  for_all([&](const SideKey&, const Sides& sides) {
    if (sides.size() == 1 && sides[0].element < part_.n_owned_elements) boundary.push_back(sides[0]);
  });
  std::sort(boundary.begin(), boundary.end());
  return boundary;
}

template <int dim>
Side PartSides<dim>::side_with(const std::vector<int>& nodes) const {
  const SideKey key = mesh::side_key(nodes);
  auto found = std::lower_bound(sides_.begin(), sides_.end(), key,
                                [](const KeyedSide& side, const SideKey& k) { return side.key < k; });
  Side lowest = {-1, 0};
  for (; found != sides_.end() && found->key == key; ++found) {
    const Side& side = found->side;
    if (lowest.element < 0 || part_.element_ids[side.element] < part_.element_ids[lowest.element]) lowest = side;
  }
  return lowest;
}

template class PartSides<2>;
template class PartSides<3>;

}  // namespace perimorph::mesh_files
