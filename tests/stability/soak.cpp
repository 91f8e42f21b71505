// A long run in which a crack grows slowly: what it holds in memory at the end is what a run holds that went on from a
// checkpoint a twentieth before. Not one of the tests of ctest: tools/checks/soak runs it.
//
//     soak [INCREMENTS]

#include <gtest/gtest.h>
#include <malloc.h>

#include <Tpetra_Core.hpp>
#include <fstream>

#include "perimorph/cases/problem.hpp"
#include "perimorph/mesh/pre_crack.hpp"
#include "perimorph/output/partition_costs.hpp"
#include "perimorph/output/run_observer.hpp"
#include "support/meshes.hpp"
#include "support/temporary_directory.hpp"

namespace perimorph::tests {
namespace {

int increments = 2000;

constexpr const char* case_text = R"xml(<ParameterList name="soak">
  <ParameterList name="Mesh"><Parameter name="File" type="string" value="not_read.msh"/></ParameterList>
  <ParameterList name="Material">
    <Parameter name="Young's Modulus" type="double" value="1000"/>
    <Parameter name="Poisson's Ratio" type="double" value="0.3333"/>
    <Parameter name="Elastic Model" type="string" value="Plane Stress"/>
    <Parameter name="Critical Stretch" type="double" value="0.05"/>
  </ParameterList>
  <ParameterList name="Peridynamics">
    <Parameter name="Horizon" type="double" value="2"/>
    <Parameter name="Characteristic Length" type="double" value="0.2"/>
  </ParameterList>
  <ParameterList name="Morphing">
    <ParameterList name="Seeds">
      <ParameterList name="tip">
        <Parameter name="Center" type="Array(double)" value="{8, 8}"/>
        <Parameter name="Inner Radius" type="double" value="4"/>
        <Parameter name="Outer Radius" type="double" value="6"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Pre-Cracks">
    <ParameterList name="slit"><Parameter name="Points" type="Array(double)" value="{0, 8, 8, 8}"/></ParameterList>
  </ParameterList>
  <ParameterList name="Boundary Conditions">
    <ParameterList name="Displacements">
      <ParameterList name="hold x">
        <Parameter name="Group" type="string" value="right"/>
        <Parameter name="Component" type="string" value="x"/>
      </ParameterList>
      <ParameterList name="hold y">
        <Parameter name="Group" type="string" value="right"/>
        <Parameter name="Component" type="string" value="y"/>
      </ParameterList>
      <ParameterList name="pull down">
        <Parameter name="Group" type="string" value="lower"/>
        <Parameter name="Component" type="string" value="y"/>
        <Parameter name="Rate" type="double" value="-0.005"/>
      </ParameterList>
      <ParameterList name="pull up">
        <Parameter name="Group" type="string" value="upper"/>
        <Parameter name="Component" type="string" value="y"/>
        <Parameter name="Rate" type="double" value="0.005"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Output">
    <Parameter name="Every" type="int" value="100"/>
  </ParameterList>
</ParameterList>
)xml";

/// Two arms, 60 long and 8 wide each, pulled apart at their ends: the longer the crack, the softer they are, so that it
/// grows by little in each increment.
mesh::Mesh<2> arms() {
  mesh::Mesh<2> whole = grid({60, 16, 60., 16.});
  whole.node_sets["lower"] = {0};
  whole.node_sets["upper"] = {16 * 61};
  return whole;
}

double heap_in_use() {
  const auto heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}

/// All parts of a run, as application::run makes them.
struct WholeRun {
  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  base::Profile profile;
  model::Problem<2> problem;
  output::Checkpoints<2> checkpoints;
  output::StopRequests requests;
  std::optional<io::Checkpoint> start;
  mesh::Mesh<2> mesh;
  model::Refinement<2> refinement;
  output::Rebalancing<2> rebalancing;
  fracture::Body<2> body;
  output::Results<2> results;

  WholeRun(const cases::Case& input, const std::string& folder)
      : problem(cases::make_problem<2>(input)),
        checkpoints(comm, input, folder, base::silent_log()),
        start(checkpoints.load()),
        mesh(read()),
        refinement(comm, {}, problem, input.numerical),
        rebalancing(comm, input.solver.largest_imbalance,
                    output::in_slices(*comm, mesh, std::vector<double>(mesh.n_owned_elements, 1.)), base::silent_log()),
        body(comm, mesh, problem, input.numerical, profile),
        results(comm, input, folder, {base::silent_log(), false}, profile, checkpoints.results()) {
    if (start) body.restore(output::share_state(*comm, *start, mesh));
    checkpoints.begin(results.state());
  }

  void advance_to(const cases::Case& input, int increment) {
    output::RunObserver<2> observer(comm, nullptr, results, checkpoints, refinement, rebalancing, requests);
    auto position = checkpoints.position();
    fracture::run_adaptive_loop(body, {increment, input.loading.max_damage_iterations, input.loading.max_zone_growths},
                                observer, position);
    body.forget_solves();  // the preconditioner is not there after a restart
  }

 private:
  mesh::Mesh<2> read() {
    mesh::Mesh<2> whole = arms();
    mesh::open_along<2>(whole, problem.pre_cracks);
    checkpoints.identify(whole);
    return model::distribute_mesh(*comm, whole, problem, std::vector<double>(whole.n_elements(), 1.));
  }
};

TEST(Soak, ALongRunHoldsNoMoreThanOneThatWentOnFromACheckpoint) {
  const TemporaryDirectory folder;
  std::ofstream(folder.file("soak.xml")) << case_text;
  const int stretch = increments / 20;
  const auto input = cases::read_case(folder.file("soak.xml"), {fmt::format("Loading/Increments={}", increments),
                                                                fmt::format("Output/Checkpoint Every={}", stretch)});
  const auto megabytes = [](double bytes) { return bytes / 1e6; };

  double at_the_end = 0., afresh = 0.;
  int increments_with_breaks = 0;
  base::GlobalId broken = 0;
  {
    WholeRun run(input, folder.path());
    fmt::print("{:>10} {:>12} {:>12} {:>10} {:>10} {:>16}\n", "increment", "broken", "bonds", "unknowns", "heap, MB",
               "bytes per bond");
    for (int increment = stretch; increment <= increments; increment += stretch) {
      run.advance_to(input, increment);
      const auto& counts = run.body.counts();
      increments_with_breaks += counts.broken_bonds > broken;
      broken = counts.broken_bonds;
      const auto n_bonds = static_cast<double>(run.body.model().bonds.n_bonds());
      at_the_end = heap_in_use();
      fmt::print("{:>10} {:>12} {:>12} {:>10} {:>10.2f} {:>16.1f}\n", increment, broken, n_bonds, counts.unknowns,
                 megabytes(at_the_end), at_the_end / n_bonds);
    }
  }
  std::filesystem::remove(folder.file(fmt::format("checkpoint-{:06d}.h5", increments)));
  {
    WholeRun run(input, folder.path());
    EXPECT_EQ(run.checkpoints.increment(), increments - stretch);
    run.advance_to(input, increments);
    afresh = heap_in_use();
    EXPECT_EQ(run.body.counts().broken_bonds, broken);
  }
  fmt::print("gone on from increment {}: {:.2f} MB\n", increments - stretch, megabytes(afresh));
  EXPECT_GT(increments_with_breaks, 10);  // of the 20 stretches
  EXPECT_LE(at_the_end, 1.01 * afresh);
}

}  // namespace
}  // namespace perimorph::tests

int main(int argc, char** argv) {
  Tpetra::ScopeGuard mpi(&argc, &argv);
  ::testing::InitGoogleTest(&argc, argv);
  if (argc > 1) perimorph::tests::increments = 20 * std::max(1, std::atoi(argv[1]) / 20);
  return RUN_ALL_TESTS();
}
