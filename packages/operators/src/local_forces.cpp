#include "perimorph/operators/local_forces.hpp"

#include <array>
#include <cmath>

#include "lanes.hpp"
#include "local_part.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/elements/strain.hpp"
#include "perimorph/operators/stiffness_matrix.hpp"

namespace perimorph::operators {

namespace {

template <int dim>
constexpr int n_moduli = base::n_voigt<dim>*(base::n_voigt<dim> + 1) / 2;

using LanesMap = Eigen::Map<const Lanes>;

template <int dim, int n>
using LaneMatrix = std::array<std::array<Lanes, dim>, n>;

/// Strain (Voigt) in every lane, from gradients (n, dim) and corner displacements.
template <int dim, int n>
std::array<Lanes, base::n_voigt<dim>> strain(const double* gradients, const LaneMatrix<dim, n>& u) {
  std::array<Lanes, base::n_voigt<dim>> result;
  result.fill(Lanes::Zero());
  for (int k = 0; k < n; ++k) {
    const auto g = [&](int c) { return LanesMap(gradients + (k * dim + c) * n_lanes); };
    for (int c = 0; c < dim; ++c) result[c] += g(c) * u[k][c];
    for (int v = dim; v < base::n_voigt<dim>; ++v) {
      const auto [i, j] = elements::shear_axes<dim>(v);
      result[v] += g(j) * u[k][i] + g(i) * u[k][j];
    }
  }
  return result;
}

/// force += B^T stress in every lane.
template <int dim, int n>
void add_divergence(const double* gradients, const std::array<Lanes, base::n_voigt<dim>>& stress,
                    LaneMatrix<dim, n>& force) {
  for (int k = 0; k < n; ++k) {
    const auto g = [&](int c) { return LanesMap(gradients + (k * dim + c) * n_lanes); };
    for (int c = 0; c < dim; ++c) force[k][c] += g(c) * stress[c];
    for (int v = dim; v < base::n_voigt<dim>; ++v) {
      const auto [i, j] = elements::shear_axes<dim>(v);
      force[k][i] += g(j) * stress[v];
      force[k][j] += g(i) * stress[v];
    }
  }
}

/// force -= B^T stress at a point of an element. @param stress times volume
template <int dim>
void subtract_divergence(const CoupledModel<dim>& model, int e, int q, const base::Voigt<dim>& stress,
                         base::Field force) {
  const auto gradients = model.points.gradients(e, q);
  for (int k = 0; k < model.mesh.n_corners(e); ++k) {
    double* at_node = force.getRawPtr() + static_cast<std::ptrdiff_t>(model.dofs.nodes_of(e)[k]) * dim;
    for (int c = 0; c < dim; ++c) at_node[c] -= gradients(c, k) * stress[c];
    for (int v = dim; v < base::n_voigt<dim>; ++v) {
      const auto [i, j] = elements::shear_axes<dim>(v);
      at_node[i] -= gradients(j, k) * stress[v];
      at_node[j] -= gradients(i, k) * stress[v];
    }
  }
}

}  // namespace

template <int dim>
LocalForces<dim>::LocalForces(const CoupledModel<dim>& model, const MeshPart& part) : ElasticTerm<dim>(model) {
  std::vector<std::size_t> n_elements;  // in each group
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    if (!part.holds_element(e) || !model.bonds.is_active(e) || model.elasticity.is_zero(e)) continue;
    const int n = model.mesh.n_corners(e), n_points = model.points.count(e);
    Group& g = group(n, n_points, model.elasticity.is_e0(e) ? &model.elasticity.e0(e) : nullptr);
    n_elements.resize(groups_.size(), 0);
    const std::size_t position = n_elements[&g - groups_.data()]++;
    const std::size_t four = position / n_lanes, lane = position % n_lanes;
    if (lane == 0) {
      g.nodes.resize(g.nodes.size() + n * n_lanes, model.dofs.nodes_of(e)[0]);
      g.gradients.resize(g.gradients.size() + n_points * n * dim * n_lanes, 0.);
      if (g.e0 == nullptr) g.stiffness.resize(g.stiffness.size() + n_points * n_moduli<dim> * n_lanes, 0.);
    }
    for (int k = 0; k < n; ++k) g.nodes[(four * n + k) * n_lanes + lane] = model.dofs.nodes_of(e)[k];
    for (int q = 0; q < n_points; ++q) {
      const auto gradients = model.points.gradients(e, q);
      const double root = std::sqrt(model.points.weight(model.points.first(e) + q));
      double* target = g.gradients.data() + (four * n_points + q) * n * dim * n_lanes + lane;
      for (int k = 0; k < n; ++k) {
        for (int c = 0; c < dim; ++c) target[(k * dim + c) * n_lanes] = root * gradients(c, k);
      }
      if (g.e0 != nullptr) continue;
      double* modulus = g.stiffness.data() + (four * n_points + q) * n_moduli<dim> * n_lanes + lane;
      for (int v = 0; v < base::n_voigt<dim>; ++v) {
        for (int w = 0; w <= v; ++w, modulus += n_lanes) *modulus = model.elasticity.at(e, q)(v, w);
      }
    }
  }
}

template <int dim>
typename LocalForces<dim>::Group& LocalForces<dim>::group(int n_corners, int n_points, const base::Stiffness<dim>* e0) {
  for (auto& g : groups_) {
    if (g.n_corners == n_corners && g.n_points == n_points && g.e0 == e0) return g;
  }
  groups_.push_back({n_corners, n_points, e0, {}, {}, {}});
  return groups_.back();
}

template <int dim>
void LocalForces<dim>::add_tangent_product(base::ConstField x, base::Field force) const {
  const auto n = static_cast<base::ConstField::size_type>(model_.dofs.n_nodes()) * dim;
  PERIMORPH_ASSERT(x.size() == n && force.size() == n, "{} displacements and {} forces on {} degrees of freedom",
                   x.size(), force.size(), n);
  const double* u = x.getRawPtr();
  double* forces = force.getRawPtr();
  for (const auto& g : groups_) {
    elements::with_corners<dim>(g.n_corners, [&](auto corners) { add<decltype(corners)::value>(g, u, forces); });
  }
}

template <int dim>
template <int n>
void LocalForces<dim>::add(const Group& g, const double* u, double* force) const {
  constexpr int n_voigt = base::n_voigt<dim>;
  const double* gradients = g.gradients.data();
  const double* moduli = g.stiffness.data();
  for (std::size_t first = 0; first < g.nodes.size(); first += n * n_lanes) {
    const int* nodes = g.nodes.data() + first;
    LaneMatrix<dim, n> displacement, forces;
    for (int k = 0; k < n; ++k) {
      for (int c = 0; c < dim; ++c) {
        forces[k][c].setZero();
        for (int lane = 0; lane < n_lanes; ++lane) displacement[k][c][lane] = u[nodes[k * n_lanes + lane] * dim + c];
      }
    }
    for (int q = 0; q < g.n_points; ++q, gradients += n * dim * n_lanes) {
      const auto strains = strain<dim, n>(gradients, displacement);
      std::array<Lanes, n_voigt> stresses;
      stresses.fill(Lanes::Zero());
      if (g.e0 == nullptr) {
        for (int v = 0; v < n_voigt; ++v) {
          for (int w = 0; w <= v; ++w, moduli += n_lanes) {
            stresses[v] += LanesMap(moduli) * strains[w];
            if (w != v) stresses[w] += LanesMap(moduli) * strains[v];
          }
        }
      } else {
        for (int v = 0; v < n_voigt; ++v) {
          for (int w = 0; w < n_voigt; ++w) stresses[v] += (*g.e0)(v, w) * strains[w];
        }
      }
      add_divergence<dim, n>(gradients, stresses, forces);
    }
    for (int k = 0; k < n; ++k) {
      for (int lane = 0; lane < n_lanes; ++lane) {
        for (int c = 0; c < dim; ++c) force[nodes[k * n_lanes + lane] * dim + c] += forces[k][c][lane];
      }
    }
  }
}

/// K_local u - Sum_q w B^T E(x) I times the eigenstrain.
template <int dim>
void LocalForces<dim>::add_force_at(base::ConstField u, const std::vector<double>& eigenstrain,
                                    base::Field force) const {
  add_tangent_product(u, force);
  for (int e = 0; e < model_.mesh.n_elements(); ++e) {
    if (!model_.bonds.is_active(e) || model_.elasticity.is_zero(e)) continue;
    for (int q = 0; q < model_.points.count(e); ++q) {
      const int point = model_.points.first(e) + q;
      const base::Stiffness<dim> weighted = model_.points.weight(point) * model_.elasticity.at(e, q);
      subtract_divergence(model_, e, q, eigenstrain[point] * weighted.template leftCols<dim>().rowwise().sum(), force);
    }
  }
}

/// - w I . E(x) (eps - eigenstrain I)
template <int dim>
void LocalForces<dim>::add_confinement(base::ConstField u, base::Field at_points) const {
  for (int e = 0; e < model_.mesh.n_owned_elements; ++e) {
    if (model_.elasticity.is_zero(e)) continue;
    visit_local_part(model_, e, u, [&](int q, const base::Voigt<dim>&, const base::Voigt<dim>& stress, double w) {
      at_points[model_.points.first(e) + q] -= w * stress.template head<dim>().sum();
    });
  }
}

/// K_e = Sum_q w B^T E(x) B, element by element.
template <int dim>
void LocalForces<dim>::add_to(StiffnessMatrix<dim>& matrix) const {
  for (int e = 0; e < model_.mesh.n_elements(); ++e) {
    if (!model_.bonds.is_active(e) || model_.elasticity.is_zero(e)) continue;
    elements::with_corners<dim>(model_.mesh.n_corners(e), [&](auto corners) {
      constexpr int n = decltype(corners)::value;
      Eigen::Matrix<double, dim * n, dim* n> k = Eigen::Matrix<double, dim * n, dim * n>::Zero();
      for (int q = 0; q < model_.points.count(e); ++q) {
        const auto b = elements::strain_matrix<dim, n>(model_.points.gradients(e, q));
        const base::Stiffness<dim> weighted =
            model_.points.weight(model_.points.first(e) + q) * model_.elasticity.at(e, q);
        k.noalias() += b.transpose() * (weighted * b);
      }
      matrix.add_element(e, k);
    });
  }
}

template <int dim>
std::size_t LocalForces<dim>::bytes() const {
  std::size_t sum = 0;
  for (const auto& g : groups_) {
    sum += g.nodes.size() * sizeof(int) + (g.gradients.size() + g.stiffness.size()) * sizeof(double);
  }
  return sum;
}

template class LocalForces<2>;
template class LocalForces<3>;

}  // namespace perimorph::operators
