#include "perimorph/materials/bond_law.hpp"

#include <algorithm>
#include <cmath>

#include "perimorph/base/errors.hpp"

namespace perimorph::materials {

namespace {

// Petersson's kink: where it is between the limit and the critical stretch, and what is left there.
constexpr double kink = 0.8 / 3.6, left_at_kink = 1. / 3.;
constexpr double area_of_bilinear = 0.5 * (kink + left_at_kink);  // of phi, over its width 1

constexpr double last_share = 1e-3;         // of the exponential function, at the critical stretch
constexpr double rate = 6.907755278982137;  // of its fall over its width, -log(last_share)
constexpr double area_of_exponential = (1. - last_share) / rate;

}  // namespace

BondLaw::BondLaw(double critical_stretch) : limit_(critical_stretch), critical_(critical_stretch) {
  PERIMORPH_ASSERT(critical_stretch >= 0., "a critical stretch of {}", critical_stretch);
}

BondLaw BondLaw::softening(Softening softening, double limit, double area) {
  PERIMORPH_ASSERT(softening != Softening::none && limit > 0., "softening from a stretch of {}", limit);
  PERIMORPH_ASSERT(std::isfinite(area) && area > 0.5 * limit * limit, "an area of {} beyond a stretch of {}", area,
                   limit);
  BondLaw law(limit);
  law.softening_ = softening;
  law.critical_ +=
      (area / limit - 0.5 * limit) / (softening == Softening::bilinear ? area_of_bilinear : area_of_exponential);
  return law;
}

/// phi.
double BondLaw::share_of_limit(double stretch) const {
  if (stretch >= critical_) return 0.;
  if (stretch <= limit_) return 1.;
  const double x = (stretch - limit_) / (critical_ - limit_);
  if (softening_ == Softening::exponential) return std::exp(-rate * x);
  return x < kink ? 1. - (1. - left_at_kink) * x / kink : left_at_kink * (1. - x) / (1. - kink);
}

double BondLaw::share_left(double largest_stretch) const {
  PERIMORPH_DEBUG_ASSERT(largest_stretch >= 0., "a largest stretch of {}", largest_stretch);
  const double share = share_of_limit(largest_stretch);
  return largest_stretch <= limit_ ? share : limit_ / largest_stretch * share;
}

double BondLaw::area_up_to(double stretch) const {
  if (stretch <= limit_ || !softens()) return 0.5 * std::min(stretch, limit_) * std::min(stretch, limit_);
  const double width = critical_ - limit_, x = std::min(1., (stretch - limit_) / width);
  double area = 0.;  // of phi, over a width of 1
  if (softening_ == Softening::exponential) {
    area = (1. - std::exp(-rate * x)) / rate;
  } else if (x < kink) {
    area = x * (1. - 0.5 * (1. - left_at_kink) * x / kink);
  } else {
    area = area_of_bilinear - 0.5 * left_at_kink * (1. - x) * (1. - x) / (1. - kink);
  }
  return limit_ * (0.5 * limit_ + width * area);
}

double BondLaw::dissipation(double largest_stretch) const {
  const double stretch = std::min(largest_stretch, critical_);
  return area_up_to(stretch) - 0.5 * share_left(stretch) * stretch * stretch;
}

BondLaw BondLaw::under(const LateralCompression& compression) const {
  PERIMORPH_ASSERT(
      compression.uncounted >= 0. && compression.uncounted <= 1. && (compression.uncounted == 0. || !softens()),
      "{} of the stretch by compression do not count, softening: {}", compression.uncounted, softens());
  BondLaw law = *this;
  law.compression_ = compression;
  return law;
}

BondLaw BondLaw::scaled(double factor) const {
  PERIMORPH_ASSERT(std::isfinite(factor) && factor > 0., "{} times the stretches", factor);
  BondLaw law = *this;
  law.limit_ *= factor;
  law.critical_ *= factor;
  return law;
}

}  // namespace perimorph::materials
