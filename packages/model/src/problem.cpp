#include "perimorph/model/problem.hpp"

#include "perimorph/mesh/distribute.hpp"

namespace perimorph::model {

template <int dim>
mesh::Mesh<dim> distribute_mesh(const base::Comm& comm, const mesh::Mesh<dim>& whole, const Problem<dim>& problem,
                                const std::vector<double>& costs) {
  const bool is_uncracked_and_classical = !problem.has_zones() && problem.pre_cracks.empty();
  return mesh::distribute(comm, whole, is_uncracked_and_classical ? 0. : problem.micromodulus.horizon, costs);
}

template mesh::Mesh<2> distribute_mesh<2>(const base::Comm&, const mesh::Mesh<2>&, const Problem<2>&,
                                          const std::vector<double>&);
template mesh::Mesh<3> distribute_mesh<3>(const base::Comm&, const mesh::Mesh<3>&, const Problem<3>&,
                                          const std::vector<double>&);

}  // namespace perimorph::model
