#include "perimorph/model/problem.hpp"

#include <algorithm>

#include "perimorph/mesh/distribute.hpp"
#include "perimorph/mesh/images.hpp"

namespace perimorph::model {

template <int dim>
bool Problem<dim>::breaks() const {
  return std::any_of(materials.begin(), materials.end(), [](const auto& m) { return m.toughness.breaks(); });
}

template <int dim>
std::vector<int> materials_of_elements(const mesh::Mesh<dim>& mesh, const Problem<dim>& problem) {
  std::vector<int> of_block;
  for (const auto& name : mesh.block_names) {
    const auto found = problem.material_of_block.find(name);
    of_block.push_back(found == problem.material_of_block.end() ? 0 : found->second);
  }
  std::vector<int> of_element;
  for (const int block : mesh.blocks) of_element.push_back(of_block[block]);
  return of_element;
}

template <int dim>
materials::BondMaterials bond_materials(const mesh::Mesh<dim>& mesh, const Problem<dim>& problem) {
  const std::size_t n = problem.materials.size();
  std::vector<materials::Micromodulus> micromoduli;
  std::vector<materials::BondLaw> laws(n * n);
  const auto law_of = [](const materials::BondLaw& law, const auto& one, const auto& other) {
    return law.under(materials::lateral_compression<dim>(one, other, law));
  };
  for (std::size_t m = 0; m < n; ++m) {
    micromoduli.push_back(problem.materials[m].micromodulus);
    const auto& material = problem.materials[m];
    laws[m * n + m] = law_of(material.toughness.law, material, material);
  }
  for (const auto& [first, second, toughness] : problem.interfaces) {
    laws[first * n + second] = laws[second * n + first] =
        law_of(toughness.law, problem.materials[first], problem.materials[second]);
  }
  return {std::move(micromoduli), std::move(laws), materials_of_elements(mesh, problem)};
}

template <int dim>
discretization::Eigenstrain<dim> eigenstrain(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                             const Problem<dim>& problem) {
  if (problem.temperature_changes.empty()) return {};
  std::vector<double> expansion;
  for (const int m : materials_of_elements(mesh, problem)) expansion.push_back(problem.materials[m].thermal_expansion);
  return {mesh, points, problem.temperature_changes, expansion};
}

template <int dim>
mesh::Mesh<dim> distribute_mesh(const base::Comm& comm, const mesh::Mesh<dim>& from, const Problem<dim>& problem,
                                const std::vector<double>& costs) {
  const bool is_uncracked_and_classical = !problem.has_zones() && problem.pre_cracks.empty();
  const double width = is_uncracked_and_classical ? 0. : problem.horizon();
  auto part = mesh::distribute(comm, from, width, costs);
  std::vector<mesh::SymmetryPlane> planes;
  for (const auto& group : problem.symmetry_planes) planes.push_back(mesh::symmetry_plane(comm, part, group));
  mesh::add_images(part, std::move(planes), width);
  return part;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                                    \
  template struct Problem<dim>;                                                                                       \
  template std::vector<int> materials_of_elements(const mesh::Mesh<dim>&, const Problem<dim>&);                       \
  template materials::BondMaterials bond_materials(const mesh::Mesh<dim>&, const Problem<dim>&);                      \
  template discretization::Eigenstrain<dim> eigenstrain(const mesh::Mesh<dim>&, const elements::MaterialPoints<dim>&, \
                                                        const Problem<dim>&);                                         \
  template mesh::Mesh<dim> distribute_mesh(const base::Comm&, const mesh::Mesh<dim>&, const Problem<dim>&,            \
                                           const std::vector<double>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::model
