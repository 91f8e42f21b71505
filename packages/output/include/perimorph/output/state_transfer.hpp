#pragma once

#include "perimorph/discretization/saved_state.hpp"
#include "perimorph/fracture/body.hpp"
#include "perimorph/io/checkpoint.hpp"
#include "perimorph/mesh/refinement.hpp"

namespace perimorph::output {

/// Global ids of the elements that this rank owns, in the order of their displacements in a saved state. Local.
template <int dim>
std::vector<base::GlobalId> owned_ids(const mesh::Mesh<dim>& mesh);

/// A body's state as data sets of a checkpoint, of which each rank has a slice. Elements are in the order of their ids
/// and bonds in that of their points, so that the ranks leave no trace. Collective.
/// @param owned_elements owned_ids() of the mesh that the state belongs to
template <int dim>
io::Checkpoint slice_state(const base::Comm& comm, const discretization::SavedState<dim>& state,
                           const std::vector<base::GlobalId>& owned_elements);

/// The same of a body as it now is. Collective.
template <int dim>
io::Checkpoint slice_state(const base::Comm& comm, const fracture::Body<dim>& body);

/// The flag points of a state, on all ranks. Collective.
template <int dim>
std::vector<discretization::FlagPoint<dim>> share_flag_points(const base::Comm& comm, const io::Checkpoint& sliced);

/// A state on a finer mesh, in which all elements with bonds that have broken, softened or slid are what they
/// were; displacements are interpolated. All of it comes to rank 0 and stays there. Collective.
/// @param descents how the elements of that mesh descend from those that the state belongs to; on rank 0
template <int dim>
io::Checkpoint refine_state(const base::Comm& comm, const io::Checkpoint& sliced,
                            const std::vector<mesh::Descent>& descents);

/// What a rank needs of a state that all ranks have slices of, whatever their sizes: the displacement of all its local
/// elements, the bonds that it may hold, and all that is alike on all ranks. Collective.
template <int dim>
discretization::SavedState<dim> share_state(const base::Comm& comm, const io::Checkpoint& sliced,
                                            const mesh::Mesh<dim>& mesh);

}  // namespace perimorph::output
