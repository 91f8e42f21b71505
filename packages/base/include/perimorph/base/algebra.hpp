#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace perimorph::base {

/// Index over all ranks (the GlobalOrdinal of Tpetra).
using GlobalId = long long;

/// A position or a displacement, (dim), [length].
template <int dim>
using Point = Eigen::Matrix<double, dim, 1>;

/// Number of independent components of a symmetric tensor: 3 in two dimensions, 6 in three.
template <int dim>
inline constexpr int n_voigt = dim*(dim + 1) / 2;

/// Strain with engineering shear (xx, yy, xy) or (xx, yy, zz, yz, xz, xy); stress in the same order.
template <int dim>
using Voigt = Eigen::Matrix<double, n_voigt<dim>, 1>;

/// Elasticity tensor in Voigt notation, (n_voigt, n_voigt), [stress].
template <int dim>
using Stiffness = Eigen::Matrix<double, n_voigt<dim>, n_voigt<dim>>;

/// Displacements of nodes as sums of those of other nodes: by node, which ones and their weights.
using NodeWeights = std::vector<std::vector<std::pair<int, double>>>;

}  // namespace perimorph::base
