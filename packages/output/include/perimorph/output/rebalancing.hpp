#pragma once

#include "perimorph/base/log.hpp"
#include "perimorph/fracture/body.hpp"

namespace perimorph::output {

/// Whether the mesh is to be repartitioned among the ranks, and by which costs of its elements.
template <int dim>
class Rebalancing {
 public:
  /// @param largest_imbalance of the work that is tolerated: the largest of a rank over the mean of ranks [-]
  /// @param element_costs by which the mesh is partitioned first, in slices (partition_costs.hpp), in any unit
  Rebalancing(const Teuchos::RCP<const base::Comm>& comm, double largest_imbalance, std::vector<double> element_costs,
              base::Log log);

  /// The cost of each element by which the mesh is to be partitioned, in slices. Local.
  const std::vector<double>& element_costs() const { return element_costs_; }

  /// Of another mesh, as for the constructor. Local.
  void set_element_costs(std::vector<double> element_costs) { element_costs_ = std::move(element_costs); }

  /// Whether the ranks share the work so unevenly that another partition is worth its price; the costs are then those
  /// of this body. To be called when the topology has just been updated. Collective.
  bool is_wanted(const fracture::Body<dim>& body);

 private:
  Teuchos::RCP<const base::Comm> comm_;
  double largest_imbalance_;
  std::vector<double> element_costs_;
  base::Log log_;
  base::GlobalId measured_topology_ = 0;  ///< the last one that has been looked at
};

}  // namespace perimorph::output
