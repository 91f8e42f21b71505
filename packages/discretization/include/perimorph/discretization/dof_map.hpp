#pragma once

#include <Teuchos_RCP.hpp>
#include <Tpetra_Import_fwd.hpp>
#include <Tpetra_Map_fwd.hpp>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/field.hpp"
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
/// A node belongs to the rank that owns its reference node. Local nodes: owned ones first, then copies of others', then
/// mirror images of those beyond planes of symmetry, which have no degrees of freedom over all ranks.
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

  const mesh::Mesh<dim>& mesh() const { return mesh_; }
  int n_nodes() const { return static_cast<int>(reference_nodes_.size()); }
  int n_owned_nodes() const { return n_owned_nodes_; }
  int n_real_nodes() const { return n_nodes() - static_cast<int>(images_.size()); }
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

  /// The mirror image of a node: its displacement is that node's, each component with a sign.
  struct Image {
    int node;                ///< local, that it is the image of
    base::Point<dim> signs;  ///< 1 or -1
  };
  const std::vector<Image>& images() const { return images_; }  ///< those of the last nodes, in their order
  const Image& image(int node) const {
    PERIMORPH_DEBUG_ASSERT(node >= n_real_nodes() && node < n_nodes(), "image {} of {} nodes", node, n_nodes());
    return images_[node - n_real_nodes()];
  }
  /// Local degrees of freedom across planes of symmetry, of the nodes on them that continuous elements share with their
  /// images: these stay where they are. Ascending.
  const std::vector<int>& across_planes() const { return across_planes_; }
  /// Makes the values at images what they are by those of their nodes. Local. @param values (n_nodes, dim)
  void complete_images(base::Field values) const;

  /// Degrees of freedom that this rank owns, and those with all copies (owned first).
  const Teuchos::RCP<const Map>& owned_dofs() const { return owned_dofs_; }
  const Teuchos::RCP<const Map>& all_dofs() const { return all_dofs_; }
  const Teuchos::RCP<const Import>& import() const { return import_; }

 private:
  const mesh::Mesh<dim>& mesh_;
  std::vector<int> node_at_corner_, reference_nodes_;
  std::vector<base::GlobalId> global_nodes_;
  std::vector<Image> images_;
  std::vector<int> across_planes_;
  int n_owned_nodes_ = 0;
  base::GlobalId n_global_nodes_ = 0;
  Teuchos::RCP<const Map> owned_dofs_, all_dofs_;
  Teuchos::RCP<const Import> import_;

  std::vector<base::GlobalId> number_owned(const base::Comm& comm, const std::vector<char>& discontinuous);
  void add_copies(const std::vector<base::GlobalId>& global_at_corner);
  void add_images();
  void find_across_planes(const std::vector<char>& discontinuous);
  void make_maps(const Teuchos::RCP<const base::Comm>& comm);
};

}  // namespace perimorph::discretization
