#include "perimorph/cases/pre_cracks.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "perimorph/base/algebra.hpp"
#include "shapes.hpp"

namespace perimorph::cases {

namespace {

using Numbers = Teuchos::Array<double>;

constexpr std::array<Choice<PreCrackShape>, 3> pre_crack_shapes{{{"Polyline", PreCrackShape::polyline, 2},
                                                                 {"Polygon", PreCrackShape::polygon, 3},
                                                                 {"Disc", PreCrackShape::disc, 3}}};
constexpr std::array<ShapeParameter<PreCrackShape>, 5> pre_crack_parameters{{{PreCrackShape::polyline, "Points"},
                                                                             {PreCrackShape::polygon, "Points"},
                                                                             {PreCrackShape::disc, "Center"},
                                                                             {PreCrackShape::disc, "Normal"},
                                                                             {PreCrackShape::disc, "Radius"}}};

/// All corners of a polygon lie in one plane and turn the same way. @param corners no two in a row are the same
bool is_flat_and_convex(const std::vector<base::Point<3>>& corners) {
  constexpr double tolerance = 1e-6;  // of the polygon's size
  const auto n = corners.size();
  base::Point<3> normal = base::Point<3>::Zero();
  double size = 0.;
  for (std::size_t i = 0; i < n; ++i) {
    normal += (corners[i] - corners[0]).cross(corners[(i + 1) % n] - corners[0]);
    size = std::max(size, (corners[i] - corners[0]).norm());
  }
  if (normal.norm() <= tolerance * size * size) return false;
  normal.normalize();
  double turned = 0.;
  for (std::size_t i = 0; i < n; ++i) {
    const base::Point<3> to = corners[(i + 1) % n] - corners[i], from = corners[(i + 2) % n] - corners[(i + 1) % n];
    const double turn = normal.dot(to.cross(from)) / (to.norm() * from.norm());
    if (turn < -tolerance || std::abs(normal.dot(to)) > tolerance * size) return false;
    turned += std::atan2(turn, to.dot(from) / (to.norm() * from.norm()));
  }
  return turned < 7.;  // once around, 2 pi: a star goes around more often
}

void check_points(const input::Values& crack, const Numbers& points, int dimension) {
  const bool is_polygon = dimension == 3;
  const int n = static_cast<int>(points.size()) / dimension;
  if (n < dimension || points.size() % dimension != 0) {
    crack.mistake("Points", fmt::format("found {} numbers; allowed are {}", points.size(),
                                        is_polygon ? "three points or more, {x1, y1, z1, x2, ...}"
                                                   : "two points or more, {x1, y1, x2, y2, ...}"));
    return;
  }
  bool is_valid = true;
  for (int i = is_polygon ? 0 : 1; i < n; ++i) {
    const auto point = points.begin() + i * dimension, before = points.begin() + (i + n - 1) % n * dimension;
    if (!std::equal(point, point + dimension, before)) continue;
    is_valid = false;
    crack.mistake("Points", fmt::format("found the point ({}) twice in a row; allowed are segments that have a length",
                                        fmt::join(point, point + dimension, ", ")));
  }
  if (!is_polygon || !is_valid) return;
  std::vector<base::Point<3>> corners;
  for (int i = 0; i < n; ++i) corners.emplace_back(Eigen::Map<const base::Point<3>>(&points[i * 3]));
  if (is_flat_and_convex(corners)) return;
  crack.mistake("Points", fmt::format("found {}; allowed are the corners of a flat convex polygon, one after the other "
                                      "around it; other shapes are several pre-cracks",
                                      crack.shown("Points")));
}

}  // namespace

void declare(const input::Section& section, PreCrack& crack) {
  using namespace input;
  section.choice("Shape", crack.shape, pre_crack_shapes,
                 "\"Polyline\" (two dimensions) and \"Polygon\" (three; flat and convex) take the points, \"Disc\" "
                 "(three) center, normal and radius.");
  section.optional("Points", crack.points, {0., 0., 10., 0.}, numbers("{x1, y1, x2, y2, ...}"),
                   "Its corners {x1, y1, x2, y2, ...} [length], in three dimensions {x1, y1, z1, x2, ...}. Element "
                   "edges, in three dimensions faces, should lie along it.");
  section.optional("Center", crack.center, {0., 0., 0.}, numbers("a point such as {1.5, 2, 0}"), "Of a disc [length].");
  section.optional("Normal", crack.normal, {0., 0., 1.}, numbers("a direction such as {0, 0, 1}"),
                   "Of a disc: the direction across it, of any length.");
  section.optional("Radius", crack.radius, 5., above(0.), "Of a disc [length].");
}

void check_pre_crack(const input::Values& crack, int dimension) {
  check_shape(crack, "a pre-crack", pre_crack_shapes, pre_crack_parameters, dimension);
  if (const Numbers* points = crack.numbers("Points")) check_points(crack, *points, dimension);
  check_size(crack, "Center", dimension);
  check_direction(crack, "Normal", dimension);
}

}  // namespace perimorph::cases
