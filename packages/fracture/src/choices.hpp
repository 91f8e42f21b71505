#pragma once

// The words of the case file for the enumerations of Case: each stands here once.

#include <array>
#include <string>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/fracture/case.hpp"

namespace perimorph::fracture {

template <class E>
struct Choice {
  const char* word;
  E value;
  int dimension = 0;  ///< in which alone it is allowed; 0: in both
};

inline constexpr std::array<Choice<ElasticModel>, 3> elastic_models{
    {{"Plane Stress", ElasticModel::plane_stress, 2},
     {"Plane Strain", ElasticModel::plane_strain, 2},
     {"Three-Dimensional", ElasticModel::three_dimensional, 3}}};
inline constexpr std::array<Choice<SeedShape>, 6> seed_shapes{{{"Circle", SeedShape::ball, 2},
                                                               {"Sphere", SeedShape::ball, 3},
                                                               {"Cylinder", SeedShape::cylinder, 3},
                                                               {"Box", SeedShape::box},
                                                               {"Everything", SeedShape::everything},
                                                               {"Automatic", SeedShape::automatic}}};
inline constexpr std::array<Choice<PreCrackShape>, 3> pre_crack_shapes{{{"Polyline", PreCrackShape::polyline, 2},
                                                                        {"Polygon", PreCrackShape::polygon, 3},
                                                                        {"Disc", PreCrackShape::disc, 3}}};
inline constexpr std::array<Choice<BlendingFunction>, 2> blending_functions{
    {{"Linear", BlendingFunction::linear}, {"Cubic", BlendingFunction::cubic}}};
inline constexpr std::array<Choice<DiscontinuousElements>, 2> discontinuous_elements{
    {{"On Damage", DiscontinuousElements::on_damage}, {"Whole Zone", DiscontinuousElements::whole_zone}}};
inline constexpr std::array<Choice<PeridynamicStiffness>, 2> peridynamic_stiffnesses{
    {{"Dropped", PeridynamicStiffness::dropped}, {"Kept", PeridynamicStiffness::kept}}};
inline constexpr std::array<Choice<Calibration>, 2> calibrations{
    {{"Analytic", Calibration::analytic}, {"Mesh-Consistent", Calibration::mesh_consistent}}};
inline constexpr std::array<Choice<PreconditionerMatrix>, 2> preconditioner_matrices{
    {{"Coupled", PreconditionerMatrix::coupled}, {"Short-Range", PreconditionerMatrix::short_range}}};
inline constexpr std::array<Choice<OperatorForm>, 3> operator_forms{
    {{"CRS", OperatorForm::crs}, {"Matrix-Free", OperatorForm::matrix_free}, {"On-the-Fly", OperatorForm::on_the_fly}}};
inline constexpr std::array<Choice<int>, 3> components{{{"x", 0}, {"y", 1}, {"z", 2, 3}}};

/// All words, or those allowed in one dimension.
template <class E, std::size_t n>
std::vector<std::string> words(const std::array<Choice<E>, n>& choices, int dimension = 0) {
  std::vector<std::string> all;
  for (const auto& choice : choices) {
    if (dimension == 0 || choice.dimension == 0 || choice.dimension == dimension) all.emplace_back(choice.word);
  }
  return all;
}

/// @throws Bug if the word is none of the choices: the schema lets no other through.
template <class E, std::size_t n>
E value_of(const std::array<Choice<E>, n>& choices, const std::string& word) {
  for (const auto& choice : choices) {
    if (word == choice.word) return choice.value;
  }
  throw base::Bug("no such choice: " + word);
}

}  // namespace perimorph::fracture
