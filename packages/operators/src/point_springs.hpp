#pragma once

#include <vector>

#include "perimorph/operators/stiffness_matrix.hpp"

namespace perimorph::operators {

/// A spring between points of two elements, given by their places in them.
template <int dim>
struct PointSpring {
  bonds::ElementPair pair;
  int first_end, second_end;
  Eigen::Matrix<double, dim, dim> stiffness;  ///< [force / length]
};

/// Adds springs to a matrix, those of a pair of elements that follow each other at once. Adds the owned nodes whose
/// rows have changed, some repeatedly. Local.
template <int dim>
void add_springs(const CoupledModel<dim>& model, const std::vector<PointSpring<dim>>& springs,
                 StiffnessMatrix<dim>& matrix, std::vector<int>& changed);

}  // namespace perimorph::operators
