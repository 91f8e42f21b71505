#include "exodus_types.hpp"

#include <algorithm>

#include "text_fields.hpp"

namespace perimorph::mesh_files {

namespace {

struct Spelling {
  const char* letters;
  Shape shape;
  bool is_shell;
};
constexpr Spelling spellings[] = {{"TRI", Shape::triangle, false},
                                  {"TRIANGLE", Shape::triangle, false},
                                  {"TRISHELL", Shape::triangle, true},
                                  {"SHELL", Shape::triangle, true},
                                  {"SHELL", Shape::quadrangle, true},
                                  {"QUAD", Shape::quadrangle, false},
                                  {"QUADRILATERAL", Shape::quadrangle, false},
                                  {"TETRA", Shape::tetrahedron, false},
                                  {"TET", Shape::tetrahedron, false},
                                  {"TETRAHEDRON", Shape::tetrahedron, false},
                                  {"PYRAMID", Shape::pyramid, false},
                                  {"PYRA", Shape::pyramid, false},
                                  {"WEDGE", Shape::wedge, false},
                                  {"HEX", Shape::hexahedron, false},
                                  {"HEXAHEDRON", Shape::hexahedron, false}};

constexpr const char* types_without_body[] = {"SPHERE", "CIRCLE", "POINT", "BAR",  "BEAM",  "TRUSS",
                                              "ROD",    "EDGE",   "LINE",  "MASS", "SPRING"};

/// How many nodes elements of a shape may have, of first and of second order; the corners come first.
const std::vector<std::int64_t>& numbers_of_nodes(Shape shape) {
  static const std::map<Shape, std::vector<std::int64_t>> all = {{Shape::triangle, {3, 6, 7}},
                                                                 {Shape::quadrangle, {4, 8, 9}},
                                                                 {Shape::tetrahedron, {4, 8, 10, 11, 14, 15}},
                                                                 {Shape::pyramid, {5, 13, 14, 18, 19}},
                                                                 {Shape::wedge, {6, 15, 16, 18, 20, 21}},
                                                                 {Shape::hexahedron, {8, 20, 26, 27}}};
  return all.at(shape);
}

/// "HEX" of "hex8".
std::string letters_of(const std::string& type) {
  return upper(type.substr(0, std::min(type.find_first_of("0123456789_- "), type.size())));
}

}  // namespace

std::optional<PlaneOrSolid> plane_or_solid(const std::string& type, std::int64_t n_nodes) {
  const std::string letters = letters_of(type);
  for (const auto& [name, shape, is_shell] : spellings) {
    const auto& numbers = numbers_of_nodes(shape);
    const bool has_number = std::find(numbers.begin(), numbers.end(), n_nodes) != numbers.end();
    if (letters == name && has_number) return PlaneOrSolid{shape, is_shell};
  }
  return std::nullopt;
}

bool has_body(const std::string& type) {
  return std::find(std::begin(types_without_body), std::end(types_without_body), letters_of(type)) ==
         std::end(types_without_body);
}

}  // namespace perimorph::mesh_files
