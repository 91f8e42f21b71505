#include "perimorph/cases/solver.hpp"

#include <fmt/format.h>

#include <array>

#include "choices.hpp"
#include "perimorph/operators/bond_selection.hpp"

namespace perimorph::cases {

namespace {

using operators::OperatorForm;
using operators::PreconditionerMatrix;

constexpr std::array<Choice<PreconditionerMatrix>, 2> preconditioner_matrices{
    {{"Coupled", PreconditionerMatrix::coupled}, {"Short-Range", PreconditionerMatrix::short_range}}};
constexpr std::array<Choice<bool>, 2> on_and_off{{{"On", true}, {"Off", false}}};
constexpr std::array<Choice<OperatorForm>, 3> operator_forms{
    {{"CRS", OperatorForm::crs}, {"Matrix-Free", OperatorForm::matrix_free}, {"On-the-Fly", OperatorForm::on_the_fly}}};

}  // namespace

double default_window_radius(int dimension) { return dimension == 2 ? 4. : 2.5; }

void declare(const input::Section& decisive, Solver& solver, model::NumericalOptions& numerical) {
  using namespace input;
  const Section section = decisive.changeable();
  const double cut_off = operators::default_short_range_cut_off(2);
  section.choice(
      "Operator", numerical.operator_form, operator_forms,
      "How the coupled stiffness is applied: \"CRS\" is an assembled sparse matrix; \"Matrix-Free\" pulls along every "
      "bond and strains every element each time, which moves several times fewer bytes. \"On-the-Fly\" also computes "
      "the "
      "stiffness of every bond each time, in single precision: a third of the memory for bonds and operator, while "
      "conjugate gradients take up to twice the time in three dimensions. For what would not fit otherwise.");
  section.choice(
      "Preconditioner Matrix", numerical.preconditioner_matrix, preconditioner_matrices,
      "What the multigrid preconditioner is built from: \"Coupled\" is the whole stiffness, but for what the "
      "dilatation "
      "adds; \"Short-Range\" leaves out all bonds beyond the cut-off and stiffens the others: far fewer entries, a few "
      "more iterations.");
  section.optional(
      "Short-Range Cut-Off", solver.short_range_cut_off, cut_off, between(0., 1.),
      fmt::format("Longest bond in the short-range matrix, in horizons [-]; {} in two dimensions and {} in three if "
                  "not given. Below the distance of points in neighbouring elements the preconditioner is useless.",
                  cut_off, operators::default_short_range_cut_off(3)));
  section.parameter("Tolerance", numerical.tolerance, between(0., 1.),
                    "Residual over the norm of the reaction forces [-], in every solution that is accepted. Only with "
                    "it is it decided that no more bonds break.");
  section.parameter("Damage Tolerance", numerical.damage_tolerance, between(0., 1.),
                    "The same as Tolerance, in solutions after which bonds break [-]; not below Tolerance. Too loose, "
                    "and bonds break in another order.");
  section.choice("Windows", solver.windows, on_and_off,
                 "While bonds break, solve in a window around those that broke last, and for the rest of the body by a "
                 "few far fields, which follow from earlier solutions; where the residual of the whole body is too "
                 "large then, the whole body is solved. \"Off\" always solves the whole body, as with contact.");
  section.optional("Window Radius", solver.window_radius, default_window_radius(2), at_least(1.),
                   fmt::format("Of windows, in horizons [-]; {} in two dimensions and {} in three if not given.",
                               default_window_radius(2), default_window_radius(3)));
  section.parameter(
      "Largest Window", numerical.window.largest_share, between(0., 1.),
      "Share of the nodes of the body [-] that a window may have; where it would have more, the whole body "
      "is solved, which costs little more then.");
  section.parameter(
      "Maximum Iterations", numerical.solver.max_iterations, count(),
      "Of conjugate gradients in one solution. When they do not suffice, the system is tried twice more with other "
      "preconditioners; then the run ends with status 3. Far below 100 it may end although nothing is wrong.");
  section.parameter("Renewal Cost", numerical.solver.renewal_cost, at_least(0.),
                    "The preconditioner is renewed when, since its last set-up, solutions have taken this many more "
                    "iterations than they would have with a new one [-]: what a set-up costs, in iterations.");
  section.parameter("Rows per Rank", numerical.solver.rows_per_rank, count(),
                    "Coarse levels of multigrid are held by as few ranks as get at least this many rows each [-]: a "
                    "small level costs "
                    "messages, not work. 1 leaves all levels on all ranks.");
  section.parameter(
      "Largest Imbalance", solver.largest_imbalance, at_least(1.),
      "The mesh is partitioned among the ranks by the number of bonds, and again when the zone has grown and one rank "
      "has more than this many times the mean of the work [-]. Near 1 it costs more than it saves.");
  section.anything("Belos", numerical.solver.belos,
                   "Any parameters of Belos, passed on as they are; they override the program's own.");
  section.anything(
      "MueLu", numerical.solver.muelu,
      "Any parameters of MueLu, passed on as they are; they override the program's own. The W-cycle and its smoother "
      "are the program's.");
}

void check_solver(const input::Values& section, bool has_dilatation, bool softens, bool has_rigid_groups) {
  const std::string* word = section.text("Operator");
  if (word == nullptr) return;
  const auto form = input::value_of(operator_forms, *word);
  if (softens && form == OperatorForm::on_the_fly) {
    section.mistake(
        "Operator",
        "found \"On-the-Fly\"; with bonds that soften allowed is \"Matrix-Free\" or \"CRS\": what each bond "
        "has left of its stiffness must be stored anyway");
  }
  if (has_rigid_groups && form == OperatorForm::crs) {
    section.mistake("Operator",
                    "found \"CRS\"; with rigid groups allowed is \"Matrix-Free\" or \"On-the-Fly\": each node of a "
                    "group would be coupled to all that is around any other");
  }
  if (!has_dilatation || form != OperatorForm::crs) return;
  section.mistake(
      "Operator",
      "found \"CRS\"; with this Poisson's ratio allowed is \"Matrix-Free\" or \"On-the-Fly\": through the "
      "dilatation at its ends a bond couples points two horizons apart, which would make four to eight times "
      "as many entries");
}

}  // namespace perimorph::cases
