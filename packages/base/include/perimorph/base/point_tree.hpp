#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "perimorph/base/algebra.hpp"

namespace perimorph::base {

/// A k-d tree (nanoflann) over points that it owns; finds all within a radius.
template <int dim>
class PointTree {
 public:
  explicit PointTree(std::vector<Point<dim>> points) : points_{std::move(points)}, tree_(dim, points_) {
    tree_.buildIndex();
  }
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  /// Indices of the points at most `radius` from `center`, ascending. Local.
  std::vector<int> within(const Point<dim>& center, double radius) const {
    // nanoflann compares squared distances with "<": widen by rounding so that points on the sphere are found.
    const double squared = radius * radius * (1. + 1e-12) + std::numeric_limits<double>::min();
    std::vector<std::pair<std::uint32_t, double>> found;
    if (!points_.list.empty()) tree_.radiusSearch(center.data(), squared, found, nanoflann::SearchParams());
    std::vector<int> indices;
    indices.reserve(found.size());
    for (const auto& hit : found) indices.push_back(static_cast<int>(hit.first));
    std::sort(indices.begin(), indices.end());
    return indices;
  }

 private:
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
