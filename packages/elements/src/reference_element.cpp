#include "perimorph/elements/reference_element.hpp"

#include <Intrepid2_CellTools.hpp>
#include <Intrepid2_DefaultCubatureFactory.hpp>
#include <Intrepid2_HGRAD_HEX_C1_FEM.hpp>
#include <Intrepid2_HGRAD_PYR_C1_FEM.hpp>
#include <Intrepid2_HGRAD_QUAD_C1_FEM.hpp>
#include <Intrepid2_HGRAD_TET_C1_FEM.hpp>
#include <Intrepid2_HGRAD_TRI_C1_FEM.hpp>
#include <Intrepid2_HGRAD_WEDGE_C1_FEM.hpp>
#include <map>
#include <memory>

#include "perimorph/base/errors.hpp"

namespace perimorph::elements {

namespace {

using Device = Kokkos::Serial;
using View = Kokkos::DynRankView<double, Device>;
using Basis = Intrepid2::Basis<Device, double, double>;
using mesh::ElementType;

std::unique_ptr<Basis> linear_basis(ElementType type) {
  switch (type) {
    case ElementType::tri3:
      return std::make_unique<Intrepid2::Basis_HGRAD_TRI_C1_FEM<Device>>();
    case ElementType::quad4:
      return std::make_unique<Intrepid2::Basis_HGRAD_QUAD_C1_FEM<Device>>();
    case ElementType::tet4:
      return std::make_unique<Intrepid2::Basis_HGRAD_TET_C1_FEM<Device>>();
    case ElementType::pyramid5:
      return std::make_unique<Intrepid2::Basis_HGRAD_PYR_C1_FEM<Device>>();
    case ElementType::wedge6:
      return std::make_unique<Intrepid2::Basis_HGRAD_WEDGE_C1_FEM<Device>>();
    case ElementType::hex8:
      return std::make_unique<Intrepid2::Basis_HGRAD_HEX_C1_FEM<Device>>();
  }
  throw base::Bug("unknown element type");
}

/// Degree of polynomials that the rule integrates exactly; n Gauss points along an axis give 2n - 1.
int cubature_degree(ElementType type, int points_per_direction) {
  const bool has_simplex = type == ElementType::tri3 || type == ElementType::tet4 || type == ElementType::wedge6;
  static constexpr int simplex_degrees[] = {1, 2, 4};
  return has_simplex ? simplex_degrees[points_per_direction - 1] : 2 * points_per_direction - 1;
}

template <int dim>
ReferenceElement<dim> tabulate(ElementType type, int points_per_direction) {
  const auto basis = linear_basis(type);
  const auto rule = Intrepid2::DefaultCubatureFactory::create<Device, double, double>(
      basis->getBaseCellTopology(), cubature_degree(type, points_per_direction));
  const int n_points = rule->getNumPoints(), n_corners = basis->getCardinality();
  PERIMORPH_ASSERT(n_points <= max_points, "{} points", n_points);

  View points("points", n_points, dim), weights("weights", n_points);
  rule->getCubature(points, weights);
  View values("values", n_corners, n_points), gradients("gradients", n_corners, n_points, dim);
  basis->getValues(values, points, Intrepid2::OPERATOR_VALUE);
  basis->getValues(gradients, points, Intrepid2::OPERATOR_GRAD);

  ReferenceElement<dim> table{n_corners, n_points, {}, {}, {}};
  for (int q = 0; q < n_points; ++q) {
    CornerValues shape(n_corners);
    ShapeGradients<dim> gradient(dim, n_corners);
    for (int k = 0; k < n_corners; ++k) {
      shape(k) = values(k, q);
      for (int d = 0; d < dim; ++d) gradient(d, k) = gradients(k, q, d);
    }
    table.weights.push_back(weights(q));
    table.shape.push_back(shape);
    table.gradients.push_back(gradient);
  }
  return table;
}

}  // namespace

template <int dim>
const ReferenceElement<dim>& reference_element(ElementType type, int points_per_direction) {
  PERIMORPH_ASSERT(mesh::dimension(type) == dim, "{} in {} dimensions", mesh::exodus_name(type), dim);
  PERIMORPH_ASSERT(points_per_direction >= 1 && points_per_direction <= 3, "{} points", points_per_direction);
  static std::map<std::pair<ElementType, int>, ReferenceElement<dim>> tables;
  const auto [entry, is_new] = tables.try_emplace({type, points_per_direction});
  if (is_new) entry->second = tabulate<dim>(type, points_per_direction);
  return entry->second;
}

template <int dim>
std::optional<CornerValues> shape_at(ElementType type, const std::vector<base::Point<dim>>& corners,
                                     const base::Point<dim>& x) {
  PERIMORPH_ASSERT(static_cast<int>(corners.size()) == mesh::n_corners(type), "{} corners of a {}", corners.size(),
                   mesh::exodus_name(type));
  PERIMORPH_ASSERT(x.allFinite(), "a point in {} dimensions is nowhere", dim);
  constexpr double tolerance = 1e-6;
  using Tools = Intrepid2::CellTools<Device>;
  const auto basis = linear_basis(type);
  const auto n_corners = static_cast<int>(corners.size());
  View cell("cell", 1, n_corners, dim), place("place", 1, 1, dim), reference("reference", 1, 1, dim);
  for (int d = 0; d < dim; ++d) {
    place(0, 0, d) = x[d];
    for (int k = 0; k < n_corners; ++k) cell(0, k, d) = corners[k][d];
  }
  Tools::mapToReferenceFrame(reference, place, cell, basis->getBaseCellTopology());
  View point("point", dim), points("points", 1, dim), values("values", n_corners, 1);
  for (int d = 0; d < dim; ++d) point(d) = points(0, d) = reference(0, 0, d);
  if (!Tools::checkPointInclusion(point, basis->getBaseCellTopology(), tolerance)) return std::nullopt;
  basis->getValues(values, points, Intrepid2::OPERATOR_VALUE);
  CornerValues shape(n_corners);
  for (int k = 0; k < n_corners; ++k) shape(k) = values(k, 0);
  return shape;
}

template const ReferenceElement<2>& reference_element<2>(ElementType, int);
template const ReferenceElement<3>& reference_element<3>(ElementType, int);
template std::optional<CornerValues> shape_at<2>(ElementType, const std::vector<base::Point<2>>&,
                                                 const base::Point<2>&);
template std::optional<CornerValues> shape_at<3>(ElementType, const std::vector<base::Point<3>>&,
                                                 const base::Point<3>&);

}  // namespace perimorph::elements
