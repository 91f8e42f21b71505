#pragma once

#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/elements/material_points.hpp"

namespace perimorph::morphing {

/// How alpha falls over the rim of a zone: 1 - t, or 1 - 3t^2 + 2t^3.
enum class BlendingFunction { linear, cubic };

/// A zone where alpha = 1: all points up to inner_radius from its core, a box or a line; alpha falls to 0 over the next
/// rim (r2 - r1). A ball, such as the seed circle r1 or the growth circle r_i of WHL19, is a box of one point.
/// [length].
template <int dim>
struct Zone {
  enum class Core { box, line };
  base::Point<dim> lower, upper;  ///< of a line: its ends
  double inner_radius, rim;
  Core core = Core::box;

  /// @param center (dim), [length]
  /// @param inner_radius up to which alpha = 1, >= 0, [length]
  /// @param outer_radius from which on alpha = 0, >= inner_radius, [length]
  static Zone ball(const base::Point<dim>& center, double inner_radius, double outer_radius);
  /// @param lower the corner with the smallest coordinates, (dim), [length]
  /// @param upper the opposite one, (dim), [length]
  /// @param rim >= 0, [length]
  static Zone box(const base::Point<dim>& lower, const base::Point<dim>& upper, double rim);
  /// Around a line; the ends are round.
  /// @param start,end of the line, not the same, (dim), [length]
  /// @param inner_radius,outer_radius as for ball(), from the line, [length]
  static Zone cylinder(const base::Point<dim>& start, const base::Point<dim>& end, double inner_radius,
                       double outer_radius);
  /// Alpha = 1 everywhere.
  static Zone everything();

  /// Alpha at a point, 0 ... 1 [-] [WHL19, section 3.1].
  /// @param x (dim), [length]
  double alpha(const base::Point<dim>& x, BlendingFunction function) const;

  /// How far a point is from where alpha > 0; 0 there, [length].
  /// @param x (dim), [length]
  double distance(const base::Point<dim>& x) const;

 private:
  double distance_to_core(const base::Point<dim>& x) const;
};

/// FE: alpha = 0 in the whole neighbourhood; PD: alpha = 1 there; MORPH: all else [WHL19, eq. 18].
enum class ElementClass : signed char { fe = 0, morph = 1, pd = 2 };

/// The morphing function alpha at the material points: the maximum over all zones [WHL19, eq. 23]. It never falls.
template <int dim>
class MorphingField {
 public:
  /// Alpha is 0 everywhere until zones are added. Local; mesh and points must outlive this.
  /// @param points of that mesh
  MorphingField(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points, BlendingFunction function);

  /// Adds zones; returns the local elements where alpha rose, ascending. Local.
  /// @param zones the same on all ranks
  std::vector<int> add(const std::vector<Zone<dim>>& zones);

  /// Alpha at a local material point, 0 ... 1 [-].
  double operator()(int point) const {
    PERIMORPH_DEBUG_ASSERT(point >= 0 && point < points_.size(), "point {} of {}", point, points_.size());
    return alpha_[point];
  }

  /// Whether alpha > 0 at any point of the element: then it carries bonds.
  bool carries_bonds(int element) const {
    PERIMORPH_DEBUG_ASSERT(mesh_.has_element(element), "element {} of {}", element, mesh_.n_elements());
    return carries_bonds_[element];
  }

 private:
  const mesh::Mesh<dim>& mesh_;
  const elements::MaterialPoints<dim>& points_;
  BlendingFunction function_;
  std::vector<double> alpha_;
  std::vector<char> carries_bonds_;
};

}  // namespace perimorph::morphing
