#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh_file.hpp"

namespace perimorph::mesh_files {

/// A type of elements: how many nodes it has, the corners first.
struct AbaqusType {
  Shape shape;
  int n_nodes;
};

/// Continuum elements in three dimensions, of plane stress and plane strain, shells and membranes (plane elements, or
/// sides of others), trusses (sides of plane elements). None for others.
std::optional<AbaqusType> abaqus_type(const std::string& name);

/// Masses, springs, beams, connectors, rigid surfaces: of no body, and no part of one.
bool is_without_body(const std::string& abaqus_type);

/// Corners of the side that Abaqus calls S1, S2, ... {} if the shape has none of that number.
std::vector<int> abaqus_side(Shape shape, int number);

int n_abaqus_sides(Shape shape);

}  // namespace perimorph::mesh_files
