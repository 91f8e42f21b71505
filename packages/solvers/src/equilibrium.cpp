#include "perimorph/solvers/equilibrium.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "perimorph/base/errors.hpp"

namespace perimorph::solvers {

namespace {

using Vector = operators::NonlinearSystem::Vector;

/// The anchors of a tangent, which give way where they hold a piece back (DECISIONS.md, 21): a piece that hangs on
/// bonds weaker than its anchors moves by little in each correction. By powers of two, so that they come back to the
/// bit.
class LooseAnchors {
 public:
  explicit LooseAnchors(operators::NonlinearSystem& system) : system_(system) {}
  ~LooseAnchors() {
    if (scale_ != 1.) system_.scale_anchors(1. / scale_);
  }
  LooseAnchors(const LooseAnchors&) = delete;
  LooseAnchors& operator=(const LooseAnchors&) = delete;

  bool are_loose() const { return scale_ != 1.; }
  void loosen() {
    constexpr double step = 0x1p-10, loosest = 0x1p-30;
    if (scale_ <= loosest) return;
    system_.scale_anchors(step);
    scale_ *= step;
  }

 private:
  operators::NonlinearSystem& system_;
  double scale_ = 1.;
};

/// Corrects u, and goes back along the correction where that leads too far: to about where the residual does no work on
/// it any more. Springs that only push, or slide, may close and open in turn otherwise.
/// @param residual at u, and then at the corrected one, whose norms are returned
operators::NonlinearSystem::Norms correct(operators::NonlinearSystem& system, base::Field u, Vector& residual,
                                          const Vector& correction) {
  constexpr int most_cuts = 10;
  constexpr double far = 0.5;  // the work that holds it back, over that which drove it
  const double driving = residual.dot(correction);
  system.correct(u, correction);
  auto norms = system.residual(residual);
  double share = 1.;
  for (int cut = 0; cut < most_cuts; ++cut) {
    const double holding_back = -residual.dot(correction);
    if (!(holding_back > far * driving)) break;
    const double shorter = share * driving / (driving + holding_back);
    Vector step(correction, Teuchos::Copy);
    step.scale(shorter - share);
    system.correct(u, step);
    norms = system.residual(residual);
    share = shorter;
  }
  return norms;
}

}  // namespace

Equilibrium::Outcome Equilibrium::find(operators::NonlinearSystem& system, base::Field u, const BalanceTarget& target) {
  PERIMORPH_ASSERT(target.tolerance > 0. && target.force_scale >= 0., "tolerance {}, force scale {}", target.tolerance,
                   target.force_scale);
  constexpr int max_corrections = 100;  // contact takes up to ten, in rubble far more
  // A severed body has no reactions left that its residual could relate to: then these shares of the largest reaction
  // so far count, and of the largest that a first guess took, which moves the supports alone.
  constexpr double of_solution = 0.1, of_first_guess = 1e-4;
  constexpr double in_window = 0.5, far_off = 4.;  // of the largest residual: in a window, and in the whole body then
  constexpr double slow = 0.5;                     // a correction that leaves more of the residual

  Vector residual(system.unknowns()), correction(system.unknowns());
  LooseAnchors anchors(system);
  Outcome outcome{false, 0, 0, ""};
  double last_residual = std::numeric_limits<double>::infinity();
  double leeway = 1.;
  std::shared_ptr<operators::Window> window;
  auto norms = system.residual(residual);
  for (;;) {
    if (!std::isfinite(norms.residual) || !std::isfinite(norms.reaction)) {
      outcome.trouble = "the forces are no finite numbers: loads, stiffness or lengths are too large";
      return outcome;
    }
    if (outcome.linear_solves == 0) target.force_scale = std::max(target.force_scale, of_first_guess * norms.reaction);
    const double largest = target.tolerance * std::max(norms.reaction, target.force_scale);
    if (norms.residual <= leeway * largest) {
      target.force_scale = std::max(target.force_scale, of_solution * norms.reaction);
      outcome.converged = true;
      return outcome;
    }
    if (outcome.linear_solves == max_corrections) {
      outcome.trouble = fmt::format("the forces do not balance: residual {:.3e}, reactions {:.3e} after {} solves",
                                    norms.residual, norms.reaction, max_corrections);
      return outcome;
    }
    if (!target.may_float && !anchors.are_loose()) anchors.loosen();
    if (norms.residual > slow * last_residual) anchors.loosen();
    last_residual = norms.residual;

    note_change(system.prepare_tangent(u));
    const bool is_first = ++outcome.linear_solves == 1;
    if (is_first && target.by_window) window = system.window();
    if (is_first && window != nullptr && windows_.solve(window, residual, correction, in_window * largest)) {
      leeway = far_off;
    } else {
      const auto linear = solver_.solve(residual, correction, 0.5 * leeway * largest);
      outcome.cg_iterations += linear.iterations;
      if (!linear.converged) {
        outcome.trouble = linear.trouble;
        return outcome;
      }
      if (window != nullptr || (!target.by_window && windows_.has_learned())) windows_.learn(correction);
    }
    norms = correct(system, u, residual, correction);
  }
}

Equilibrium::Outcome Equilibrium::find_load_response(operators::NonlinearSystem& system, base::Field response,
                                                     double tolerance) {
  PERIMORPH_ASSERT(tolerance > 0., "tolerance {}", tolerance);
  Vector force(system.unknowns()), change(system.unknowns());
  system.load_derivative(force);
  const auto linear = solver_.solve(force, change, tolerance * force.norm2());
  if (linear.converged) system.expand_response(change, response);
  return {linear.converged, 1, linear.iterations, linear.trouble};
}

}  // namespace perimorph::solvers
