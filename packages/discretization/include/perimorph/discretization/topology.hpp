#pragma once

#include <memory>
#include <utility>

#include "perimorph/bonds/bond_families.hpp"
#include "perimorph/bonds/bonds_across_faces.hpp"
#include "perimorph/bonds/slip.hpp"
#include "perimorph/discretization/dof_map.hpp"
#include "perimorph/discretization/state.hpp"

namespace perimorph::discretization {

/// Which peridynamic elements get nodes of their own, beside those with a pre-crack through them: none, those with a
/// broken bond, or all.
enum class DiscontinuousElements { never, on_damage, whole_zone };

/// Whether crack faces may pass through each other, or press on each other (operators/contact_forces.hpp).
enum class CrackFaces { free, contact };

/// How a body is divided between the models.
template <int dim>
struct TopologyOptions {
  std::vector<morphing::Zone<dim>> seeds;
  std::vector<mesh::CrackFacet<dim>> pre_cracks;
  materials::BondMaterials materials;
  morphing::BlendingFunction blending_function;
  DiscontinuousElements discontinuous;
  double growth_inner_radius, growth_outer_radius;  ///< r_i, r_o of zones around flag points, [length]
  int points_per_direction = 2;                     ///< material points of an element
  bonds::StiffnessStorage stiffness = bonds::StiffnessStorage::stored;
  CrackFaces crack_faces = CrackFaces::free;
};

/// What follows from a state and is rebuilt from it, never stored: alpha, the bonds there are, the classes of elements,
/// which of them are discontinuous, and the numbering of unknowns.
template <int dim>
class Topology {
 public:
  /// Nothing is built yet. Collective. The mesh must outlive this.
  Topology(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh, TopologyOptions<dim> options);

  /// Alpha and bonds follow the flag points, growth by growth: the order of the bonds depends on it. Returns whether
  /// anything grew; the first time it does. Local (flag points are alike on all ranks).
  /// @param flag_points all since the beginning, those of earlier calls first
  bool grow(const std::vector<FlagPoint<dim>>& flag_points);

  /// What update() has changed.
  struct Change {
    bool models = false;     ///< classes or discontinuous elements
    bool numbering = false;  ///< of the unknowns
  };

  /// Classes, discontinuous elements and numbering follow alpha and damage. Collective.
  /// @param has_grown as grow() said
  /// @throws UserError the first time, if a pre-crack cuts through elements outside the peridynamic zone.
  Change update(bool has_grown);

  /// The local node before the last change of the numbering that each local node has parted from, (n_nodes). Local.
  std::vector<int> old_nodes() const;

  /// A displacement on the numbering before the last change of it, on the present one: nodes start where the node is
  /// that they have parted from; from none at all it is zero. Local.
  /// @param displacement on all local degrees of freedom of old_dofs(), or empty, [length]
  /// @return on those of dofs(), [length]
  std::vector<double> carried_over(const std::vector<double>& displacement) const;

  /// Makes the centroids of elements that are newly damaged flag points, by ascending element [WHL19,
  /// section 3.3, 3.4]; returns how many. Collective.
  /// @param flag_points to which they are added, alike on all ranks
  base::GlobalId flag_damaged_elements(std::vector<FlagPoint<dim>>& flag_points);

  /// Takes note of flag points that come from elsewhere, and of the damage in their elements. Local.
  void note_flags(const std::vector<FlagPoint<dim>>& flag_points);

  /// Marks bonds as broken or softened. Local.
  void take(const bonds::BondChange& change) { bonds_.take(change); }

  /// BondFamilies::recount_damage(). Local.
  void recount_damage() { bonds_.recount_damage(); }

  /// BondFamilies::accept_softening(). Local.
  void accept_softening() { bonds_.accept_softening(); }

  /// How crack faces have slid by now. Returns what friction has taken of this rank's since the last time, [energy].
  /// Local.
  double accept_slips(bonds::Slips<dim> slips) {
    const auto before = std::exchange(slips_, std::move(slips));
    return bonds::work_of_friction(before, slips_, mesh_.n_owned_elements);
  }

  /// BondFamilies::restore_softening(). Local.
  void restore_softening(const bonds::SofteningHistories& histories) { bonds_.restore_softening(histories); }

  // All local.
  bool is_built() const { return dofs_ != nullptr; }
  const mesh::Mesh<dim>& mesh() const { return mesh_; }
  const elements::MaterialPoints<dim>& points() const { return points_; }
  const morphing::MorphingField<dim>& alpha() const { return alpha_; }
  const bonds::BondFamilies<dim>& bonds() const { return bonds_; }
  CrackFaces crack_faces() const { return options_.crack_faces; }
  const std::vector<bonds::Bond<dim>>& bonds_across_faces() const { return bonds_across_faces_; }  ///< for contact
  const bonds::Slips<dim>& slips() const { return slips_; }                        ///< when they were last accepted
  const HaloExchange& element_exchange() const { return element_exchange_; }       ///< of values of local elements
  const std::vector<morphing::ElementClass>& classes() const { return classes_; }  ///< per element, in the halo too
  const std::vector<char>& discontinuous() const { return discontinuous_; }  ///< per element, right in the halo too
  base::GlobalId n_discontinuous() const { return n_discontinuous_; }        ///< over all ranks
  const DofMap<dim>& dofs() const {
    PERIMORPH_DEBUG_ASSERT(is_built(), "there is no numbering yet");
    return *dofs_;
  }
  /// The numbering before the last update(), until it is dropped: then, and if nothing changed, the present one.
  const DofMap<dim>& old_dofs() const { return old_dofs_ ? *old_dofs_ : *dofs_; }
  void drop_old_dofs() { old_dofs_.reset(); }

 private:
  Teuchos::RCP<const base::Comm> comm_;
  const mesh::Mesh<dim>& mesh_;
  TopologyOptions<dim> options_;

  elements::MaterialPoints<dim> points_;
  morphing::MorphingField<dim> alpha_;
  bonds::BondFamilies<dim> bonds_;
  std::vector<bonds::Bond<dim>> bonds_across_faces_;
  bonds::Slips<dim> slips_;
  HaloExchange element_exchange_, corner_exchange_;
  std::vector<char> cut_by_pre_crack_;  ///< per local element
  std::size_t n_grown_ = 0;             ///< flag points that alpha follows already
  bool has_seeds_ = false;              ///< alpha follows the seeds already

  std::vector<morphing::ElementClass> classes_;
  std::vector<char> discontinuous_;
  std::vector<char> flagged_;  ///< per owned element: it has a flag point
  base::GlobalId n_discontinuous_ = 0;
  std::unique_ptr<DofMap<dim>> dofs_, old_dofs_;

  void classify();
  bool find_discontinuous();
  void check_pre_cracks() const;
};

}  // namespace perimorph::discretization
