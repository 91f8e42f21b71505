#pragma once

// Patch tests in 2D and 3D: uniform strain, prescribed as linear displacement on the boundary, and how far it is
// missed.

#include "support/fracture_body.hpp"

namespace perimorph::tests {

template <int dim>
using GradientIn = Eigen::Matrix<double, dim, dim>;

/// The boundary of the mesh moved by u = gradient x: node sets of one node each, as every node has its own value.
template <int dim>
SpecimenIn<dim> patch(mesh::Mesh<dim> whole, double horizon, double characteristic_length,
                      const GradientIn<dim>& gradient) {
  SpecimenIn<dim> specimen{{}, horizon, characteristic_length};
  for (const int n : std::vector<int>(whole.node_sets.at("boundary"))) {
    const std::string name = "boundary " + std::to_string(n);
    whole.node_sets[name] = {n};
    const base::Point<dim> u = gradient * whole.coordinates[n];
    for (int c = 0; c < dim; ++c) specimen.displacements.push_back({name, name, c, {u[c], 0.}});
  }
  specimen.whole = std::move(whole);
  return specimen;
}

/// Displacement at each node of the reference mesh: the mean of those of the nodes that stand on it.
template <int dim>
Eigen::Matrix<double, dim, Eigen::Dynamic> mean_displacement(const fracture::Body<dim>& body) {
  const auto model = body.model();
  Eigen::Matrix<double, dim, Eigen::Dynamic> sum = Eigen::MatrixXd::Zero(dim, model.mesh.n_nodes());
  std::vector<int> count(model.mesh.n_nodes(), 0);
  for (int n = 0; n < model.dofs.n_nodes(); ++n) {
    const int reference = model.dofs.reference_node(n);
    sum.col(reference) += base::at_node<dim>(body.displacement(), n);
    ++count[reference];
  }
  for (int n = 0; n < sum.cols(); ++n) sum.col(n) /= count[n];
  return sum;
}

/// Strain of an element at one of its points. @param u displacement of each corner's node
template <int dim, class Displacement>
GradientIn<dim> strain(const operators::CoupledModel<dim>& model, int e, int q, Displacement u) {
  const auto g = model.points.gradients(e, q);
  GradientIn<dim> h = GradientIn<dim>::Zero();
  for (int k = 0; k < model.mesh.n_corners(e); ++k) h += u(k) * g.col(k).transpose();
  return 0.5 * (h + h.transpose());
}

struct Errors {
  double displacement = 0.;  ///< largest at a node, over the largest displacement
  double strain = 0.;        ///< largest at a material point, over the strain; of the mean displacement, gaps included
  double rms_strain = 0.;    ///< root of the mean square over material points, of each element's own displacement
};

template <int dim>
Errors errors(const fracture::Body<dim>& body, const GradientIn<dim>& gradient) {
  using Point = base::Point<dim>;
  const auto model = body.model();
  Errors errors;
  double largest = 0.;
  for (int n = 0; n < model.dofs.n_nodes(); ++n) {
    const Point exact = gradient * model.mesh.coordinates[model.dofs.reference_node(n)];
    const Point u = base::at_node<dim>(body.displacement(), n);
    largest = std::max(largest, exact.norm());
    errors.displacement = std::max(errors.displacement, (u - exact).norm());
  }
  errors.displacement /= largest;

  const auto mean = mean_displacement(body);
  const GradientIn<dim> exact = 0.5 * (gradient + gradient.transpose());
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    const auto mean_at = [&](int k) -> Point { return mean.col(model.mesh.corners_of(e)[k]); };
    const auto own_at = [&](int k) -> Point {
      return Point(base::at_node<dim>(body.displacement(), model.dofs.nodes_of(e)[k]));
    };
    for (int q = 0; q < model.points.count(e); ++q) {
      errors.strain = std::max(errors.strain, (strain<dim>(model, e, q, mean_at) - exact).norm() / exact.norm());
      errors.rms_strain +=
          (strain<dim>(model, e, q, own_at) - exact).squaredNorm() / exact.squaredNorm() / model.points.size();
    }
  }
  errors.rms_strain = std::sqrt(errors.rms_strain);
  return errors;
}

template <int dim>
Errors solve(const SpecimenIn<dim>& specimen, const GradientIn<dim>& gradient) {
  SpecimenBodyIn<dim> test(specimen);
  test.body.apply_load(1.);
  test.body.update_topology();
  test.body.solve(fracture::Accuracy::accepted);
  return errors<dim>(test.body, gradient);
}

}  // namespace perimorph::tests
