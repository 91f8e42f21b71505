#pragma once

#include <array>
#include <optional>
#include <vector>

#include "perimorph/mesh/sorted_sides.hpp"

namespace perimorph::mesh_files {

/// Elements that overlap, since more than two have a side in common, or two that lie on the same side of it.
struct Overlap {
  enum class Kind { same_nodes, three_on_a_side, same_side };
  std::array<base::GlobalId, 4> side;  ///< its nodes in the whole mesh, after -1 in each unused place
  Kind kind;
  std::array<base::GlobalId, 3> elements;  ///< in the whole mesh, ascending; two, or three on a side
  std::array<int, 2> blocks;               ///< of the first two
};

/// The sides of all elements of a rank's part of a mesh, which has all elements around its own nodes, and all that
/// have a side in common with its own elements. Local.
template <int dim>
class PartSides {
 public:
  /// @param part is kept as a reference
  explicit PartSides(const mesh::Mesh<dim>& part);

  /// Of elements around nodes of this rank, the overlap at the lowest side of the whole mesh.
  std::optional<Overlap> first_overlap() const;

  /// Sides of own elements that belong to one element only, ascending.
  std::vector<mesh::Side> boundary() const;

  /// The side with these nodes, of the element with the lower global id if two have it; of element -1 if none has.
  /// @param nodes local, (2 in 2D, 3 or 4 in 3D), one of them this rank's own
  mesh::Side side_with(const std::vector<int>& nodes) const;

 private:
  using Sides = std::vector<mesh::Side>;

  template <class Visit>
  void for_all(const Visit& visit) const;
  bool has_own_node(const mesh::SideKey& key) const;
  std::optional<Overlap> overlap_at(const mesh::SideKey& key, const Sides& sides) const;
  bool same_nodes(int a, int b) const;
  bool run_alike(const mesh::Side& a, const mesh::Side& b) const;

  const mesh::Mesh<dim>& part_;
  std::vector<mesh::KeyedSide> sides_;
};

}  // namespace perimorph::mesh_files
