#pragma once

// What an input file of Abaqus says: parts with their sets, placed as instances. Names are compared in lower case.

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesh_file.hpp"

namespace perimorph::mesh_files {

/// Numbers first, first + step, ... up to last.
struct AbaqusRun {
  std::int64_t first, last, step;
  bool operator<(const AbaqusRun& other) const;
  bool operator==(const AbaqusRun& other) const;
};

/// A set of nodes or elements: some of these numbers may stand for none.
struct AbaqusSet {
  std::string name;
  std::vector<AbaqusRun> runs;
  std::vector<AbaqusRun> nodes_of;  ///< of a node set: elements whose nodes are in it

  void add(std::int64_t number);
  void add(const AbaqusSet& other);
  void shift(std::int64_t offset);
};

using AbaqusSets = std::map<std::string, AbaqusSet>;

/// A surface: sides of elements, or nodes.
struct AbaqusSurface {
  struct Item {
    AbaqusSet elements;
    int side;  ///< 0: those that no other element has
  };
  std::string name;
  std::vector<Item> items;
  AbaqusSet nodes;

  void shift(std::int64_t offset);
};

struct AbaqusElement {
  std::int64_t number;
  Shape shape;
  std::string set;                  ///< that its *ELEMENT names, or ""
  std::vector<std::int64_t> nodes;  ///< corners first
};

/// A part, an instance, or all that is in neither.
struct AbaqusPart {
  std::string name;
  std::vector<std::int64_t> node_numbers;
  std::vector<std::array<double, 3>> coordinates;
  std::vector<AbaqusElement> elements;
  AbaqusSets node_sets, element_sets;
  std::vector<AbaqusSurface> surfaces;
  std::vector<std::string> sections;  ///< names of the element sets that have one

  void shift(std::int64_t offset);
  void move(const Eigen::Isometry3d& placement);
};

/// The mesh of all instances and of what is in none.
/// @param instances with numbers that no other has
/// @param rest with sets and surfaces of the assembly
/// @throws UserError for a set that is not defined
MeshFile abaqus_mesh(const std::string& file, const std::vector<AbaqusPart>& instances, const AbaqusPart& rest);

}  // namespace perimorph::mesh_files
