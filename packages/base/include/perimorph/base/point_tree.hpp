#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "perimorph/base/algebra.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::base {

/// A k-d tree (nanoflann) over points that it owns; finds those within a radius.
template <int dim>
class PointTree {
 public:
  /// @param points (n), any number, [length]
  explicit PointTree(std::vector<Point<dim>> points) : points_{std::move(points)}, tree_(dim, points_) {
    tree_.buildIndex();
  }
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  /// Indices of the points at most `radius` from `center`, ascending. Local.
  /// @param center (dim), [length]; @param radius [length]
  std::vector<int> within(const Point<dim>& center, double radius) const {
    PERIMORPH_ASSERT(radius >= 0., "a radius of {}", radius);
    const double squared = squared_reach(radius);
    std::vector<std::pair<std::uint32_t, double>> found;
    if (!points_.list.empty()) tree_.radiusSearch(center.data(), squared, found, nanoflann::SearchParams());
    std::vector<int> indices;
    indices.reserve(found.size());
    for (const auto& hit : found) indices.push_back(static_cast<int>(hit.first));
    std::sort(indices.begin(), indices.end());
    return indices;
  }

  /// Whether holds(index) is true for a point at most `radius` from `center`; the first one ends the search. Points
  /// a little farther may be asked for, too. Local.
  /// @param center (dim), [length]; @param radius [length]
  template <class Predicate>
  bool any_within(const Point<dim>& center, double radius, Predicate holds) const {
    PERIMORPH_ASSERT(radius >= 0., "a radius of {}", radius);
    FirstThatHolds<Predicate> result{holds, squared_reach(radius)};
    if (!points_.list.empty()) tree_.findNeighbors(result, center.data(), nanoflann::SearchParams());
    return result.is_found;
  }

  /// Of a point from the nearest, [length]; infinite if there are none. Local.
  /// @param x (dim), [length]
  double distance(const Point<dim>& x) const {
    if (points_.list.empty()) return std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    double squared = 0.;
    nanoflann::KNNResultSet<double> result(1);
    result.init(&nearest, &squared);
    tree_.findNeighbors(result, x.data(), nanoflann::SearchParams());
    return std::sqrt(squared);
  }

 private:
  /// nanoflann compares squared distances with "<": widened by rounding, so that points on the sphere are found.
  static double squared_reach(double radius) {
    return radius * radius * (1. + 1e-12) + std::numeric_limits<double>::min();
  }

  /// What nanoflann asks of a set of results. addPoint() returns whether the search goes on.
  template <class Predicate>
  struct FirstThatHolds {
    Predicate& holds;
    double squared_radius;
    bool is_found = false;

    bool full() const { return true; }
    double worstDist() const { return squared_radius; }
    bool addPoint(double, std::size_t i) {
      is_found = holds(static_cast<int>(i));
      return !is_found;
    }
  };

  struct Cloud {
    std::vector<Point<dim>> list;
    std::size_t kdtree_get_point_count() const { return list.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t d) const { return list[i][static_cast<int>(d)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, dim>;

  Cloud points_;
  Tree tree_;
};

}  // namespace perimorph::base
