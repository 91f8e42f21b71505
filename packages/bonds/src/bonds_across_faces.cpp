#include "perimorph/bonds/bonds_across_faces.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "perimorph/base/errors.hpp"
#include "perimorph/bonds/element_balls.hpp"
#include "perimorph/bonds/visibility.hpp"
#include "perimorph/mesh/shared_sides.hpp"

namespace perimorph::bonds {

using base::Point;

namespace {

/// The sides of the boundary: those that lie on each other, and the others.
struct BoundarySides {
  std::vector<mesh::Side> facing, outer;
};

template <int dim>
BoundarySides sides_of_boundary(const mesh::Mesh<dim>& mesh) {
  std::set<std::pair<int, int>> is_facing;
  for (const auto& [one, other] : mesh::coincident_sides(mesh, mesh.boundary)) {
    for (const auto& side : {one, other}) is_facing.insert({side.element, side.side});
  }
  BoundarySides sides;
  for (const auto& side : mesh.boundary) {
    (is_facing.count({side.element, side.side}) != 0 ? sides.facing : sides.outer).push_back(side);
  }
  return sides;
}

/// Finds the bonds of pairs of elements.
template <int dim>
class Search {
 public:
  Search(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points, double horizon,
         const BoundarySides& sides, const std::vector<mesh::CrackFacet<dim>>& pre_cracks)
      : points_(points), horizon_(horizon), faces_(mesh, sides.facing, pre_cracks), walls_(mesh, sides.outer, {}) {}

  /// Turns to the element with that centroid; returns whether there are faces in its reach.
  bool start(const Point<dim>& center, double reach) {
    faces_in_reach_ = faces_.near(center, reach);
    if (faces_in_reach_.empty()) return false;
    walls_in_reach_ = walls_.near(center, reach);
    return true;
  }

  /// Adds the bonds between it and another element; the one with the lower global id comes first.
  void add(int first, int second, std::vector<Bond<dim>>& found) const {
    std::vector<Point<dim>> ends;
    for (const int e : {first, second}) {
      for (int p = points_.first(e); p < points_.first(e + 1); ++p) ends.push_back(points_.position(p));
    }
    const auto faces = Visibility<dim>::among(faces_in_reach_, ends);
    if (faces.empty()) return;
    const auto walls = Visibility<dim>::among(walls_in_reach_, ends);
    for (int i = 0; i < points_.count(first); ++i) {
      for (int j = 0; j < points_.count(second); ++j) {
        const int p = points_.first(first) + i, q = points_.first(second) + j;
        const Point<dim> x = points_.position(p), y = points_.position(q);
        if ((y - x).norm() > horizon_ || !Visibility<dim>::blocks(faces, x, y)) continue;
        if (Visibility<dim>::blocks(walls, x, y)) continue;
        constexpr auto no_number = std::numeric_limits<BondId>::max();
        found.push_back({no_number, first, second, i, j, p, q, y - x, true});
      }
    }
  }

 private:
  const elements::MaterialPoints<dim>& points_;
  double horizon_;
  Visibility<dim> faces_, walls_;
  std::vector<mesh::CrackFacet<dim>> faces_in_reach_, walls_in_reach_;
};

}  // namespace

template <int dim>
std::vector<Bond<dim>> bonds_across_faces(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                          const std::vector<char>& active, double horizon,
                                          const std::vector<mesh::CrackFacet<dim>>& pre_cracks) {
  PERIMORPH_ASSERT(static_cast<int>(active.size()) == mesh.n_elements() && horizon > 0.,
                   "{} marks for {} elements, a horizon of {}", active.size(), mesh.n_elements(), horizon);
  std::vector<Bond<dim>> found;
  const auto sides = sides_of_boundary(mesh);
  if (sides.facing.empty() && pre_cracks.empty()) return found;
  Search<dim> search(mesh, points, horizon, sides, pre_cracks);
  const ElementBalls<dim> balls(mesh);
  for (int e = 0; e < mesh.n_elements(); ++e) {
    if (!search.start(balls.center(e), balls.reach(e, horizon))) continue;
    for (const int f : balls.in_reach(e, horizon)) {
      if (mesh.element_ids[e] < mesh.element_ids[f] && (active[e] || active[f])) search.add(e, f, found);
    }
  }
  return found;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                    \
  template std::vector<Bond<dim>> bonds_across_faces<dim>(                                            \
      const mesh::Mesh<dim>&, const elements::MaterialPoints<dim>&, const std::vector<char>&, double, \
      const std::vector<mesh::CrackFacet<dim>>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::bonds
