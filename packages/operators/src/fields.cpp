#include "perimorph/operators/fields.hpp"

#include <Eigen/Eigenvalues>
#include <limits>

#include "at_points.hpp"
#include "local_part.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/elements/strain.hpp"

namespace perimorph::operators {

using base::Point;

namespace {

/// Calls visit(bond, energy, stress) for each intact bond of a pair of elements, with its share in each end's energy
/// and stress times volume.
template <int dim, class Visit>
void visit_bonds(const CoupledModel<dim>& model, int p, const PointFields<dim>& at_points, Visit visit) {
  model.bonds.for_each_bond(p, [&](const bonds::Bond<dim>& bond) {
    if (bond.is_broken) return;
    const BondSpring<dim> spring(model, bond, at_points);
    const base::Voigt<dim> stress = 0.5 * spring.tension * elements::squared<dim>(spring.xi);
    visit(bond, 0.5 * spring.energy(), stress);
  });
}

/// Calls visit as visit_bonds() does, for each closed contact.
template <int dim, class Visit>
void visit_contacts(const PointFields<dim>& at_points, Visit visit) {
  for (const auto& contact : at_points.contacts) {
    const Point<dim>&pull = contact.pull, &xi = contact.bond.xi;
    base::Voigt<dim> stress;
    stress.template head<dim>() = pull.cwiseProduct(xi);
    for (int v = dim; v < base::n_voigt<dim>; ++v) {
      const auto [i, j] = elements::shear_axes<dim>(v);
      stress[v] = 0.5 * (pull[i] * xi[j] + pull[j] * xi[i]);
    }
    visit(contact.bond, 0.5 * contact.energy, 0.5 * stress);
  }
}

template <int dim>
void add_local_part(const CoupledModel<dim>& model, base::ConstField u, ElementFields<dim>& fields) {
  for (int e = 0; e < model.mesh.n_owned_elements; ++e) {
    visit_local_part(model, e, u, [&](int, const base::Voigt<dim>& strain, const base::Voigt<dim>& stress, double w) {
      fields.energy[e] += 0.5 * w * strain.dot(stress);
      fields.stress[e] += w * stress;
    });
  }
}

template <int dim>
void add_bonds_part(const CoupledModel<dim>& model, const PointFields<dim>& at_points, ElementFields<dim>& fields) {
  const auto add = [&](const bonds::Bond<dim>& bond, double energy, const base::Voigt<dim>& stress) {
    for (const int e : {bond.first_element, bond.second_element}) {
      if (e >= model.mesh.n_owned_elements) continue;
      fields.energy[e] += energy;
      fields.stress[e] += stress;
    }
  };
  for (int p = 0; p < model.bonds.n_pairs(); ++p) visit_bonds(model, p, at_points, add);
  visit_contacts(at_points, add);
}

}  // namespace

template <int dim>
std::vector<Point<dim>> displacements_at_points(const CoupledModel<dim>& model, base::ConstField u) {
  const auto n_dofs = static_cast<base::ConstField::size_type>(model.dofs.n_nodes()) * dim;
  PERIMORPH_ASSERT(u.size() == n_dofs, "{} displacements for {} degrees of freedom", u.size(), n_dofs);
  std::vector<Point<dim>> at_points(model.points.size(), Point<dim>::Zero());
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    if (model.bonds.pairs_of(e).empty()) continue;
    for (int q = 0; q < model.points.count(e); ++q) {
      at_points[model.points.first(e) + q] = displacement_at(model, u, e, q);
    }
  }
  return at_points;
}

template <int dim>
std::vector<double> dilatation_at_points(const CoupledModel<dim>& model, const PointFields<dim>& at_points,
                                         const discretization::HaloExchange& elements) {
  const auto n = static_cast<std::size_t>(model.points.size());
  PERIMORPH_ASSERT(at_points.displacement.size() == n, "displacements at {} of {} points",
                   at_points.displacement.size(), n);
  std::vector<double> dilatation(n, 0.), weighted_volume(n, 0.);
  model.bonds.for_each_bond([&](const bonds::Bond<dim>& bond) {
    if (bond.is_broken) return;
    const double squared_length = bond.xi.squaredNorm();
    const double weight = model.bonds.stiffness(bond) * model.bonds.share_left(bond) * squared_length;
    const double elongation = bond.xi.dot(at_points.relative_displacement(bond));
    for (const int point : {bond.first_point, bond.second_point}) {
      dilatation[point] += dim * weight * elongation;
      weighted_volume[point] += weight * squared_length;
    }
  });
  for (std::size_t i = 0; i < n; ++i) dilatation[i] = weighted_volume[i] > 0. ? dilatation[i] / weighted_volume[i] : 0.;
  elements.update(dilatation, [&](int e) { return model.points.first(e); });
  return dilatation;
}

template <int dim>
ElementFields<dim> element_fields(const CoupledModel<dim>& model, base::ConstField u,
                                  const PointFields<dim>& at_points) {
  PERIMORPH_ASSERT(static_cast<int>(at_points.displacement.size()) == model.points.size(),
                   "displacements at {} of {} points", at_points.displacement.size(), model.points.size());
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

template <int dim>
std::vector<base::Voigt<dim>> stress_at_points(const CoupledModel<dim>& model, int element, base::ConstField u,
                                               const PointFields<dim>& at_points) {
  PERIMORPH_ASSERT(element >= 0 && element < model.mesh.n_owned_elements, "element {} of {} owned ones", element,
                   model.mesh.n_owned_elements);
  PERIMORPH_ASSERT(static_cast<int>(at_points.displacement.size()) == model.points.size(),
                   "displacements at {} of {} points", at_points.displacement.size(), model.points.size());
  const int first = model.points.first(element), end = model.points.first(element + 1);
  std::vector<base::Voigt<dim>> stress(end - first, base::Voigt<dim>::Zero());
  const auto add = [&](const bonds::Bond<dim>& bond, double, const base::Voigt<dim>& share) {
    for (const int point : {bond.first_point, bond.second_point}) {
      if (point >= first && point < end) stress[point - first] += share / model.points.weight(point);
    }
  };
  for (const int p : model.bonds.pairs_of(element)) visit_bonds(model, p, at_points, add);
  visit_contacts(at_points, add);
  visit_local_part(model, element, u,
                   [&](int q, const base::Voigt<dim>&, const base::Voigt<dim>& local, double) { stress[q] += local; });
  return stress;
}

template <int dim>
double largest_principal_strain(const CoupledModel<dim>& model, int element, base::ConstField u) {
  PERIMORPH_ASSERT(element >= 0 && element < model.mesh.n_elements(), "element {} of {}", element,
                   model.mesh.n_elements());
  double largest = -std::numeric_limits<double>::infinity();
  visit_local_part(model, element, u, [&](int, const base::Voigt<dim>& strain, const base::Voigt<dim>&, double) {
    Eigen::Matrix<double, dim, dim> tensor = strain.template head<dim>().asDiagonal();
    for (int v = dim; v < base::n_voigt<dim>; ++v) {
      const auto [i, j] = elements::shear_axes<dim>(v);
      tensor(i, j) = tensor(j, i) = 0.5 * strain[v];
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, dim, dim>> solver(tensor, Eigen::EigenvaluesOnly);
    largest = std::max(largest, solver.eigenvalues()[dim - 1]);
  });
  return largest;
}

template double largest_principal_strain<2>(const CoupledModel<2>&, int, base::ConstField);
template double largest_principal_strain<3>(const CoupledModel<3>&, int, base::ConstField);

template ElementFields<2> element_fields<2>(const CoupledModel<2>&, base::ConstField, const PointFields<2>&);
template ElementFields<3> element_fields<3>(const CoupledModel<3>&, base::ConstField, const PointFields<3>&);

template std::vector<base::Voigt<2>> stress_at_points<2>(const CoupledModel<2>&, int, base::ConstField,
                                                         const PointFields<2>&);
template std::vector<base::Voigt<3>> stress_at_points<3>(const CoupledModel<3>&, int, base::ConstField,
                                                         const PointFields<3>&);

template std::vector<Point<2>> displacements_at_points<2>(const CoupledModel<2>&, base::ConstField);
template std::vector<double> dilatation_at_points<2>(const CoupledModel<2>&, const PointFields<2>&,
                                                     const discretization::HaloExchange&);
template std::vector<Point<3>> displacements_at_points<3>(const CoupledModel<3>&, base::ConstField);
template std::vector<double> dilatation_at_points<3>(const CoupledModel<3>&, const PointFields<3>&,
                                                     const discretization::HaloExchange&);

}  // namespace perimorph::operators
