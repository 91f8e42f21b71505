#include "perimorph/materials/bond_materials.hpp"

#include <algorithm>
#include <cmath>

namespace perimorph::materials {

BondMaterials::BondMaterials(std::vector<Micromodulus> micromoduli, std::vector<BondLaw> laws,
                             std::vector<int> of_element)
    : micromoduli_(std::move(micromoduli)), laws_(std::move(laws)), of_element_(std::move(of_element)) {
  PERIMORPH_ASSERT(!micromoduli_.empty(), "no material for {} elements", of_element_.size());
  PERIMORPH_ASSERT(laws_.size() == micromoduli_.size() * micromoduli_.size(), "{} laws for {} materials", laws_.size(),
                   micromoduli_.size());
  const int n = static_cast<int>(micromoduli_.size());
  for (const auto& [tau0, length, reach] : micromoduli_) {
    PERIMORPH_ASSERT(std::isfinite(tau0) && tau0 > 0., "tau0 is {}", tau0);
    PERIMORPH_ASSERT(std::isfinite(length) && length > 0., "the characteristic length is {}", length);
    PERIMORPH_ASSERT(std::isfinite(reach) && reach > 0. && reach == horizon(), "horizons {} and {}", reach, horizon());
  }
  PERIMORPH_ASSERT(std::all_of(of_element_.begin(), of_element_.end(), [&](int m) { return m >= 0 && m < n; }),
                   "a material beyond {}", n);
  if (n == 1) of_element_.clear();
}

bool BondMaterials::softens() const {
  return std::any_of(laws_.begin(), laws_.end(), [](const BondLaw& law) { return law.softens(); });
}

bool BondMaterials::sees_compression() const {
  return std::any_of(laws_.begin(), laws_.end(), [](const BondLaw& law) { return law.sees_compression(); });
}

double BondMaterials::smallest_limit() const {
  const auto by_limit = [](const BondLaw& one, const BondLaw& other) { return one.limit() < other.limit(); };
  return std::min_element(laws_.begin(), laws_.end(), by_limit)->limit();
}

}  // namespace perimorph::materials
