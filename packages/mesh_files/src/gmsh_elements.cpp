#include "gmsh_elements.hpp"

namespace perimorph::mesh_files {

namespace {

/// By gmsh's numbers of kinds of elements (its manual, "Node ordering" and "MSH file format").
const std::map<int, GmshKind> kinds = {
    {15, {Shape::point, 1}},        {1, {Shape::line, 2}},        {8, {Shape::line, 3}},
    {2, {Shape::triangle, 3}},      {9, {Shape::triangle, 6}},    {3, {Shape::quadrangle, 4}},
    {10, {Shape::quadrangle, 9}},   {16, {Shape::quadrangle, 8}}, {4, {Shape::tetrahedron, 4}},
    {11, {Shape::tetrahedron, 10}}, {5, {Shape::hexahedron, 8}},  {12, {Shape::hexahedron, 27}},
    {17, {Shape::hexahedron, 20}},  {6, {Shape::wedge, 6}},       {13, {Shape::wedge, 18}},
    {18, {Shape::wedge, 15}},       {7, {Shape::pyramid, 5}},     {14, {Shape::pyramid, 14}},
    {19, {Shape::pyramid, 13}}};

}  // namespace

const GmshKind* find_kind(int number) {
  const auto kind = kinds.find(number);
  return kind == kinds.end() ? nullptr : &kind->second;
}

}  // namespace perimorph::mesh_files
