#include "first_break.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "perimorph/base/errors.hpp"

namespace perimorph::application {

namespace {

/// The largest stretch over its limit among the bonds that may break or soften, of all ranks; 0 if none reaches the
/// threshold. Collective.
template <int dim>
double largest_ratio(const base::Comm& comm, const fracture::Body<dim>& body, bonds::PointStrains strains,
                     double factor, double threshold) {
  auto u = body.system().at_points().displacement;
  for (auto& one : u) one *= factor;
  for (auto* values : {&strains.eigenstrain, &strains.dilatation}) {
    for (double& one : *values) one *= factor;
  }
  const auto& topology = body.topology();
  const auto ratios = topology.bonds().overstretches(u, topology.classes(), threshold, strains);
  const auto largest = std::max_element(ratios.begin(), ratios.end());
  return base::max(comm, largest == ratios.end() ? 0. : *largest);
}

}  // namespace

template <int dim>
double load_of_first_break(const base::Comm& comm, const fracture::Body<dim>& body) {
  const double limit = body.topology().bonds().materials().smallest_limit();
  PERIMORPH_ASSERT(limit > 0. && body.load_factor() != 0., "critical stretch {} at load factor {}", limit,
                   body.load_factor());
  const bonds::PointStrains strains{body.system().at_points().eigenstrain, body.system().dilatation()};
  double largest = 0.;
  for (double threshold = 1.; largest == 0. && threshold > 1e-12; threshold /= 8.) {
    largest = largest_ratio(comm, body, strains, 1., threshold);
  }
  if (largest == 0.) return std::numeric_limits<double>::infinity();
  double factor = 1. / largest;
  for (int i = 0; i < 4; ++i) {  // where bonds turn, their stretch does not grow quite like the displacement
    largest = largest_ratio(comm, body, strains, factor, 0.5);
    if (largest == 0.) break;
    factor /= largest;
  }
  return factor * body.load_factor();
}

template double load_of_first_break(const base::Comm&, const fracture::Body<2>&);
template double load_of_first_break(const base::Comm&, const fracture::Body<3>&);

}  // namespace perimorph::application
