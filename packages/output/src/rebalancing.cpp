#include "perimorph/output/rebalancing.hpp"

#include <numeric>

#include "perimorph/base/errors.hpp"
#include "perimorph/output/partition_costs.hpp"

namespace perimorph::output {

template <int dim>
Rebalancing<dim>::Rebalancing(const Teuchos::RCP<const base::Comm>& comm, double largest_imbalance,
                              std::vector<double> element_costs, base::Log log)
    : comm_(comm),
      largest_imbalance_(largest_imbalance),
      element_costs_(std::move(element_costs)),
      log_(std::move(log)) {
  PERIMORPH_ASSERT(largest_imbalance > 0., "a largest imbalance of {}", largest_imbalance);
}

/// It is worth its price only if the zone has grown since the last one: what was uneven then cannot be mended.
template <int dim>
bool Rebalancing<dim>::is_wanted(const fracture::Body<dim>& body) {
  constexpr double growth = 1.2;
  if (comm_->getSize() == 1 || body.counts().topologies == measured_topology_) return false;
  measured_topology_ = body.counts().topologies;
  const auto [total, imbalance] = measure_work(*comm_, body);
  const double before = base::sum(*comm_, std::accumulate(element_costs_.begin(), element_costs_.end(), 0.));
  if (imbalance <= largest_imbalance_ || total <= growth * before) return false;
  log_->info("repartitioned    one rank had {:.2f} times the mean of the work", imbalance);
  element_costs_ = partition_costs(*comm_, body);
  return true;
}

template class Rebalancing<2>;
template class Rebalancing<3>;

}  // namespace perimorph::output
