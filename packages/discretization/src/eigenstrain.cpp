#include "perimorph/discretization/eigenstrain.hpp"

#include <algorithm>
#include <cmath>

#include "perimorph/base/errors.hpp"

namespace perimorph::discretization {

namespace {

/// By the mesh's blocks: whether the temperature changes there.
template <int dim>
std::vector<char> changed_blocks(const mesh::Mesh<dim>& mesh, const TemperatureChange<dim>& change) {
  std::vector<char> is_changed;
  for (const auto& name : mesh.block_names) {
    is_changed.push_back(change.blocks.empty() ||
                         std::find(change.blocks.begin(), change.blocks.end(), name) != change.blocks.end());
  }
  return is_changed;
}

template <int dim>
std::vector<double> expansion_per_degree(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                         const TemperatureChange<dim>& change, const std::vector<double>& expansion) {
  const auto is_changed = changed_blocks(mesh, change);
  std::vector<double> at_points(points.size(), 0.);
  for (int e = 0; e < mesh.n_real_elements(); ++e) {
    if (!is_changed[mesh.blocks[e]]) continue;
    for (int p = points.first(e); p < points.first(e + 1); ++p) {
      const auto& profile = change.profile;
      const double factor = profile ? profile->factor.at(profile->direction.dot(points.position(p))) : 1.;
      at_points[p] = factor * expansion[e];
    }
  }
  for (int image = mesh.n_real_elements(); image < mesh.n_elements(); ++image) {
    const int source = mesh.image(image).element;
    std::copy_n(at_points.begin() + points.first(source), points.count(source),
                at_points.begin() + points.first(image));
  }
  return at_points;
}

}  // namespace

template <int dim>
Eigenstrain<dim>::Eigenstrain(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                              const std::vector<TemperatureChange<dim>>& changes,
                              const std::vector<double>& expansion) {
  PERIMORPH_ASSERT(static_cast<int>(expansion.size()) == mesh.n_elements(), "{} coefficients for {} elements",
                   expansion.size(), mesh.n_elements());
  for (const auto& change : changes) {
    parts_.push_back({change.value, expansion_per_degree(mesh, points, change, expansion)});
  }
  if (exists()) at_points_.assign(points.size(), 0.);
}

template <int dim>
void Eigenstrain<dim>::apply_load(double load_factor) {
  PERIMORPH_ASSERT(std::isfinite(load_factor), "load factor {}", load_factor);
  load_factor_ = load_factor;
  at_points_ = sum([&](const Ramp<double>& value) { return value.at(load_factor); });
}

template <int dim>
std::vector<double> Eigenstrain<dim>::rates(double step) const {
  return sum([&](const Ramp<double>& value) { return value.rate_in(load_factor_, step); });
}

/// Over all parts, of value(ramp) times what a degree does.
template <int dim>
template <class Value>
std::vector<double> Eigenstrain<dim>::sum(Value value) const {
  std::vector<double> total(at_points_.size(), 0.);
  for (const auto& part : parts_) {
    const double degrees = value(part.value);
    for (std::size_t p = 0; p < total.size(); ++p) total[p] += degrees * part.per_degree[p];
  }
  return total;
}

template class Eigenstrain<2>;
template class Eigenstrain<3>;

}  // namespace perimorph::discretization
