// All of Zoltan2 is in this file: it takes half a minute to compile.

#include "partition.hpp"

#include <Teuchos_DefaultMpiComm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Zoltan2_BasicVectorAdapter.hpp>
#include <Zoltan2_PartitioningProblem.hpp>
#include <Zoltan2_PartitioningSolution.hpp>
#include <algorithm>
#include <numeric>

#include "perimorph/base/errors.hpp"

namespace perimorph::mesh {

namespace {

using Types = Zoltan2::BasicUserTypes<double, int, base::GlobalId>;
using Adapter = Zoltan2::BasicVectorAdapter<Types>;

Teuchos::ParameterList multijagged(int n_parts) {
  Teuchos::ParameterList options;
  options.set("algorithm", "multijagged");
  options.set("num_global_parts", n_parts);
  options.set("imbalance_tolerance", 1.02);
  return options;
}

template <int dim>
Adapter adapter_of(const std::vector<base::GlobalId>& ids, const std::vector<base::Point<dim>>& points,
                   const std::vector<double>& weights) {
  std::vector<const double*> components, weight_lists = {weights.data()};
  for (int d = 0; d < dim; ++d) components.push_back(points.front().data() + d);
  std::vector<int> strides(dim, dim), weight_strides = {1};
  return Adapter(static_cast<int>(ids.size()), ids.data(), components, strides, weight_lists, weight_strides);
}

}  // namespace

template <int dim>
std::vector<int> partition(const std::vector<base::Point<dim>>& points, const std::vector<double>& weights,
                           int n_parts) {
  static_assert(sizeof(base::Point<dim>) == dim * sizeof(double), "points are strided arrays of coordinates");
  PERIMORPH_ASSERT(n_parts >= 1, "{} parts", n_parts);
  PERIMORPH_ASSERT(weights.empty() || weights.size() == points.size(), "{} weights of {} points", weights.size(),
                   points.size());
  PERIMORPH_ASSERT(std::all_of(points.begin(), points.end(), [](const auto& x) { return x.allFinite(); }),
                   "one of {} points is nowhere", points.size());
  if (n_parts == 1 || points.empty()) return std::vector<int>(points.size(), 0);

  std::vector<base::GlobalId> ids(points.size());
  std::iota(ids.begin(), ids.end(), base::GlobalId{0});
  const std::vector<double> costs = weights.empty() ? std::vector<double>(points.size(), 1.) : weights;
  Adapter adapter = adapter_of<dim>(ids, points, costs);
  Teuchos::ParameterList options = multijagged(n_parts);
  const Teuchos::RCP<const Teuchos::Comm<int>> this_rank_alone = Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF));
  Zoltan2::PartitioningProblem<Adapter> problem(&adapter, &options, this_rank_alone);
  problem.solve();
  const int* parts = problem.getSolution().getPartListView();
  return {parts, parts + points.size()};
}

template std::vector<int> partition<2>(const std::vector<base::Point<2>>&, const std::vector<double>&, int);
template std::vector<int> partition<3>(const std::vector<base::Point<3>>&, const std::vector<double>&, int);

}  // namespace perimorph::mesh
