#include "perimorph/model/calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "perimorph/base/errors.hpp"

namespace perimorph::model {

using discretization::DiscontinuousElements;
using operators::PeridynamicStiffness;

namespace {

constexpr std::array<double, 4> lengths = {0.2, 0.25, 1. / 3., 0.5};  // characteristic, in element sizes
using Resistances = std::array<double, lengths.size()>;

// The same over that without dilatation, in plane stress at nu = 0.1, 0.2, 1/3, in plane strain at 0.3, 0.4, 0.45.
constexpr std::array<double, 6> dilatational_ratios = {-0.7 / 0.9, -0.5, 0., 0.5, 3., 8.};
constexpr std::array<double, 6> of_dilatation = {0.93, 0.96, 1., 1.02, 1.05, 1.09};

// The column "load" of the study "resistance" in tests/verification/fracture.csv.
constexpr Resistances on_damage_dropped = {1.289, 1.105, 1.030, 0.993};
constexpr Resistances on_damage_kept = {1.530, 1.350, 1.130, 0.986};
constexpr Resistances whole_zone_dropped = {1.145, 1.082, 1.031, 0.997};
constexpr Resistances whole_zone_kept = {1.136, 1.069, 1.015, 0.991};

const Resistances& resistances_of(DiscontinuousElements discontinuous, PeridynamicStiffness stiffness) {
  const bool is_kept = stiffness == PeridynamicStiffness::kept;
  if (discontinuous == DiscontinuousElements::whole_zone) return is_kept ? whole_zone_kept : whole_zone_dropped;
  return is_kept ? on_damage_kept : on_damage_dropped;
}

/// Linear between given points, ascending; beyond, the value of the nearest.
template <std::size_t n>
double interpolate(const std::array<double, n>& at, const std::array<double, n>& values, double x) {
  std::size_t i = 0;
  while (i + 2 < n && x > at[i + 1]) ++i;
  const double share = std::clamp((x - at[i]) / (at[i + 1] - at[i]), 0., 1.);
  return (1. - share) * values[i] + share * values[i + 1];
}

}  // namespace

double lattice_resistance(DiscontinuousElements discontinuous, PeridynamicStiffness stiffness,
                          double characteristic_length, double dilatational_ratio) {
  PERIMORPH_ASSERT(characteristic_length > 0., "a characteristic length of {} elements", characteristic_length);
  PERIMORPH_ASSERT(discontinuous != DiscontinuousElements::never, "elements that never part were not measured");
  return interpolate(lengths, resistances_of(discontinuous, stiffness), characteristic_length) *
         interpolate(dilatational_ratios, of_dilatation, dilatational_ratio);
}

template <int dim>
double element_size(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const Problem<dim>& problem) {
  mesh::Mesh<dim> in_seeds, all;
  in_seeds.coordinates = all.coordinates = mesh.coordinates;
  const auto add = [&](mesh::Mesh<dim>& part, int e) {
    part.types.push_back(mesh.types[e]);
    part.corners.insert(part.corners.end(), mesh.corners_of(e), mesh.corners_of(e) + mesh.n_corners(e));
    part.first_corner.push_back(static_cast<int>(part.corners.size()));
  };
  for (int e = 0; e < mesh.n_owned_elements; ++e) {
    const auto center = mesh::centroid(mesh, e);
    const bool is_in_a_seed = std::any_of(problem.seeds.begin(), problem.seeds.end(), [&](const auto& seed) {
      return seed.alpha(center, morphing::BlendingFunction::linear) == 1.;
    });
    add(all, e);
    if (is_in_a_seed) add(in_seeds, e);
  }
  std::vector<double> sums;
  for (const auto* part : {&in_seeds, &all}) {
    sums.push_back(part->n_elements());
    sums.push_back(part->n_elements() * mesh::mean_edge(*part));
  }
  base::sum(comm, sums);
  // In single precision, so that the order of the sums on other numbers of ranks changes no bit of the critical
  // stretch.
  return static_cast<float>(sums[0] > 0. ? sums[1] / sums[0] : sums[3] / sums[2]);
}

namespace {

/// Softening spreads over many elements, which hold nothing up.
void make_up_for(double resistance, materials::Toughness& toughness) {
  if (toughness.law.softens()) return;
  if (toughness.is_stretch_given) {
    toughness.fracture_energy *= resistance * resistance;
  } else {
    toughness.law = toughness.law.scaled(1. / resistance);
  }
}

}  // namespace

bool is_calibrated_to_mesh(Calibration calibration, int dimension, const NumericalOptions& options) {
  const bool is_measured =
      dimension == 2 && options.points_per_direction == 2 && options.discontinuous != DiscontinuousElements::never;
  return is_measured && calibration == Calibration::mesh_consistent;
}

template <int dim>
bool calibrate_to_mesh(Problem<dim>& problem, const NumericalOptions& options, double element_size) {
  PERIMORPH_ASSERT(element_size > 0., "elements of size {}", element_size);
  const bool is_calibrated = is_calibrated_to_mesh(problem.calibration, dim, options);
  if (!is_calibrated || !problem.breaks()) return false;
  std::vector<double> resistances;  // of materials
  for (auto& material : problem.materials) {
    resistances.push_back(lattice_resistance(options.discontinuous, options.peridynamic_stiffness,
                                             material.micromodulus.characteristic_length / element_size,
                                             material.dilatational_ratio));
    make_up_for(resistances.back(), material.toughness);
  }
  for (auto& [first, second, toughness] : problem.interfaces) {
    make_up_for(0.5 * (resistances[first] + resistances[second]), toughness);
  }
  return true;
}

template double element_size<2>(const base::Comm&, const mesh::Mesh<2>&, const Problem<2>&);
template bool calibrate_to_mesh<2>(Problem<2>&, const NumericalOptions&, double);

template double element_size<3>(const base::Comm&, const mesh::Mesh<3>&, const Problem<3>&);
template bool calibrate_to_mesh<3>(Problem<3>&, const NumericalOptions&, double);

}  // namespace perimorph::model
