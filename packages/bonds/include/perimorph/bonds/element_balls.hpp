#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "perimorph/base/point_tree.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::bonds {

/// The smallest balls around the elements of a mesh at their centroids, to find those near to each other. All local.
template <int dim>
class ElementBalls {
 public:
  explicit ElementBalls(const mesh::Mesh<dim>& mesh) {
    for (int e = 0; e < mesh.n_elements(); ++e) {
      centers_.push_back(mesh::centroid(mesh, e));
      radii_.push_back(mesh::radius(mesh, e));
      largest_radius_ = std::max(largest_radius_, radii_.back());
    }
    tree_ = std::make_unique<base::PointTree<dim>>(centers_);
  }

  const base::Point<dim>& center(int element) const { return centers_[element]; }

  /// How far bonds of an element get from its centroid, [length]. @param horizon [length]
  double reach(int element, double horizon) const { return (1. + 1e-6) * (horizon + radii_[element]); }

  /// The elements that bonds of this one may end in, and perhaps some more; ascending, with itself.
  std::vector<int> in_reach(int element, double horizon) const {
    const double distance = reach(element, horizon);
    auto found = tree_->within(centers_[element], distance + largest_radius_);
    const auto is_too_far = [&](int other) {
      return (centers_[element] - centers_[other]).norm() > distance + radii_[other];
    };
    found.erase(std::remove_if(found.begin(), found.end(), is_too_far), found.end());
    return found;
  }

 private:
  std::vector<base::Point<dim>> centers_;
  std::vector<double> radii_;
  double largest_radius_ = 0.;
  std::unique_ptr<base::PointTree<dim>> tree_;
};

}  // namespace perimorph::bonds
