#include "perimorph/operators/morphed_stiffness.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "perimorph/base/errors.hpp"
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
  const auto n = static_cast<std::size_t>(mesh.n_elements());
  PERIMORPH_ASSERT(classes.size() == n && discontinuous.size() == n, "{} classes and {} flags for {} elements",
                   classes.size(), discontinuous.size(), n);
  first_.resize(mesh.n_elements(), -1);
  is_zero_.resize(mesh.n_elements(), 0);
  alpha_.resize(points.size(), 0.);
  const auto is_alpha_new = take_over(points, alpha);
  seen_.resize(mesh.n_elements());
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const bool is_mixed = sees_another_material(e, bonds);
    is_zero_[e] = classes[e] == morphing::ElementClass::pd && policy_ == PeridynamicStiffness::dropped &&
                  !(is_mixed && !bonds.is_damaged(e));
    const char is_clipped = discontinuous[e] || is_mixed;
    const Seen now{bonds.pairs_of(e).size(), is_zero_[e], is_clipped};
    const bool is_touched = std::any_of(bonds.pairs_of(e).begin(), bonds.pairs_of(e).end(), [&](int p) {
      return is_alpha_new[bonds.pair(p).first] || is_alpha_new[bonds.pair(p).second];
    });
    if (now == seen_[e] && !is_touched) continue;
    seen_[e] = now;
    if (now.n_pairs > 0) compute(e, points, bonds, is_clipped != 0);
  }
}

template <int dim>
bool MorphedStiffness<dim>::sees_another_material(int element, const bonds::BondFamilies<dim>& bonds) const {
  if (of_element_.empty()) return false;
  const auto& pairs = bonds.pairs_of(element);
  return std::any_of(pairs.begin(), pairs.end(),
                     [&](int p) { return material_of(bonds.pair(p).first) != material_of(bonds.pair(p).second); });
}

template <int dim>
bool MorphedStiffness<dim>::has_dilatation() const {
  return std::any_of(materials_.begin(), materials_.end(), [](const auto& m) { return m.dilatation_factor != 0.; });
}

/// Keeps alpha; returns per element whether it has changed at one of its points.
template <int dim>
std::vector<char> MorphedStiffness<dim>::take_over(const elements::MaterialPoints<dim>& points,
                                                   const morphing::MorphingField<dim>& alpha) {
  std::vector<char> changed(first_.size(), 0);
  for (std::size_t e = 0; e < changed.size(); ++e) {
    for (int p = points.first(static_cast<int>(e)); p < points.first(static_cast<int>(e) + 1); ++p) {
      changed[e] |= static_cast<char>(alpha_[p] != alpha(p));
      alpha_[p] = alpha(p);
    }
  }
  return changed;
}

template <int dim>
void MorphedStiffness<dim>::compute(int element, const elements::MaterialPoints<dim>& points,
                                    const bonds::BondFamilies<dim>& bonds, bool is_clipped) {
  const int n_points = points.count(element);
  if (first_[element] < 0) {
    first_[element] = static_cast<int>(reduced_.size());
    reduced_.resize(reduced_.size() + n_points);
  }
  base::Stiffness<dim>* reduced = reduced_.data() + first_[element];
  std::fill_n(reduced, n_points, base::Stiffness<dim>::Zero());
  if (is_zero_[element]) return;
  struct Volume {
    base::Voigt<dim> t = base::Voigt<dim>::Zero();
    double weighted = 0.;
  };
  const double factor = dilatation_factor(element);
  std::vector<Volume> volumes(n_points);
  for (const int p : bonds.pairs_of(element)) {
    bonds.for_each_bond(p, [&](const bonds::Bond<dim>& bond) {
      const auto v = elements::squared<dim>(bond.xi);
      const double stiffness = bonds.stiffness(bond), squared = bond.xi.squaredNorm();
      const base::Voigt<dim> scaled = (0.25 * (alpha_[bond.first_point] + alpha_[bond.second_point]) * stiffness) * v;
      const auto add_at = [&](int q) {
        reduced[q].noalias() += scaled * v.transpose();
        if (factor == 0.) return;
        volumes[q].t += 2. * squared * scaled;
        volumes[q].weighted += stiffness * squared * squared;
      };
      if (bond.first_element == element) add_at(bond.first_end);
      if (bond.second_element == element) add_at(bond.second_end);
    });
  }
  for (int q = 0; q < n_points; ++q) {
    const auto& [t, weighted] = volumes[q];
    if (weighted > 0.) reduced[q] += factor / weighted * t * t.transpose();
    reduced[q] = e0(element) - reduced[q] / points.weight(points.first(element) + q);
    if (is_clipped) reduced[q] = positive_part<dim>(reduced[q]);
  }
}

template class MorphedStiffness<2>;
template class MorphedStiffness<3>;

}  // namespace perimorph::operators
