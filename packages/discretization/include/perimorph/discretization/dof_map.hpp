#pragma once

#include <Teuchos_RCP.hpp>
#include <Tpetra_Import_fwd.hpp>
#include <Tpetra_Map_fwd.hpp>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/discretization/halo_exchange.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::discretization {

/// Exchange of one value per element, from its owner to its copies.
template <int dim>
HaloExchange element_exchange(const base::Comm& comm, const mesh::Mesh<dim>& mesh);

/// Exchange of one value per corner of an element, from the owner of its reference node to all copies.
template <int dim>
HaloExchange corner_exchange(const base::Comm& comm, const mesh::Mesh<dim>& mesh);

/// The degrees of freedom of the current topology. Continuous elements share one node per node of the reference mesh;
/// every discontinuous element (DGFE) has nodes of its own [WHL19, section 3.2]. Global numbers are contiguous by rank.
/// A node belongs to the rank that owns its reference node. Local nodes: owned ones first, then copies of others'.
/// Degree of freedom c of node n is n * dim + c, local and global.
template <int dim>
class DofMap {
 public:
  using Map = Tpetra::Map<>;
  using Import = Tpetra::Import<>;

  /// Collective. The mesh must outlive this.
  /// @param corners made by corner_exchange() of this mesh
  /// @param discontinuous per local element, right in the halo too
  DofMap(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh, const HaloExchange& corners,
         const std::vector<char>& discontinuous);

  int n_nodes() const { return static_cast<int>(reference_nodes_.size()); }
  int n_owned_nodes() const { return n_owned_nodes_; }
  base::GlobalId n_global_nodes() const { return n_global_nodes_; }

  /// Local node at each corner of a local element, (n_corners).
  const int* nodes_of(int element) const {
    PERIMORPH_DEBUG_ASSERT(element >= 0 && element < mesh_.n_elements(), "element {} of {}", element,
                           mesh_.n_elements());
    return node_at_corner_.data() + mesh_.first_corner[element];
  }
  /// The local node of the reference mesh that a node stands on.
  int reference_node(int node) const {
    PERIMORPH_DEBUG_ASSERT(node >= 0 && node < n_nodes(), "node {} of {}", node, n_nodes());
    return reference_nodes_[node];
  }
  base::GlobalId global_node(int node) const {
    PERIMORPH_DEBUG_ASSERT(node >= 0 && node < n_nodes(), "node {} of {}", node, n_nodes());
    return global_nodes_[node];
  }

  /// Degrees of freedom that this rank owns, and those with all copies (owned first).
  const Teuchos::RCP<const Map>& owned_dofs() const { return owned_dofs_; }
  const Teuchos::RCP<const Map>& all_dofs() const { return all_dofs_; }
  const Teuchos::RCP<const Import>& import() const { return import_; }

 private:
  const mesh::Mesh<dim>& mesh_;
  std::vector<int> node_at_corner_, reference_nodes_;
  std::vector<base::GlobalId> global_nodes_;
  int n_owned_nodes_ = 0;
  base::GlobalId n_global_nodes_ = 0;
  Teuchos::RCP<const Map> owned_dofs_, all_dofs_;
  Teuchos::RCP<const Import> import_;

  std::vector<base::GlobalId> number_owned(const base::Comm& comm, const std::vector<char>& discontinuous);
  void add_copies(const std::vector<base::GlobalId>& global_at_corner);
  void make_maps(const Teuchos::RCP<const base::Comm>& comm);
};

}  // namespace perimorph::discretization
