#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::cases {

/// Parts of a body, for messages.
template <int dim>
class BodyParts {
 public:
  struct Part {
    int n_elements = 0;
    Eigen::AlignedBox<double, dim> box;
  };

  /// Local. @param part_of (n_elements), from 0; mesh::parts_of_elements()
  BodyParts(const mesh::Mesh<dim>& mesh, std::vector<int> part_of);

  int count() const { return static_cast<int>(parts_.size()); }
  int of_element(int element) const { return part_of_[element]; }
  const Part& operator[](int part) const { return parts_[part]; }

  /// "the body", or "part 2 of 3 of the body (16 elements, from (0, 0) to (1, 1))".
  std::string name(int part) const;

 private:
  std::vector<int> part_of_;
  std::vector<Part> parts_;
};

/// "(1, 2)".
template <int dim>
std::string shown(const base::Point<dim>& point);

}  // namespace perimorph::cases
