#pragma once

#include <Teuchos_ArrayView.hpp>
#include <vector>

#include "perimorph/base/algebra.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::base {

/// Numbers that somebody else owns, with how many there are, such as a displacement on all local degrees of freedom.
using Field = Teuchos::ArrayView<double>;
using ConstField = Teuchos::ArrayView<const double>;

/// A view of all of them. The vector must outlive it, and must not grow.
inline Field field(std::vector<double>& values) { return {values.data(), static_cast<int>(values.size())}; }
inline ConstField field(const std::vector<double>& values) { return {values.data(), static_cast<int>(values.size())}; }

/// The vector that a field on nodes, (n_nodes, dim), has at one of them; (dim), in the field's unit.
template <int dim>
Eigen::Map<const Point<dim>> at_node(const ConstField& values, int node) {
  PERIMORPH_DEBUG_ASSERT(node >= 0 && (node + 1) * dim <= values.size(), "node {} of {} values", node, values.size());
  return Eigen::Map<const Point<dim>>(values.getRawPtr() + static_cast<std::ptrdiff_t>(node) * dim);
}

}  // namespace perimorph::base
