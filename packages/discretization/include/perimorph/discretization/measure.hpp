#pragma once

#include <optional>
#include <string>
#include <vector>

#include "perimorph/base/field.hpp"
#include "perimorph/discretization/dof_map.hpp"
#include "perimorph/elements/locator.hpp"

namespace perimorph::discretization {

/// A point of the body that this rank samples.
struct Sampled {
  int place;  ///< in the list of those that were asked for
  elements::Location location;
};

/// Which of these points this rank samples: each is in the element of the lowest global id that holds it, whatever the
/// ranks, and on no rank if it is outside the body. Collective.
template <int dim>
std::vector<Sampled> sampled_here(const base::Comm& comm, const mesh::Mesh<dim>& mesh,
                                  const std::vector<base::Point<dim>>& places);

/// Where a displacement is measured: at a point, or in the mean over the nodes of a group.
template <int dim>
struct MeasuredPlace {
  std::string group;
  std::optional<base::Point<dim>> point = {};  ///< instead of the group, [length]
};

/// What is measured: the displacement of a place in a direction, or how much further it moves than another.
template <int dim>
struct MeasuredDisplacement {
  MeasuredPlace<dim> place;
  std::optional<MeasuredPlace<dim>> other;
  base::Point<dim> direction;  ///< of length 1
};

/// A number that is linear in the displacement, in one mesh and in each of its topologies: where elements have parted
/// at a node of a group, it takes the mean of their displacements.
template <int dim>
class Measure {
 public:
  /// Collective. @throws UserError if a point is outside the mesh, or a group has no nodes
  Measure(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const MeasuredDisplacement<dim>& measured);

  /// The same number on all ranks, [length]. Collective.
  /// @param u displacement on all local degrees of freedom, [length]
  double of(const base::Comm& comm, const DofMap<dim>& dofs, base::ConstField u) const;

 private:
  struct Share {
    int element, corner;
    base::Point<dim> weight;
  };
  std::vector<Share> shares_;  ///< whose sum over all ranks it is

  void add_point(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const base::Point<dim>& x,
                 const base::Point<dim>& direction);
  void add_group(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const std::string& group,
                 const base::Point<dim>& direction);
};

}  // namespace perimorph::discretization
