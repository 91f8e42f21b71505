// The types and sides of Abaqus' elements, as in "Element Library" of its manual.

#include "abaqus_elements.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include "text_fields.hpp"

namespace perimorph::mesh_files {

namespace {

/// What a type's name begins with; letters may follow (C3D8R, CPS4I), and for shells a number after them (S4R5).
struct Stem {
  const char* name;
  AbaqusType type;
};
constexpr Stem stems[] = {
    {"C3D4", {Shape::tetrahedron, 4}},    {"C3D5", {Shape::pyramid, 5}},       {"C3D6", {Shape::wedge, 6}},
    {"C3D8", {Shape::hexahedron, 8}},     {"C3D10", {Shape::tetrahedron, 10}}, {"C3D15", {Shape::wedge, 15}},
    {"C3D20", {Shape::hexahedron, 20}},   {"CPS3", {Shape::triangle, 3}},      {"CPS4", {Shape::quadrangle, 4}},
    {"CPS6", {Shape::triangle, 6}},       {"CPS8", {Shape::quadrangle, 8}},    {"CPE3", {Shape::triangle, 3}},
    {"CPE4", {Shape::quadrangle, 4}},     {"CPE6", {Shape::triangle, 6}},      {"CPE8", {Shape::quadrangle, 8}},
    {"DC3D4", {Shape::tetrahedron, 4}},   {"DC3D6", {Shape::wedge, 6}},        {"DC3D8", {Shape::hexahedron, 8}},
    {"DC3D10", {Shape::tetrahedron, 10}}, {"DC3D15", {Shape::wedge, 15}},      {"DC3D20", {Shape::hexahedron, 20}},
    {"DC2D3", {Shape::triangle, 3}},      {"DC2D4", {Shape::quadrangle, 4}},   {"DC2D6", {Shape::triangle, 6}},
    {"DC2D8", {Shape::quadrangle, 8}},    {"SC6", {Shape::wedge, 6}},          {"SC8", {Shape::hexahedron, 8}},
    {"S6", {Shape::triangle, 6}},         {"S3", {Shape::triangle, 3}},        {"S4", {Shape::quadrangle, 4}},
    {"S8", {Shape::quadrangle, 8}},       {"S9", {Shape::quadrangle, 9}},      {"STRI3", {Shape::triangle, 3}},
    {"STRI65", {Shape::triangle, 6}},     {"M3D3", {Shape::triangle, 3}},      {"M3D4", {Shape::quadrangle, 4}},
    {"M3D6", {Shape::triangle, 6}},       {"M3D8", {Shape::quadrangle, 8}},    {"M3D9", {Shape::quadrangle, 9}},
    {"T2D2", {Shape::line, 2}},           {"T3D2", {Shape::line, 2}}};

constexpr const char* beginnings_without_body[] = {"T2D3", "T3D3", "B21",     "B22",    "B23",     "B31",   "B32",
                                                   "B33",  "MASS", "ROTARYI", "SPRING", "DASHPOT", "CONN",  "R2D2",
                                                   "R3D",  "RB",   "PIPE",    "ELBOW",  "GAP",     "SFM3D", "DCOUP"};

const std::vector<std::vector<int>>& sides_of(Shape shape) {
  static const std::map<Shape, std::vector<std::vector<int>>> all = {
      {Shape::triangle, {{0, 1}, {1, 2}, {2, 0}}},
      {Shape::quadrangle, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
      {Shape::tetrahedron, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}},
      {Shape::pyramid, {{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}},
      {Shape::wedge, {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}},
      {Shape::hexahedron, {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}}};
  static const std::vector<std::vector<int>> none;
  const auto found = all.find(shape);
  return found == all.end() ? none : found->second;
}

}  // namespace

std::optional<AbaqusType> abaqus_type(const std::string& name) {
  const std::string type = upper(name);
  for (const Stem& stem : stems) {
    const std::string beginning = stem.name;
    if (type.rfind(beginning, 0) != 0) continue;
    const bool ends = type.size() == beginning.size();
    if (ends || std::isalpha(static_cast<unsigned char>(type[beginning.size()])) != 0) return stem.type;
  }
  return std::nullopt;
}

bool is_without_body(const std::string& abaqus_type) {
  const std::string type = upper(abaqus_type);
  if (type == "D") return true;  // of networks
  return std::any_of(std::begin(beginnings_without_body), std::end(beginnings_without_body),
                     [&](const char* beginning) { return type.rfind(beginning, 0) == 0; });
}

std::vector<int> abaqus_side(Shape shape, int number) {
  const auto& sides = sides_of(shape);
  return number < 1 || number > n_abaqus_sides(shape) ? std::vector<int>()
                                                      : sides[static_cast<std::size_t>(number - 1)];
}

int n_abaqus_sides(Shape shape) { return static_cast<int>(sides_of(shape).size()); }

}  // namespace perimorph::mesh_files
