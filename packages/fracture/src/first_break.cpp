#include "perimorph/fracture/first_break.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "perimorph/base/errors.hpp"

namespace perimorph::fracture {

namespace {

/// The largest stretch among the bonds that may break, of all ranks; 0 if none reaches the threshold. Collective.
template <int dim>
double largest_stretch(const base::Comm& comm, const Body<dim>& body, double factor, double threshold) {
  auto u = body.system().at_points().displacement;
  for (auto& one : u) one *= factor;
  const auto stretches = body.topology().bonds().overstretches(u, threshold, body.topology().classes());
  const auto largest = std::max_element(stretches.begin(), stretches.end());
  return base::max(comm, largest == stretches.end() ? 0. : *largest);
}

}  // namespace

template <int dim>
double load_of_first_break(const base::Comm& comm, const Body<dim>& body, double critical_stretch) {
  PERIMORPH_ASSERT(std::isfinite(critical_stretch) && critical_stretch > 0. && body.load_factor() != 0.,
                   "critical stretch {} at load factor {}", critical_stretch, body.load_factor());
  double largest = 0.;
  for (double threshold = critical_stretch; largest == 0. && threshold > 1e-12 * critical_stretch; threshold /= 8.) {
    largest = largest_stretch(comm, body, 1., threshold);
  }
  if (largest == 0.) return std::numeric_limits<double>::infinity();
  double factor = critical_stretch / largest;
  for (int i = 0; i < 4; ++i) {  // where bonds turn, their stretch does not grow quite like the displacement
    largest = largest_stretch(comm, body, factor, 0.5 * critical_stretch);
    if (largest == 0.) break;
    factor *= critical_stretch / largest;
  }
  return factor * body.load_factor();
}

template double load_of_first_break(const base::Comm&, const Body<2>&, double);
template double load_of_first_break(const base::Comm&, const Body<3>&, double);

}  // namespace perimorph::fracture
