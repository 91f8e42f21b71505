#include "perimorph/operators/crack_normals.hpp"

#include <Eigen/Eigenvalues>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/point_tree.hpp"

namespace perimorph::operators {

using base::Point;

namespace {

template <int dim>
using Matrix = Eigen::Matrix<double, dim, dim>;

template <int dim, class Moments>
auto matrix(Moments& moments) {
  return Eigen::Map<std::conditional_t<std::is_const_v<Moments>, const Matrix<dim>, Matrix<dim>>>(moments.data());
}

/// Whether all bonds hold.
template <int dim, class Moments>
bool is_empty(const Moments& moments) {
  return matrix<dim>(moments).trace() == 0.;
}

}  // namespace

template <int dim>
CrackNormals<dim>::CrackNormals(const CoupledModel<dim>& model, const discretization::Topology<dim>& topology)
    : around_(model.mesh.n_elements(), Moments{}) {
  std::vector<Moments> own(model.mesh.n_elements(), Moments{});
  const auto add = [&](const bonds::Bond<dim>& bond) {
    const double lost = model.share_lost(bond);
    if (lost == 0.) return;
    const double volumes = model.points.weight(bond.first_point) * model.points.weight(bond.second_point);
    const Matrix<dim> moments = lost * volumes * bond.xi * bond.xi.transpose();
    for (const int e : {bond.first_element, bond.second_element}) matrix<dim>(own[e]) += moments;
  };
  model.bonds.for_each_bond(add);
  for (const auto& bond : topology.bonds_across_faces()) add(bond);
  topology.element_exchange().update(own);

  std::vector<int> cracked;
  std::vector<Point<dim>> centroids;
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    if (is_empty<dim>(own[e])) continue;
    cracked.push_back(e);
    centroids.push_back(mesh::centroid(model.mesh, e));
  }
  const base::PointTree<dim> tree(centroids);
  for (std::size_t i = 0; i < cracked.size(); ++i) {
    if (cracked[i] >= model.mesh.n_owned_elements) continue;
    auto sum = matrix<dim>(around_[cracked[i]]);
    for (const int j : tree.within(centroids[i], model.bonds.materials().horizon()))
      sum += matrix<dim>(own[cracked[j]]);
  }
  topology.element_exchange().update(around_);
}

template <int dim>
Point<dim> CrackNormals<dim>::across(const bonds::Bond<dim>& bond) const {
  PERIMORPH_DEBUG_ASSERT(bond.first_element < static_cast<int>(around_.size()), "element {} of {}", bond.first_element,
                         around_.size());
  const Matrix<dim> sum = matrix<dim>(around_[bond.first_element]) + matrix<dim>(around_[bond.second_element]);
  if (sum.trace() == 0.) return bond.xi.normalized();
  return Eigen::SelfAdjointEigenSolver<Matrix<dim>>(sum).eigenvectors().col(dim - 1);
}

template class CrackNormals<2>;
template class CrackNormals<3>;

}  // namespace perimorph::operators
