#include "body_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "perimorph/base/text.hpp"

namespace perimorph::cases {

template <int dim>
BodyParts<dim>::BodyParts(const mesh::Mesh<dim>& mesh, std::vector<int> part_of) : part_of_(std::move(part_of)) {
  parts_.resize(1 + static_cast<std::size_t>(*std::max_element(part_of_.begin(), part_of_.end())));
  for (int e = 0; e < mesh.n_elements(); ++e) {
    auto& part = parts_[part_of_[e]];
    ++part.n_elements;
    for (int c = 0; c < mesh.n_corners(e); ++c) part.box.extend(mesh.coordinates[mesh.corners_of(e)[c]]);
  }
}

template <int dim>
std::string BodyParts<dim>::name(int part) const {
  if (count() == 1) return "the body";
  const auto& one = parts_[part];
  return fmt::format("part {} of {} of the body ({}, from {} to {})", part + 1, count(),
                     base::counted(one.n_elements, "element"), shown<dim>(one.box.min()), shown<dim>(one.box.max()));
}

template <int dim>
std::string shown(const base::Point<dim>& point) {
  return fmt::format("({:.6g})", fmt::join(point.begin(), point.end(), ", "));
}

template class BodyParts<2>;
template class BodyParts<3>;
template std::string shown<2>(const base::Point<2>&);
template std::string shown<3>(const base::Point<3>&);

}  // namespace perimorph::cases
