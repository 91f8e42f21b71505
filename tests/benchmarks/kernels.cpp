// Kernels on an all-peridynamic square: applying the operator in its two forms, setting up the preconditioner from its
// two matrices, and a STREAM triad for comparison. tools/studies/benchmark runs this and prints the ratios.

#include <benchmark/benchmark.h>

#include <cstdlib>

#include "preconditioner_source.hpp"

namespace perimorph::tests {

std::unique_ptr<CoupledBody> the_square, the_square_with_dilatation;

namespace {

using Vector = Tpetra::Vector<double>;

constexpr double horizon = 3.;

/// n x n squares of size 1, l = 1/5, peridynamic and discontinuous everywhere as in WHL19; held at the left.
int side() {
  const char* n = std::getenv("PERIMORPH_BENCHMARK_SIDE");
  return n == nullptr ? 200 : std::atoi(n);
}

const CoupledBody& made_once(std::unique_ptr<CoupledBody>& body, double poissons_ratio) {
  if (body == nullptr) {
    const double length = side();
    Setup setup{{side(), side(), length, length}, horizon, 0.2, {morphing::Zone<2>::everything()}};
    setup.whole_zone_discontinuous = true;
    setup.prescribed = {{"x", "left", 0, {0., 0.}}, {"y", "left", 1, {0., 0.}}};
    setup.poissons_ratio = poissons_ratio;
    body = std::make_unique<CoupledBody>(setup);
  }
  return *body;
}
const CoupledBody& square() { return made_once(the_square, 1. / 3.); }

Vector wave(const Teuchos::RCP<const Tpetra::Map<>>& map) {
  Vector x(map);
  const auto values = x.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t i = 0; i < x.getLocalLength(); ++i) values(i, 0) = std::sin(0.37 * static_cast<double>(i));
  return x;
}

double n_unknowns() { return static_cast<double>(square().dofs->n_global_nodes()) * 2.; }

void apply(benchmark::State& state, const Tpetra::Operator<double>& linear_operator, double memory) {
  const Vector x = wave(linear_operator.getDomainMap());
  Vector y(linear_operator.getRangeMap());
  for (auto _ : state) linear_operator.apply(x, y);
  state.counters["memory"] = memory;
  state.counters["unknowns"] = n_unknowns();
  state.counters["bonds"] = static_cast<double>(square().bonds.n_bonds());
  state.SetBytesProcessed(static_cast<std::int64_t>((memory + 2. * sizeof(double) * n_unknowns()) *
                                                    static_cast<double>(state.iterations())));
}

void apply_crs(benchmark::State& state) {
  const auto& stiffness = *square().stiffness;
  apply(state, *stiffness.matrix(), static_cast<double>(stiffness.bytes()));
}

void apply_matrix_free(benchmark::State& state) {
  const auto stiffness = square().tangent(square().terms());
  apply(state, stiffness, static_cast<double>(stiffness.bytes()));
}

/// With the dilatation of another Poisson's ratio than that of bonds alone.
void apply_dilatation(benchmark::State& state) {
  const auto& body = made_once(the_square_with_dilatation, 0.2);
  const auto stiffness = body.tangent(body.terms());
  apply(state, stiffness, static_cast<double>(stiffness.bytes()));
}

/// a = b + s c, on arrays far larger than the caches.
void stream_triad(benchmark::State& state) {
  constexpr std::size_t n = 20'000'000;
  std::vector<double> a(n, 0.), b(n, 1.), c(n, 2.);
  for (auto _ : state) {
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3. * c[i];
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(3 * n * sizeof(double)) * state.iterations());
}

/// Sets the preconditioner up and solves for a load on all nodes to 1e-8 of it; with an argument of 1 after a crack has
/// run from the left edge to the middle.
void solve(benchmark::State& state, const PreconditionerSource& source) {
  const auto& body = square();
  const auto terms = body.terms();
  const auto stiffness = Teuchos::rcp(new operators::MatrixFreeTangent<2>(body.tangent(terms)));
  if (state.range(0) == 1) {
    const auto broken = body.bonds_across(1, 0.5 * side(), 0.5 * side());
    for (const auto& term : terms) term->take({broken});
    source.stiffness->take({broken});
    state.counters["broken"] = static_cast<double>(broken.size());
  }
  const Vector load = wave(body.dofs->owned_dofs());
  Vector x(load.getMap());
  base::Profile profile;
  int iterations = 0;
  for (auto _ : state) {
    solvers::LinearSolver solver(*body.comm, {}, profile);
    solver.set_operator(stiffness, source.stiffness->matrix(), source.modes, source.basis);
    iterations = solver.solve(load, x, 1e-8 * load.norm2()).iterations;
  }
  const auto n = static_cast<double>(state.iterations());
  state.counters["iterations"] = iterations;
  state.counters["setup"] = profile.seconds(base::Phase::preconditioner) / n;
  state.counters["cg"] = profile.seconds(base::Phase::cg) / n;
}

void solve_coupled(benchmark::State& state) { solve(state, coupled(square())); }
void solve_short_range(benchmark::State& state) { solve(state, short_range(square(), horizon)); }

BENCHMARK(stream_triad)->Unit(benchmark::kMillisecond);
BENCHMARK(apply_crs)->Unit(benchmark::kMillisecond);
BENCHMARK(apply_matrix_free)->Unit(benchmark::kMillisecond);
BENCHMARK(apply_dilatation)->Unit(benchmark::kMillisecond);
BENCHMARK(solve_coupled)->Arg(0)->Unit(benchmark::kMillisecond);
BENCHMARK(solve_short_range)->Arg(0)->Unit(benchmark::kMillisecond);
// Only their iterations are of interest.
BENCHMARK(solve_coupled)->Arg(1)->Repetitions(1);
BENCHMARK(solve_short_range)->Arg(1)->Repetitions(1);

}  // namespace
}  // namespace perimorph::tests

int main(int argc, char** argv) {
  const Tpetra::ScopeGuard scope(&argc, &argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  using namespace perimorph::tests;  // they end while MPI still runs
  the_square.reset();
  the_square_with_dilatation.reset();
}
