// Linear systems of a hybrid body for other programs (systems.hpp), and the same solved by our own means: the operator
// without a matrix, multigrid from the short-range matrix.   perimorph_systems FOLDER SIDE
//
// The body is a square of SIDE x SIDE elements, horizon 3 elements, l = 1/5 element, with a peridynamic zone from the
// middle of the left edge to the square's middle, a tenth of the side high, and discontinuous as in WHL19. It is held
// at the bottom and pulled at the top. A crack runs along the zone's axis.

#include "systems.hpp"

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cstdlib>

#include "preconditioner_source.hpp"

namespace perimorph::tests {
namespace {

using Vector = Tpetra::Vector<double>;

constexpr double horizon = 3.;
constexpr int first_crack = 20, advance = 1;  // elements along it

CoupledBody make_body(int side) {
  const double length = side, half_height = std::max(0.05 * length, 7.);
  const auto zone = morphing::Zone<2>::box({-1., 0.5 * length - half_height},
                                           {0.5 * length, 0.5 * length + half_height}, 2. * horizon);
  Setup setup{{side, side, length, length}, horizon, 0.2, {zone}};
  setup.whole_zone_discontinuous = true;
  setup.prescribed = {{"x", "bottom", 0, {0., 0.}}, {"y", "bottom", 1, {0., 0.}}};
  return CoupledBody(setup);
}

/// A unit force up on each node of the upper edge.
Vector pull(const CoupledBody& body, double height) {
  Vector load(body.dofs->owned_dofs());
  const auto values = load.getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto coordinates = body.node_coordinates();
  for (std::size_t n = 0; n < coordinates.size(); ++n)
    values(2 * n + 1, 0) = coordinates[n][1] > height - 0.5 ? 1. : 0.;
  return load;
}

// --- Files ---

void write_table(const std::string& file, const Table& table) {
  std::ofstream stream(file);
  stream << fmt::format("%%MatrixMarket matrix array real general\n{} {}\n", table.n_rows, table.n_columns);
  for (const double value : table.values) stream << fmt::format("{}\n", value);
}

/// Entries of the lower triangle.
void write_matrix(const std::string& file, const SymmetricMatrix& matrix) {
  std::ofstream stream(file);
  stream << fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{0} {0} {1}\n", matrix.n,
                        matrix.entries.size());
  for (const auto& e : matrix.entries) stream << fmt::format("{} {} {}\n", e.row + 1, e.column + 1, e.value);
}

/// The lower triangle of a matrix minus values that it had before, where they differ.
SymmetricMatrix difference(const solvers::Matrix& matrix, const std::vector<double>& before) {
  const auto local = matrix.getLocalMatrixHost();
  SymmetricMatrix result{local.numRows(), {}};
  for (int row = 0; row < local.numRows(); ++row) {
    for (auto i = local.graph.row_map(row); i < local.graph.row_map(row + 1); ++i) {
      const int column = local.graph.entries(i);
      if (column <= row && local.values(i) != before[i])
        result.entries.push_back({row, column, local.values(i) - before[i]});
    }
  }
  return result;
}

std::vector<double> values_of(const solvers::Matrix& matrix) {
  const auto values = matrix.getLocalMatrixHost().values;
  return {values.data(), values.data() + values.extent(0)};
}

void write_coordinates_and_load(const std::string& folder, const CoupledBody& body, const Vector& load) {
  const auto coordinates = body.node_coordinates();
  Table places{static_cast<int>(coordinates.size()), 2, {}};
  for (int c = 0; c < 2; ++c) {
    for (const auto& x : coordinates) places.values.push_back(x[c]);
  }
  write_table(folder + "/coordinates.mtx", places);
  const auto loads = load.getLocalViewHost(Tpetra::Access::ReadOnly);
  write_table(folder + "/load.mtx",
              {static_cast<int>(load.getLocalLength()), 1, {loads.data(), loads.data() + load.getLocalLength()}});
}

// --- Our own solution ---

class Solution {
 public:
  Solution(const CoupledBody& body, const solvers::Matrix& coupled, const Vector& load)
      : body_(body),
        coupled_(coupled),
        load_(load),
        x_(load.getMap()),
        residual_(load.getMap()),
        correction_(load.getMap()) {}

  void solve_again(const std::string& state) {
    terms_ = body_.terms();
    stiffness_ = Teuchos::rcp(new operators::MatrixFreeTangent<2>(body_.tangent(terms_)));
    source_ = short_range(body_, horizon);
    solver_ = std::make_unique<solvers::LinearSolver>(*body_.comm, solvers::SolverParameters{}, profile_);
    solver_->set_operator(stiffness_, source_.stiffness->matrix(), source_.modes, source_.basis);
    x_.putScalar(0.);
    correct(state, 0.);
  }

  void solve_again(const std::string& state, const std::vector<std::size_t>& broken) {
    const Stopwatch watch;
    for (const auto& term : terms_) term->take({broken});
    source_.stiffness->take({broken});
    correct(state, watch.seconds());
  }

 private:
  const CoupledBody& body_;
  const solvers::Matrix& coupled_;
  const Vector& load_;
  Vector x_, residual_, correction_;
  base::Profile profile_;
  operators::ForceTerms<2> terms_;
  Teuchos::RCP<operators::MatrixFreeTangent<2>> stiffness_;
  PreconditionerSource source_;
  std::unique_ptr<solvers::LinearSolver> solver_;

  /// Adds to the solution what is missing. The time of the multigrid's set-up is measured within the solver.
  void correct(const std::string& state, double update_seconds) {
    const double before = profile_.seconds(base::Phase::preconditioner);
    const double load_norm = load_.norm2();
    const Stopwatch watch;
    subtract_forces_of(*stiffness_);
    const int iterations = solver_->solve(residual_, correction_, tolerance * load_norm).iterations;
    x_.update(1., correction_, 1.);
    const double seconds = watch.seconds(), set_up = profile_.seconds(base::Phase::preconditioner) - before;
    subtract_forces_of(coupled_);
    report(state,
           {update_seconds + set_up, seconds - set_up, iterations, residual_.norm2() / load_norm, x_.dot(load_)});
  }

  void subtract_forces_of(const Tpetra::Operator<double>& stiffness) {
    stiffness.apply(x_, residual_);
    residual_.update(1., load_, -1.);
  }
};

void run(const std::string& folder, int side) {
  auto body = make_body(side);
  const auto load = pull(body, side);
  const auto coupled = body.stiffness->matrix();
  auto before = std::vector<double>(values_of(*coupled).size(), 0.);
  const auto write_change = [&](const std::string& file) {
    write_matrix(file, difference(*coupled, before));
    before = values_of(*coupled);
  };
  write_coordinates_and_load(folder, body, load);
  write_change(folder + "/matrix.mtx");

  Solution solution(body, *coupled, load);
  solution.solve_again("intact");
  for (int k = 1; k <= 1 + n_advances; ++k) {
    const auto broken = body.break_bonds(body.bonds_across(1, 0.5 * side, first_crack + (k - 1) * advance));
    body.stiffness->take({broken});
    write_change(change_file(folder, k));
    if (k == 1) {
      solution.solve_again("cracked");
    } else {
      solution.solve_again("advanced", broken);
    }
  }
}

}  // namespace
}  // namespace perimorph::tests

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const Tpetra::ScopeGuard scope(&argc, &argv);
  perimorph::tests::run(argv[1], std::atoi(argv[2]));
}
