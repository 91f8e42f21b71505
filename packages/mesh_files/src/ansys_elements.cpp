// The kinds of ANSYS' elements, as in its Element Reference: structural, thermal and coupled ones have the same shapes.

#include "ansys_elements.hpp"

#include <map>
#include <set>
#include <vector>

namespace perimorph::mesh_files {

namespace {

constexpr int mesh_only = 200;  // MESH200: its first key option says what it is

constexpr AnsysNodes triangle_3{3, 3, true}, triangle_6{6, 3, true}, quadrangle_4{4, 4, true}, quadrangle_8{8, 4, true};
constexpr AnsysNodes tetrahedron_4{4, 4, false}, tetrahedron_10{10, 4, false}, brick_8{8, 8, false},
    brick_20{20, 8, false};

std::map<int, AnsysNodes> nodes_by_kind() {
  const std::vector<std::pair<AnsysNodes, std::vector<int>>> kinds = {
      {triangle_6, {2, 35, 146}},
      {quadrangle_4, {13, 42, 55, 182, 212, 292, 28, 41, 43, 63, 131, 143, 157, 181}},  // from 28 on shells
      {quadrangle_8, {53, 77, 82, 121, 183, 213, 223, 230, 233, 238, 293, 91, 93, 99, 132, 150, 281}},  // from 91
      {tetrahedron_4, {72, 285}},
      {tetrahedron_10, {87, 92, 98, 123, 187, 217, 227, 232, 237, 240, 291}},
      {brick_8, {5, 45, 46, 62, 64, 65, 69, 70, 73, 96, 97, 185, 190, 215, 278}},
      {brick_20, {90, 95, 117, 122, 186, 191, 216, 226, 231, 236, 239, 279}}};
  std::map<int, AnsysNodes> result;
  for (const auto& [nodes, numbers] : kinds) {
    for (const int kind : numbers) result.emplace(kind, nodes);
  }
  return result;
}

std::optional<AnsysNodes> found_in(const std::map<int, AnsysNodes>& all, int key) {
  const auto found = all.find(key);
  return found == all.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

std::optional<AnsysNodes> nodes_of_ansys_type(const AnsysType& type) {
  static const std::map<int, AnsysNodes> by_kind = nodes_by_kind();
  static const std::map<int, AnsysNodes> by_option = {{4, triangle_3},   {5, triangle_6},    {6, quadrangle_4},
                                                      {7, quadrangle_8}, {8, tetrahedron_4}, {9, tetrahedron_10},
                                                      {10, brick_8},     {11, brick_20}};
  return type.kind == mesh_only ? found_in(by_option, type.first_option) : found_in(by_kind, type.kind);
}

bool is_axisymmetric(const AnsysType& type) {
  static const std::set<int> plane_kinds = {2,   13,  35,  42,  53,  55,  77,  82,  121, 146,
                                            182, 183, 212, 213, 223, 230, 233, 238, 292, 293};
  constexpr int without_torsion = 1, with_torsion = 6;
  return plane_kinds.count(type.kind) > 0 &&
         (type.third_option == without_torsion || type.third_option == with_torsion);
}

bool is_without_body(const AnsysType& type) {
  static const std::set<int> kinds = {3,   4,   8,   10,  14,  21,  39,  40,  116, 151, 152, 153,
                                      154, 156, 169, 170, 171, 172, 173, 174, 175, 176, 177, 178,
                                      179, 180, 184, 188, 189, 201, 214, 250, 251, 288, 289, 290};
  return kinds.count(type.kind) > 0 || (type.kind == mesh_only && type.first_option < 4);
}

}  // namespace perimorph::mesh_files
