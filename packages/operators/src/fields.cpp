#include "perimorph/operators/fields.hpp"

#include "perimorph/elements/strain.hpp"

namespace perimorph::operators {

using base::Point;

namespace {

template <int dim>
void add_local_part(const CoupledModel<dim>& model, const double* u, ElementFields<dim>& fields) {
  for (int e = 0; e < model.mesh.n_owned_elements; ++e) {
    elements::with_corners<dim>(model.mesh.n_corners(e), [&](auto corners) {
      constexpr int n = decltype(corners)::value;
      Eigen::Matrix<double, dim * n, 1> d;
      for (int k = 0; k < n; ++k) {
        d.template segment<dim>(k * dim) = Eigen::Map<const Point<dim>>(u + model.dofs.nodes_of(e)[k] * dim);
      }
      for (int q = 0; q < model.points.count(e); ++q) {
        const double w = model.points.weight(model.points.first(e) + q);
        const base::Voigt<dim> strain = elements::strain_matrix<dim, n>(model.points.gradients(e, q)) * d;
        const base::Voigt<dim> stress = model.elasticity.at(e, q) * strain;
        fields.energy[e] += 0.5 * w * strain.dot(stress);
        fields.stress[e] += w * stress;
      }
    });
  }
}

template <int dim>
void add_bonds_part(const CoupledModel<dim>& model, const std::vector<Point<dim>>& u, ElementFields<dim>& fields) {
  for (int p = 0; p < model.bonds.n_pairs(); ++p) {
    const auto [first, second] = model.bonds.pair(p);
    for (auto b = model.bonds.first_bond(p); b < model.bonds.first_bond(p + 1); ++b) {
      if (model.bonds.broken(b)) continue;
      const int i = model.points.first(first) + model.bonds.first_end(b);
      const int j = model.points.first(second) + model.bonds.second_end(b);
      const Point<dim> xi = model.points.position(j) - model.points.position(i);
      const double stretch = xi.dot(u[j] - u[i]), k = model.spring(b, i, j);
      for (const int e : {first, second}) {
        if (e >= model.mesh.n_owned_elements) continue;
        fields.energy[e] += 0.25 * k * stretch * stretch;
        fields.stress[e] += 0.5 * k * stretch * elements::squared<dim>(xi);
      }
    }
  }
}

}  // namespace

template <int dim>
std::vector<Point<dim>> displacements_at_points(const CoupledModel<dim>& model, const double* u) {
  std::vector<Point<dim>> at_points(model.points.size(), Point<dim>::Zero());
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    if (model.bonds.pairs_of(e).empty()) continue;
    const int* nodes = model.dofs.nodes_of(e);
    for (int q = 0; q < model.points.count(e); ++q) {
      const auto& shape = model.points.shape(e, q);
      Point<dim>& value = at_points[model.points.first(e) + q];
      for (int k = 0; k < model.mesh.n_corners(e); ++k) {
        value += shape[k] * Eigen::Map<const Point<dim>>(u + nodes[k] * dim);
      }
    }
  }
  return at_points;
}

template <int dim>
ElementFields<dim> element_fields(const CoupledModel<dim>& model, const double* u,
                                  const std::vector<Point<dim>>& at_points) {
  const auto n = static_cast<std::size_t>(model.mesh.n_owned_elements);
  ElementFields<dim> fields{std::vector<double>(n, 0.), std::vector<base::Voigt<dim>>(n, base::Voigt<dim>::Zero())};
  add_local_part(model, u, fields);
  add_bonds_part(model, at_points, fields);
  for (std::size_t e = 0; e < n; ++e) {
    double volume = 0.;
    for (int q = 0; q < model.points.count(static_cast<int>(e)); ++q) {
      volume += model.points.weight(model.points.first(static_cast<int>(e)) + q);
    }
    fields.stress[e] /= volume;
  }
  return fields;
}

template ElementFields<2> element_fields<2>(const CoupledModel<2>&, const double*, const std::vector<Point<2>>&);
template ElementFields<3> element_fields<3>(const CoupledModel<3>&, const double*, const std::vector<Point<3>>&);

template std::vector<Point<2>> displacements_at_points<2>(const CoupledModel<2>&, const double*);
template std::vector<Point<3>> displacements_at_points<3>(const CoupledModel<3>&, const double*);

}  // namespace perimorph::operators
