#include "perimorph/solvers/multigrid.hpp"

#include <MueLu_CreateTpetraPreconditioner.hpp>
#include <Tpetra_CrsMatrix.hpp>

#include "perimorph/base/errors.hpp"

namespace perimorph::solvers {

namespace {

/// The largest eigenvalues belong to a few discontinuous elements: ten power iterations miss them, and a Chebyshev
/// smoother then amplifies what it should damp, until the preconditioner is indefinite and CG breaks down. Thirty find
/// them; Gauss-Seidel needs none, at twice the time. The drop tolerance halves the iterations with damage.
Teuchos::ParameterList default_parameters(Multigrid::Smoothing smoothing) {
  Teuchos::ParameterList list("MueLu");
  list.set("verbosity", "none");
  auto& smoother = list.sublist("smoother: params");
  if (smoothing == Multigrid::Smoothing::fast) {
    list.set("smoother: type", "CHEBYSHEV");
    smoother.set("chebyshev: degree", 1);
    smoother.set("chebyshev: ratio eigenvalue", 4.);
    smoother.set("chebyshev: eigenvalue max iterations", 30);
  } else {
    list.set("smoother: type", "RELAXATION");
    smoother.set("relaxation: type", "Symmetric Gauss-Seidel");
    smoother.set("relaxation: sweeps", 1);
  }
  list.set("aggregation: drop tol", 0.02);
  list.set("coarse: max size", 100);
  list.set("coarse: type", "RELAXATION");
  auto& coarse = list.sublist("coarse: params");
  coarse.set("relaxation: type", "Symmetric Gauss-Seidel");
  coarse.set("relaxation: sweeps", 20);
  if (smoothing == Multigrid::Smoothing::one_level) {
    list.set("max levels", 1);
    // Between ranks the sweeps are Jacobi's: one of them is positive definite for sure, several are not.
    coarse.set("relaxation: sweeps", 1);
  }
  list.set("reuse: type", "RP");
  return list;
}

}  // namespace

struct Multigrid::Hierarchy {
  Teuchos::RCP<Matrix> matrix;
  Teuchos::RCP<MueLu::TpetraOperator<double, int, base::GlobalId, Matrix::node_type>> preconditioner;
};

template <int dim>
NearNullSpace rigid_body_modes(const Matrix& matrix, const std::vector<base::Point<dim>>& coordinates) {
  using Map = Tpetra::Map<>;
  constexpr int n_rotations = dim * (dim - 1) / 2;
  const auto dof_map = matrix.getRowMap();
  const auto node_map =
      Teuchos::rcp(new Map(dof_map->getGlobalNumElements() / dim, coordinates.size(), 0, dof_map->getComm()));
  NearNullSpace space{Teuchos::rcp(new MultiVector(dof_map, dim + n_rotations)),
                      Teuchos::rcp(new MultiVector(node_map, dim))};
  const auto modes = space.modes->getLocalViewHost(Tpetra::Access::OverwriteAll);
  const auto positions = space.coordinates->getLocalViewHost(Tpetra::Access::OverwriteAll);
  Kokkos::deep_copy(modes, 0.);
  for (std::size_t n = 0; n < coordinates.size(); ++n) {
    const auto& x = coordinates[n];
    for (int c = 0; c < dim; ++c) {
      positions(n, c) = x[c];
      modes(n * dim + c, c) = 1.;
    }
    int mode = dim;
    for (int i = 0; i < dim; ++i) {  // rotation in the plane of axes i and j
      for (int j = i + 1; j < dim; ++j, ++mode) {
        modes(n * dim + i, mode) = -x[j];
        modes(n * dim + j, mode) = x[i];
      }
    }
  }
  return space;
}

Multigrid::Multigrid(const Teuchos::RCP<Matrix>& matrix, const NearNullSpace& near_null_space,
                     const Teuchos::ParameterList& overrides, Smoothing smoothing)
    : hierarchy_(std::make_unique<Hierarchy>()) {
  Teuchos::ParameterList list = default_parameters(smoothing);
  list.setParameters(overrides);
  list.set("number of equations", static_cast<int>(near_null_space.coordinates->getNumVectors()));
  auto& data = list.sublist("user data");
  data.set("Nullspace", near_null_space.modes);
  data.set("Coordinates", near_null_space.coordinates);
  hierarchy_->matrix = matrix;
  hierarchy_->preconditioner = MueLu::CreateTpetraPreconditioner(Teuchos::rcp_static_cast<Operator>(matrix), list);
  operator_ = hierarchy_->preconditioner;
}

Multigrid::~Multigrid() = default;

void Multigrid::refresh() { MueLu::ReuseTpetraPreconditioner(hierarchy_->matrix, *hierarchy_->preconditioner); }

template NearNullSpace rigid_body_modes<2>(const Matrix&, const std::vector<base::Point<2>>&);
template NearNullSpace rigid_body_modes<3>(const Matrix&, const std::vector<base::Point<3>>&);

}  // namespace perimorph::solvers
