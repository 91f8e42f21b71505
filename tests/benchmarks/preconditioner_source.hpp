#pragma once

#include "perimorph/operators/point_basis.hpp"
#include "perimorph/solvers/linear_solver.hpp"
#include "support/coupled_body.hpp"

namespace perimorph::tests {

/// What the program sets its preconditioner up from.
struct PreconditionerSource {
  Teuchos::RCP<const operators::PointBasis<2>> basis;  ///< null: the unknowns are those of nodes
  std::unique_ptr<operators::StiffnessMatrix<2>> stiffness;
  solvers::NearNullSpace modes;
};

/// With "Preconditioner Matrix" = "Coupled".
inline PreconditionerSource coupled(const CoupledBody& body) {
  auto stiffness = body.matrix_of(operators::all_bonds, Teuchos::null);
  const auto modes = solvers::rigid_body_modes<2>(*stiffness->matrix(), body.node_coordinates());
  return {Teuchos::null, std::move(stiffness), modes};
}

/// With "Short-Range" and the default cut-off.
inline PreconditionerSource short_range(const CoupledBody& body, double horizon) {
  const auto basis = body.point_basis();
  const auto bonds =
      operators::short_range(body.model(), *body.comm, operators::default_short_range_cut_off(2) * horizon);
  auto stiffness = body.matrix_of(bonds, basis);
  auto coordinates = body.node_coordinates();
  basis->move_to_points(coordinates);
  const auto modes = solvers::rigid_body_modes<2>(*stiffness->matrix(), coordinates);
  return {basis, std::move(stiffness), modes};
}

}  // namespace perimorph::tests
