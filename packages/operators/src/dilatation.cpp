#include "perimorph/operators/dilatation.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "perimorph/base/errors.hpp"

namespace perimorph::operators {

Dilatation::Dilatation(const Teuchos::RCP<const base::Comm>& comm, const std::vector<base::GlobalId>& ids,
                       std::size_t n_owned, std::vector<double> factors, std::vector<std::size_t> twins)
    : factors_(std::move(factors)),
      twins_(std::move(twins)),
      n_owned_(n_owned),
      weighted_volumes_(ids.size() + twins_.size(), 0.),
      n_bonds_(weighted_volumes_.size(), 0) {
  PERIMORPH_ASSERT(n_owned <= ids.size() && factors_.size() == ids.size(), "{} of {} points are owned, {} factors",
                   n_owned, ids.size(), factors_.size());
  if (comm->getSize() == 1) return;
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map_of = [&](std::size_t n) {
    return Teuchos::rcp(new Tpetra::Map<>(unknown, Teuchos::ArrayView<const base::GlobalId>(ids.data(), n), 0, comm));
  };
  const auto owned = map_of(n_owned), all = map_of(ids.size());
  import_ = Teuchos::rcp(new Tpetra::Import<>(owned, all));
  owned_ = Teuchos::rcp(new Tpetra::Vector<double>(owned));
  all_ = Teuchos::rcp(new Tpetra::Vector<double>(all));
}

void Dilatation::add(std::size_t point, double weight) {
  PERIMORPH_DEBUG_ASSERT(point < n_bonds_.size() && weight > 0., "weight {} at point {}", weight, point);
  weighted_volumes_[point] += weight;
  ++n_bonds_[point];
}

void Dilatation::remove(std::size_t point, double weight) {
  weaken(point, weight);
  --n_bonds_[point];
}

void Dilatation::weaken(std::size_t point, double weight) {
  PERIMORPH_DEBUG_ASSERT(point < n_bonds_.size() && n_bonds_[point] > 0, "point {} has no bond left", point);
  weighted_volumes_[point] -= weight;
}

void Dilatation::to_stretch(std::vector<double>& sums) const {
  PERIMORPH_ASSERT(sums.size() == n_bonds_.size(), "{} sums at {} points", sums.size(), n_bonds_.size());
  for (std::size_t i = 0; i < n_owned_; ++i) {
    sums[i] = n_bonds_[i] > 0 ? factors_[i] / weighted_volumes_[i] * sums[i] : 0.;
  }
  const std::size_t n_points = factors_.size();
  if (!import_.is_null()) {
    std::copy_n(sums.begin(), n_owned_, owned_->getDataNonConst().begin());
    all_->doImport(*owned_, *import_, Tpetra::INSERT);
    std::copy_n(all_->getData().begin(), n_points, sums.begin());
  }
  for (std::size_t i = 0; i < twins_.size(); ++i) sums[n_points + i] = sums[twins_[i]];
}

std::size_t Dilatation::bytes() const {
  return weighted_volumes_.size() * (2 * sizeof(double) + sizeof(int)) +
         (import_.is_null() ? 0 : 2 * sizeof(double)) * n_bonds_.size();
}

}  // namespace perimorph::operators
