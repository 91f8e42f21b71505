#include "perimorph/solvers/multigrid.hpp"

#include <MueLu_CreateTpetraPreconditioner.hpp>
#include <MueLu_Utilities.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_RowMatrixTransposer.hpp>
#include <algorithm>

#include "gathered_levels.hpp"
#include "perimorph/base/errors.hpp"
#include "single_precision_cycle.hpp"

namespace perimorph::solvers {

namespace {

/// The drop tolerance halves the iterations with damage. With sums of absolute values in place of the diagonal no
/// eigenvalue need be estimated: none exceeds 1.
Teuchos::ParameterList default_parameters(Multigrid::Cycle cycle) {
  Teuchos::ParameterList list("MueLu");
  list.set("verbosity", "none");
  list.set("aggregation: drop tol", 0.02);
  list.set("sa: use rowsumabs diagonal scaling", true);
  list.set("sa: max eigenvalue", 1.);
  list.set("coarse: max size", 100);
  list.set("reuse: type", "RP");
  if (cycle == Multigrid::Cycle::fast) {  // our own cycle has its own smoother
    list.set("smoother: pre or post", "none");
    list.set("coarse: type", "none");
    return list;
  }
  list.set("smoother: type", "RELAXATION");
  auto& smoother = list.sublist("smoother: params");
  smoother.set("relaxation: type", "Symmetric Gauss-Seidel");
  smoother.set("relaxation: sweeps", 1);
  list.set("coarse: type", "RELAXATION");
  auto& coarse = list.sublist("coarse: params");
  coarse.set("relaxation: type", "Symmetric Gauss-Seidel");
  coarse.set("relaxation: sweeps", 20);
  if (cycle == Multigrid::Cycle::one_level) {
    list.set("max levels", 1);
    // Between ranks the sweeps are Jacobi's: one of them is positive definite for sure, several are not.
    coarse.set("relaxation: sweeps", 1);
  }
  return list;
}

/// Lets the level managers be seen, which MueLu protects.
struct OpenHierarchy : MueLu::Hierarchy<double, int, base::GlobalId, Matrix::node_type> {
  using Hierarchy::GetLevelManager;
};

using Preconditioner = MueLu::TpetraOperator<double, int, base::GlobalId, Matrix::node_type>;

/// Aggregates do not reach beyond their rank: below so many rows for each rank levels hardly get coarser, and MueLu
/// need not make them. Our cycle has others in their place (Hierarchy::levels()), unless all ranks are to hold all
/// levels.
void stop_at_few_rows(Teuchos::ParameterList& list, int n_holders) {
  constexpr int few = 9;
  if (n_holders > 1) list.set("coarse: max size", std::max(list.get<int>("coarse: max size"), few * n_holders));
}

std::vector<CycleLevel> levels_of(const Preconditioner& preconditioner) {
  using LevelMatrix = Xpetra::Matrix<double, int, base::GlobalId, Matrix::node_type>;
  using Utilities = MueLu::Utilities<double, int, base::GlobalId, Matrix::node_type>;
  const auto hierarchy = preconditioner.GetHierarchy();
  const auto matrix = [&](int level, const char* name) {
    return Utilities::Op2TpetraCrs(hierarchy->GetLevel(level)->template Get<Teuchos::RCP<LevelMatrix>>(name));
  };
  std::vector<CycleLevel> levels;
  for (int l = 0; l < hierarchy->GetNumLevels(); ++l) {
    levels.push_back({matrix(l, "A"), Teuchos::null, Teuchos::null});
    if (l == 0) continue;
    levels[l - 1].restriction = matrix(l, "R");
    levels[l - 1].prolongation = matrix(l, "P");
  }
  return levels;
}

/// Near null space of a level that MueLu has made, and made another from; otherwise null. Local.
Teuchos::RCP<const MultiVector> modes_of(const Preconditioner& preconditioner, int level) {
  using Modes = Xpetra::MultiVector<double, int, base::GlobalId, Matrix::node_type>;
  using Utilities = MueLu::Utilities<double, int, base::GlobalId, Matrix::node_type>;
  const auto hierarchy = preconditioner.GetHierarchy();
  if (level + 1 >= hierarchy->GetNumLevels()) return Teuchos::null;
  const auto factory = (hierarchy.get()->*(&OpenHierarchy::GetLevelManager))(level)->GetFactory("Nullspace");
  return Utilities::MV2TpetraMV(
      hierarchy->GetLevel(level)->template Get<Teuchos::RCP<Modes>>("Nullspace", factory.get()));
}

/// New values of the matrix that it was made for, whose pattern may be another. Collective.
void reuse(const Teuchos::RCP<Matrix>& matrix, Preconditioner& preconditioner) {
  // Tpetra leaves out of a product's pattern what is zero by the values at hand. With others the pattern may be too
  // small, and it throws on the rank where that is so, while the others wait for it: the coarse matrices get new
  // patterns.
  const auto hierarchy = preconditioner.GetHierarchy();
  for (int l = 1; l < hierarchy->GetNumLevels(); ++l) {
    const auto products = (hierarchy.get()->*(&OpenHierarchy::GetLevelManager))(l)->GetFactory("A");
    for (const char* name : {"AP reuse data", "RAP reuse data"}) hierarchy->GetLevel(l)->Delete(name, products.get());
  }
  MueLu::ReuseTpetraPreconditioner(matrix, preconditioner);
}

/// Rows of blocks as sums of another matrix's, with the same columns. Collective.
Teuchos::RCP<Matrix> weighted_rows(const Matrix& matrix, const Teuchos::RCP<const Tpetra::Map<>>& rows,
                                   const base::NodeWeights& weights, int block_size) {
  using Local = Matrix::local_matrix_device_type;
  const auto local = matrix.getLocalMatrixHost();
  std::vector<std::size_t> row_starts = {0};
  std::vector<int> columns;
  std::vector<double> values, sums(local.numCols(), 0.);
  std::vector<int> seen_by(local.numCols(), -1);
  for (const auto& node : weights) {
    for (int c = 0; c < block_size; ++c) {
      const auto row = static_cast<int>(row_starts.size());
      for (const auto& [other, weight] : node) {
        for (auto k = local.graph.row_map(other * block_size + c); k < local.graph.row_map(other * block_size + c + 1);
             ++k) {
          const int column = local.graph.entries(k);
          if (seen_by[column] != row) {
            seen_by[column] = row;
            sums[column] = 0.;
            columns.push_back(column);
          }
          sums[column] += weight * local.values(k);
        }
      }
      const auto begin = columns.begin() + static_cast<std::ptrdiff_t>(row_starts.back());
      std::sort(begin, columns.end());
      std::transform(begin, columns.end(), std::back_inserter(values), [&](int column) { return sums[column]; });
      row_starts.push_back(columns.size());
    }
  }
  const auto copied = [](auto view, const auto& from) {
    std::copy(from.begin(), from.end(), view.data());
    return view;
  };
  const auto result = Teuchos::rcp(
      new Matrix(rows, matrix.getColMap(),
                 copied(typename Local::row_map_type::non_const_type("row starts", row_starts.size()), row_starts),
                 copied(typename Local::index_type("columns", columns.size()), columns),
                 copied(typename Local::values_type("values", values.size()), values)));
  result->expertStaticFillComplete(matrix.getDomainMap(), rows, matrix.getGraph()->getImporter());
  return result;
}

}  // namespace

struct Multigrid::Hierarchy {
  Teuchos::RCP<Matrix> matrix;
  Teuchos::ParameterList defaults, overrides;
  /// MueLu's: of the matrix, and each other one of a level of the one before that fewer ranks hold.
  std::vector<Teuchos::RCP<Preconditioner>> stages;

  void add_stage(const Teuchos::RCP<Matrix>& of, int n_holders, const NearNullSpace& near_null_space, int block_size) {
    Teuchos::ParameterList list = defaults;
    stop_at_few_rows(list, n_holders);
    list.setParameters(overrides);
    list.set("number of equations", block_size);
    auto& data = list.sublist("user data");
    data.set("Nullspace", near_null_space.modes);
    if (!near_null_space.coordinates.is_null()) data.set("Coordinates", near_null_space.coordinates);
    stages.push_back(MueLu::CreateTpetraPreconditioner(Teuchos::rcp_static_cast<Operator>(of), list));
  }

  /// A stage's levels end with the first that fewer ranks hold; from there on the next stage has aggregates that reach
  /// as far as the rows of those ranks. Collective.
  std::vector<CycleLevel> levels(int rows_per_rank) {
    std::vector<CycleLevel> result;
    int n_holders = matrix->getComm()->getSize();
    for (std::size_t stage = 0;; ++stage) {
      auto its = levels_of(*stages[stage]);
      const std::size_t last = first_on_fewer_ranks(its, n_holders, rows_per_rank);
      const auto modes = last < its.size() ? modes_of(*stages[stage], static_cast<int>(last)) : Teuchos::null;
      if (!modes.is_null()) its.resize(last + 1);
      its = gather_small_levels(std::move(its), n_holders, rows_per_rank);
      result.insert(result.end(), its.begin(), its.end());
      if (modes.is_null()) return result;

      n_holders = n_holders_of(*its.back().matrix, n_holders, rows_per_rank);
      const auto coarse = Teuchos::rcp_const_cast<Matrix>(its.back().matrix);
      if (stage + 1 < stages.size()) {
        reuse(coarse, *stages[stage + 1]);
      } else {
        const auto gathered = Teuchos::rcp(new MultiVector(coarse->getRowMap(), modes->getNumVectors()));
        gathered->doImport(*modes, Tpetra::Import<>(modes->getMap(), coarse->getRowMap()), Tpetra::INSERT);
        add_stage(coarse, n_holders, {gathered, Teuchos::null}, static_cast<int>(modes->getNumVectors()));
      }
      result.pop_back();  // the next stage begins with it
    }
  }
};

template <int dim>
NearNullSpace rigid_body_modes(const Matrix& matrix, const std::vector<base::Point<dim>>& coordinates) {
  PERIMORPH_ASSERT(coordinates.size() * dim == matrix.getNodeNumRows(), "{} nodes for {} rows", coordinates.size(),
                   matrix.getNodeNumRows());
  using Map = Tpetra::Map<>;
  constexpr int n_rotations = dim * (dim - 1) / 2;
  // Where a mode is zero on all nodes of an aggregate, MueLu gives up, on that rank alone. Rotations are so on their
  // axis.
  constexpr double tiny = 1e-100;
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
        const bool is_on_axis = x[i] == 0. && x[j] == 0.;
        modes(n * dim + i, mode) = is_on_axis ? tiny : -x[j];
        modes(n * dim + j, mode) = x[i];
      }
    }
  }
  return space;
}

Multigrid::Multigrid(const Teuchos::RCP<Matrix>& matrix, const NearNullSpace& near_null_space,
                     const Teuchos::ParameterList& overrides, Cycle cycle, int rows_per_rank)
    : hierarchy_(std::make_unique<Hierarchy>()),
      dim_(static_cast<int>(near_null_space.coordinates->getNumVectors())),
      has_own_cycle_(cycle == Cycle::fast),
      rows_per_rank_(rows_per_rank) {
  PERIMORPH_ASSERT(!matrix.is_null() && near_null_space.modes->getLocalLength() == matrix->getNodeNumRows(),
                   "modes of {} rows", near_null_space.modes->getLocalLength());
  hierarchy_->matrix = matrix;
  hierarchy_->defaults = default_parameters(cycle);
  hierarchy_->overrides = overrides;
  hierarchy_->add_stage(matrix, has_own_cycle_ ? matrix->getComm()->getSize() : 1, near_null_space, dim_);
  make_operator();
}

Multigrid::~Multigrid() = default;

void Multigrid::refresh() {
  PERIMORPH_ASSERT(hierarchy_ != nullptr, "what has moved to another matrix cannot be refreshed");
  reuse(hierarchy_->matrix, *hierarchy_->stages.front());
  make_operator();
}

void Multigrid::refresh_finest(const std::vector<int>& nodes) {
  PERIMORPH_ASSERT(std::is_sorted(nodes.begin(), nodes.end()), "{} nodes are not in ascending order", nodes.size());
  if (has_own_cycle_) own_cycle_->refresh_finest(nodes);
}

void Multigrid::make_operator() {
  operator_ = hierarchy_->stages.front();
  if (!has_own_cycle_) return;
  levels_ = hierarchy_->levels(rows_per_rank_);
  make_own_cycle();
}

void Multigrid::make_own_cycle() {
  own_cycle_ = dim_ == 2 ? make_single_precision_cycle<2>(levels_) : make_single_precision_cycle<3>(levels_);
  operator_ = own_cycle_;
}

void Multigrid::move_to(const Teuchos::RCP<Matrix>& matrix, const base::NodeWeights& from_old) {
  PERIMORPH_ASSERT(has_own_cycle_, "only our own cycle can be moved");
  PERIMORPH_ASSERT(from_old.size() * dim_ == matrix->getNodeNumRows(), "{} nodes for {} rows", from_old.size(),
                   matrix->getNodeNumRows());
  hierarchy_.reset();  // of the old matrix; what is still needed of it is in the levels
  CycleLevel& finest = levels_.front();
  finest.matrix = matrix;
  if (levels_.size() > 1) {
    finest.prolongation = weighted_rows(*finest.prolongation, matrix->getRowMap(), from_old, dim_);
    finest.restriction =
        Tpetra::RowMatrixTransposer<double>(Teuchos::rcp_const_cast<Matrix>(finest.prolongation)).createTranspose();
  }
  make_own_cycle();
}

template NearNullSpace rigid_body_modes<2>(const Matrix&, const std::vector<base::Point<2>>&);
template NearNullSpace rigid_body_modes<3>(const Matrix&, const std::vector<base::Point<3>>&);

}  // namespace perimorph::solvers
