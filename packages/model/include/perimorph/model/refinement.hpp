#pragma once

#include "perimorph/discretization/state.hpp"
#include "perimorph/mesh/refinement.hpp"
#include "perimorph/model/numerical_options.hpp"
#include "perimorph/model/problem.hpp"

namespace perimorph::model {

/// The whole mesh of a body, refined where the peridynamic zone is and where its cracks will soon take it. It follows
/// from the root mesh, the problem and the flag points, so that it need not be saved. On rank 0; other ranks have an
/// empty mesh, and the same answers. A mesh that stays as it is may also be in parts.
template <int dim>
class Refinement {
 public:
  using FlagPoints = std::vector<discretization::FlagPoint<dim>>;

  /// Refined around seeds, and around pre-cracks that cut through elements, which may then run along sides of smaller
  /// ones, and open. Collective; the problem must outlive this.
  /// @param root the mesh of the case, whole, on rank 0; or, if it is to stay as it is, what each rank has of it
  /// @throws UserError on all ranks if elements would have to be divided that cannot be
  Refinement(Teuchos::RCP<const base::Comm> comm, mesh::Mesh<dim> root, const Problem<dim>& problem,
             const NumericalOptions& options);

  bool is_refined() const { return options_.levels > 0; }
  const mesh::Mesh<dim>& mesh() const { return is_refined() ? refined_.mesh : root_; }
  /// Of a mesh that is not refined, frees what rank 0 has: once it is distributed, nobody needs it any more. Local.
  void free_unrefined() {
    if (!is_refined()) root_ = {};
  }

  /// Whether the elements at hanging nodes are beyond the reach of bonds in zones around all flag points. Collective.
  /// @param flag_points all since the beginning, those of earlier calls first
  bool serves(const FlagPoints& flag_points);

  /// Refines around flag points, further around the last ones. Collective. @throws UserError as above
  /// @return on rank 0: how the elements of the mesh descend from those it had before
  std::vector<mesh::Descent> follow(const FlagPoints& flag_points);

  /// The mesh that a body had after follow() was called with so many of its flag points, one call after the other.
  /// Collective.
  void go_to(const FlagPoints& flag_points, std::vector<base::GlobalId> calls);
  const std::vector<base::GlobalId>& calls() const { return calls_; }

  /// What it saves, a line for the user. Local, on rank 0.
  std::string description() const;
  /// That nothing is refined, and where smaller elements at a curved boundary lie on larger ones' straight sides so
  /// that it matters. Local, on rank 0.
  std::vector<std::string> warnings() const;

 private:
  /// An element that could be divided, by the ball around it.
  struct CoarseElement {
    base::Point<dim> center;
    double radius, finest_radius;  ///< of it, and of those that it could be divided into, [length]
  };

  Teuchos::RCP<const base::Comm> comm_;
  mesh::Mesh<dim> root_;
  const Problem<dim>& problem_;
  RefinementOptions options_;
  double zone_radius_;  ///< around flag points, [length]
  mesh::RefinedMesh<dim> refined_;
  std::vector<CoarseElement> coarse_;
  std::vector<base::Point<dim>> places_on_cracks_;  ///< that cut through elements
  std::vector<base::Point<dim>> places_of_groups_;  ///< around which elements are to be finest, too
  double spacing_ = 0.;                             ///< of all these places, [length]
  std::vector<base::GlobalId> calls_;
  std::size_t n_served_ = 0;  ///< flag points that are known to be

  void find_cracks();
  void find_groups();
  void refine(const FlagPoints& flag_points);
  void perturb();  // on rank 0
  std::vector<base::Point<dim>> newest_at(const FlagPoints& flag_points) const;
};

}  // namespace perimorph::model
