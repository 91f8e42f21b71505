// All of Zoltan2 is in this file: it takes half a minute to compile.

#include "partition.hpp"

#include <Teuchos_DefaultMpiComm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Zoltan2_BasicVectorAdapter.hpp>
#include <Zoltan2_PartitioningProblem.hpp>
#include <Zoltan2_PartitioningSolution.hpp>
#include <algorithm>
#include <array>

#include "perimorph/base/directory.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::mesh {

namespace {

using base::GlobalId;
using Types = Zoltan2::BasicUserTypes<double, int, GlobalId>;
using Adapter = Zoltan2::BasicVectorAdapter<Types>;

/// A point on its way to the rank that has it while it is being parted.
template <int dim>
struct WeightedPoint {
  GlobalId id;
  std::array<double, dim> x;
  double weight;
};

Teuchos::ParameterList multijagged(int n_parts) {
  Teuchos::ParameterList options;
  options.set("algorithm", "multijagged");
  options.set("num_global_parts", n_parts);
  options.set("imbalance_tolerance", 1.02);
  return options;
}

/// Each point's part. Collective.
template <int dim>
std::vector<int> multijagged_parts(const base::Comm& comm, const std::vector<WeightedPoint<dim>>& points) {
  std::vector<GlobalId> ids(points.size());
  std::vector<std::vector<double>> values(dim + 1, std::vector<double>(points.size() + 1));  // never without address
  for (std::size_t i = 0; i < points.size(); ++i) {
    ids[i] = points[i].id;
    for (std::size_t d = 0; d < dim; ++d) values[d][i] = points[i].x[d];
    values[dim][i] = points[i].weight;
  }
  std::vector<const double*> components, weights = {values[dim].data()};
  for (int d = 0; d < dim; ++d) components.push_back(values[static_cast<std::size_t>(d)].data());
  std::vector<int> strides(dim, 1), weight_strides = {1};
  Adapter adapter(static_cast<int>(ids.size()), ids.data(), components, strides, weights, weight_strides);
  Teuchos::ParameterList options = multijagged(comm.getSize());
  Zoltan2::PartitioningProblem<Adapter> problem(&adapter, &options, Teuchos::rcpFromRef(comm));
  problem.solve();
  const int* parts = problem.getSolution().getPartListView();
  return points.empty() ? std::vector<int>() : std::vector<int>(parts, parts + points.size());
}

}  // namespace

template <int dim>
std::vector<int> partition(const base::Comm& comm, const std::vector<GlobalId>& ids,
                           const std::vector<base::Point<dim>>& points, const std::vector<double>& weights) {
  base::on_all_ranks(comm, [&] {
    PERIMORPH_ASSERT(ids.size() == points.size() && weights.size() == points.size(), "{} points, {} ids, {} weights",
                     points.size(), ids.size(), weights.size());
    PERIMORPH_ASSERT(std::all_of(points.begin(), points.end(), [](const auto& x) { return x.allFinite(); }),
                     "one of {} points is nowhere", points.size());
  });
  const GlobalId n = base::sum(comm, static_cast<GlobalId>(points.size()));
  if (comm.getSize() == 1 || n == 0) return std::vector<int>(points.size(), 0);

  const base::Directory directory(comm, n, ids);
  std::vector<WeightedPoint<dim>> own(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    own[i] = {ids[i], {}, weights[i]};
    std::copy_n(points[i].data(), dim, own[i].x.begin());
  }
  return directory.answers(multijagged_parts<dim>(comm, directory.collect(own)));
}

#define PERIMORPH_INSTANTIATE(dim)                                                     \
  template std::vector<int> partition(const base::Comm&, const std::vector<GlobalId>&, \
                                      const std::vector<base::Point<dim>>&, const std::vector<double>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh
