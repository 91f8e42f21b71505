#include "perimorph/operators/morphed_stiffness.hpp"

#include <Eigen/Eigenvalues>

#include "perimorph/elements/strain.hpp"

namespace perimorph::operators {

namespace {

template <int dim>
base::Stiffness<dim> positive_part(const base::Stiffness<dim>& tensor) {
  const Eigen::SelfAdjointEigenSolver<base::Stiffness<dim>> eigen(tensor);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.).asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

template <int dim>
void MorphedStiffness<dim>::update(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                   const bonds::BondFamilies<dim>& bonds, const morphing::MorphingField<dim>& alpha,
                                   const std::vector<morphing::ElementClass>& classes,
                                   const std::vector<char>& discontinuous) {
  using morphing::ElementClass;
  first_.assign(mesh.n_elements(), -1);
  is_zero_.assign(mesh.n_elements(), 0);
  reduced_.clear();
  for (int e = 0; e < mesh.n_elements(); ++e) {
    is_zero_[e] = classes[e] == ElementClass::pd && policy_ == PeridynamicStiffness::dropped;
    if (bonds.pairs_of(e).empty()) continue;
    first_[e] = static_cast<int>(reduced_.size());
    reduced_.resize(reduced_.size() + points.count(e), is_zero_[e] ? base::Stiffness<dim>::Zero().eval() : e0_);
  }
  for (int p = 0; p < bonds.n_pairs(); ++p) {
    const auto [first, second] = bonds.pair(p);
    if (is_zero_[first] && is_zero_[second]) continue;
    for (auto b = bonds.first_bond(p); b < bonds.first_bond(p + 1); ++b) {
      const int qi = bonds.first_end(b), qj = bonds.second_end(b);
      const int i = points.first(first) + qi, j = points.first(second) + qj;
      const auto v = elements::squared<dim>(points.position(j) - points.position(i));
      const base::Stiffness<dim> term = 0.25 * (alpha(i) + alpha(j)) * bonds.stiffness(b) * v * v.transpose();
      if (!is_zero_[first]) reduced_[first_[first] + qi] -= term / points.weight(i);
      if (!is_zero_[second]) reduced_[first_[second] + qj] -= term / points.weight(j);
    }
  }
  for (int e = 0; e < mesh.n_elements(); ++e) {
    if (first_[e] < 0 || !discontinuous[e] || is_zero_[e]) continue;
    for (int q = 0; q < points.count(e); ++q) reduced_[first_[e] + q] = positive_part<dim>(reduced_[first_[e] + q]);
  }
}

template class MorphedStiffness<2>;
template class MorphedStiffness<3>;

}  // namespace perimorph::operators
