#pragma once

#include <cstddef>
#include <optional>

namespace perimorph::mesh_files {

/// A type of ANSYS' elements as ET defines it: the number of its kind (185 of SOLID185), and two of its key options.
struct AnsysType {
  int kind, first_option, third_option;
};

/// How many nodes an element has, of which so many come first and are its corners.
struct AnsysNodes {
  std::size_t n_nodes, n_corners;
  bool is_plane;
};

/// Nothing for elements that are neither plane nor solid.
std::optional<AnsysNodes> nodes_of_ansys_type(const AnsysType& type);

/// Masses, springs, links, beams, pipes, surface effects, contact, pretension, joints.
bool is_without_body(const AnsysType& type);

/// Plane elements that stand for a body of revolution.
bool is_axisymmetric(const AnsysType& type);

}  // namespace perimorph::mesh_files
