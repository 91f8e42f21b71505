#include "perimorph/discretization/boundary_conditions.hpp"

namespace perimorph::discretization {

template <int dim>
std::vector<Contradiction> contradictions(const mesh::Mesh<dim>& mesh,
                                          const std::vector<PrescribedComponent>& conditions) {
  std::vector<Contradiction> all;
  std::vector<int> set_by(mesh.coordinates.size() * dim, -1);
  for (int i = 0; i < static_cast<int>(conditions.size()); ++i) {
    const auto group = mesh.node_sets.find(conditions[i].node_set);
    if (group == mesh.node_sets.end()) continue;
    for (const int node : group->second) {
      int& first = set_by[static_cast<std::size_t>(node) * dim + conditions[i].component];
      if (first < 0) first = i;
      if (!(conditions[first].value == conditions[i].value)) all.push_back({first, i, node});
    }
  }
  return all;
}

template std::vector<Contradiction> contradictions(const mesh::Mesh<2>&, const std::vector<PrescribedComponent>&);
template std::vector<Contradiction> contradictions(const mesh::Mesh<3>&, const std::vector<PrescribedComponent>&);

}  // namespace perimorph::discretization
