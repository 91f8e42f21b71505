#include "preview.hpp"

#include <Teuchos_XMLParameterListHelpers.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "perimorph/base/errors.hpp"
#include "perimorph/cases/geometry.hpp"
#include "perimorph/output/field_series.hpp"

namespace perimorph::application {

using Numbers = Teuchos::Array<double>;
using Teuchos::ParameterList;

namespace {

constexpr const char* table_name = "preview.xml";

std::string path_in(const std::string& folder, const char* name) {
  return (std::filesystem::path(folder) / name).string();
}

/// One after the other, from first to last increment.
struct Stage {
  std::string name;
  int first, last;
};

/// Those that the run comes to; without steps the run is one stage.
std::vector<Stage> stages_of(const cases::Loading& loading) {
  if (loading.steps.empty()) return {{"run", 1, loading.increments}};
  std::vector<Stage> stages;
  int last = 0;
  for (const auto& step : loading.steps) {
    if (last == loading.increments) break;
    const int first = last + 1;
    last += static_cast<int>(std::min<double>(step.all_increments(), loading.increments - last));
    stages.push_back({step.name, first, last});
  }
  return stages;
}

void put_stages(const std::vector<Stage>& stages, ParameterList& list) {
  for (const auto& [name, first, last] : stages) {
    auto& stage = list.sublist(name);
    stage.set("First Increment", first);
    stage.set("Last Increment", last);
  }
}

/// What a condition's rate is multiplied by.
struct Factors {
  std::vector<double> at_ends = {0.};  ///< before the first increment, and at the end of each stage
  std::vector<double> largest = {};    ///< in each stage, by its magnitude
};

/// Where a measure decides on the load factor, it is not known: once without it, and once at 1.
Factors factors_of(const std::string& condition, const cases::Loading& loading) {
  if (loading.control == cases::Control::measure) return {{0., 1.}, {1.}};
  const auto amplitude = cases::amplitude_of(condition, loading.steps);
  const auto factor = [&](int increment) { return loading.steps.empty() ? increment : amplitude->at(increment); };
  Factors factors;
  for (const auto& stage : stages_of(loading)) {
    factors.at_ends.push_back(factor(stage.last));
    factors.largest.push_back(factor(stage.first));
    for (int k = stage.first; k <= stage.last; ++k) {
      if (std::abs(factor(k)) > std::abs(factors.largest.back())) factors.largest.back() = factor(k);
    }
  }
  return factors;
}

/// The values of a condition, one after the other at each of its factors.
Numbers values_at(const std::vector<double>& factors, const std::vector<double>& rate,
                  const std::vector<double>& constant) {
  Numbers values;
  for (const double factor : factors) {
    for (std::size_t c = 0; c < rate.size(); ++c) values.push_back(rate[c] * factor + constant[c]);
  }
  return values;
}

/// A condition of one kind. Those without a group act on all of the body.
class Conditions {
 public:
  Conditions(const cases::Loading& loading, ParameterList& list) : loading_(loading), list_(list) {}

  ParameterList& put(const char* kind, const std::string& name, const std::vector<double>& rate,
                     const std::vector<double>& constant) {
    auto& one = list_.sublist(kind).sublist(name);
    const auto factors = factors_of(name, loading_);
    one.set("Values", values_at(factors.at_ends, rate, constant));
    one.set("Largest", values_at(factors.largest, rate, constant));
    const auto stages = stages_of(loading_);
    const double begin = cases::begin_of(name, loading_.steps), end = cases::end_of(name, loading_.steps);
    one.set("First Stage", static_cast<int>(std::count_if(stages.begin(), stages.end(),
                                                          [&](const Stage& stage) { return stage.first <= begin; })));
    one.set("Stages", static_cast<int>(std::count_if(stages.begin(), stages.end(),
                                                     [&](const Stage& stage) { return stage.first <= end; })));
    return one;
  }

  void put_everywhere(const std::string& name, const std::vector<double>& rate, const std::vector<double>& constant) {
    const auto is_zero = [](double value) { return value == 0.; };
    if (std::all_of(rate.begin(), rate.end(), is_zero) && std::all_of(constant.begin(), constant.end(), is_zero))
      return;
    put(name.c_str(), name, rate, constant);
  }

 private:
  const cases::Loading& loading_;
  ParameterList& list_;
};

template <int dim>
void put_conditions(const cases::Case& input, const mesh::Mesh<dim>& mesh, ParameterList& list) {
  const auto& all = input.boundary_conditions;
  Conditions conditions(input.loading, list);
  for (std::size_t p = 0; p < all.symmetry_planes.size(); ++p) {  // nothing moves across them
    auto& one = conditions.put("Displacements", all.symmetry_planes[p].name + " (plane of symmetry)", {0.}, {0.});
    one.set("Group", all.symmetry_planes[p].group);
    one.set("Component", mesh.symmetry_planes[p].axis);
  }
  for (const auto& d : cases::normalized(all.displacements)) {
    auto& one = conditions.put("Displacements", d.name, {d.value.rate}, {d.value.constant});
    one.set("Group", d.node_set);
    if (d.component >= 0) one.set("Component", d.component);
    if (!d.direction.empty()) one.set("Direction", Numbers(d.direction));
  }
  for (const auto& t : all.tractions) conditions.put("Tractions", t.name, t.rate, t.constant).set("Group", t.group);
  for (const auto& p : all.pressures) conditions.put("Pressures", p.name, {p.rate}, {p.constant}).set("Group", p.group);
  for (const auto& t : all.temperatures) {
    auto& one = conditions.put("Temperatures", t.name, {t.rate}, {t.constant});
    if (!t.blocks.empty()) one.set("Blocks", Teuchos::Array<std::string>(t.blocks));
    if (t.direction.empty()) continue;
    one.set("Direction", Numbers(t.direction));
    one.set("Positions", Numbers(t.positions));
    one.set("Factors", Numbers(t.factors));
  }
  conditions.put_everywhere("Body Force", all.body_force_rate, all.body_force_constant);
  conditions.put_everywhere("Self-Weight", all.self_weight_rate, all.self_weight_constant);
}

void put_rigid_groups(const std::vector<discretization::RigidGroup>& groups, ParameterList& list) {
  for (const auto& group : groups) {
    auto& one = list.sublist(group.name);
    one.set("Group", group.node_set);
    one.set("Shared", cases::shared_by(group));
  }
}

void put_toughness(const materials::Toughness& toughness, ParameterList& list) {
  if (!toughness.breaks()) return;
  list.set("Critical Stretch", toughness.critical_stretch());
  list.set("Fracture Energy", toughness.fracture_energy);
  if (toughness.law.softens()) list.set("Softens from", toughness.law.limit());
}

template <int dim>
void put_materials(const cases::Case& input, const model::Problem<dim>& problem, ParameterList& list) {
  const auto solids = cases::solids_of(input);
  for (std::size_t m = 0; m < solids.size(); ++m) {
    auto& one = list.sublist(solids[m].name);
    one.set("Young's Modulus", solids[m].youngs_modulus);
    one.set("Poisson's Ratio", solids[m].poissons_ratio);
    if (solids[m].density > 0.) one.set("Density", solids[m].density);
    if (solids[m].thermal_expansion != 0.) one.set("Thermal Expansion", solids[m].thermal_expansion);
    if (solids[m].tensile_strength) one.set("Tensile Strength", *solids[m].tensile_strength);
    if (solids[m].compressive_strength) one.set("Compressive Strength", *solids[m].compressive_strength);
    one.set("Characteristic Length", problem.materials[m].micromodulus.characteristic_length);
    put_toughness(problem.materials[m].toughness, one);
  }
}

/// The mesh's blocks in their order, and the place of each one's material.
template <int dim>
void put_blocks(const model::Problem<dim>& problem, const mesh::Mesh<dim>& mesh, ParameterList& list) {
  for (const auto& name : mesh.block_names) {
    const auto found = problem.material_of_block.find(name);
    list.sublist(name).set("Material", found == problem.material_of_block.end() ? 0 : found->second);
  }
}

template <int dim>
void put_interfaces(const model::Problem<dim>& problem, ParameterList& list) {
  for (const auto& [first, second, toughness] : problem.interfaces) {
    auto& one = list.sublist(problem.materials[first].name + " - " + problem.materials[second].name);
    put_toughness(toughness, one);
  }
}

template <int dim>
Numbers numbers_of(const base::Point<dim>& x) {
  return Numbers(x.begin(), x.end());
}

template <int dim>
void put_zones(const std::vector<morphing::Zone<dim>>& zones, ParameterList& list) {
  for (std::size_t z = 0; z < zones.size(); ++z) {
    if (!zones[z].lower.allFinite()) continue;  // everywhere
    auto& one = list.sublist(std::to_string(z + 1));
    one.set("Lower Corner", numbers_of<dim>(zones[z].lower));
    one.set("Upper Corner", numbers_of<dim>(zones[z].upper));
    one.set("Inner Radius", zones[z].inner_radius);
    one.set("Outer Radius", zones[z].inner_radius + zones[z].rim);
  }
}

/// The corners of segments or triangles, one after the other.
template <int dim>
void put_pre_cracks(const std::vector<cases::PreCrack>& cracks, ParameterList& list) {
  for (const auto& crack : cracks) {
    Numbers corners;
    for (const auto& facet : cases::facets_of<dim>({crack})) {
      for (const auto& corner : facet) corners.insert(corners.end(), corner.begin(), corner.end());
    }
    list.sublist(crack.name).set("Corners", corners);
  }
}

/// What increments prescribe instead of the load, at the last one.
void put_measure(const cases::Loading& loading, ParameterList& list) {
  if (loading.control != cases::Control::measure) return;
  const auto& measure = loading.measure;
  list.set("Value", measure.rate * loading.increments + measure.constant);
  list.set("Direction", Numbers(measure.direction));
  const auto put_place = [&](const char* name, const std::string& group, const std::vector<double>& point) {
    auto& place = list.sublist(name);
    if (!group.empty()) place.set("Group", group);
    if (!point.empty()) place.set("Point", Numbers(point));
  };
  put_place("Place", measure.group, measure.point);
  put_place("Other Place", measure.other_group, measure.other_point);
}

void put_probes(const std::vector<cases::Probe>& probes, ParameterList& list) {
  for (const auto& probe : probes) list.sublist(probe.name).set("Points", Numbers(probe.points));
}

template <int dim>
ParameterList table_of(const cases::Case& input, const model::Problem<dim>& problem, const mesh::Mesh<dim>& mesh,
                       double element_size) {
  ParameterList table("preview");
  table.set("Name", input.name);
  table.set("Title", input.title);
  table.set("Elements", static_cast<int>(mesh.n_global_elements));
  table.set("Element Size", element_size);
  table.set("Horizon", problem.horizon());
  table.set("Thickness", problem.thickness);
  table.set("Elastic Model", input.resolved.sublist("Material").get<std::string>("Elastic Model"));
  put_materials(input, problem, table.sublist("Materials"));
  put_blocks(problem, mesh, table.sublist("Blocks"));
  put_interfaces(problem, table.sublist("Interfaces"));
  put_zones(problem.seeds, table.sublist("Zones"));
  put_pre_cracks<dim>(input.pre_cracks, table.sublist("Pre-Cracks"));
  put_stages(stages_of(input.loading), table.sublist("Stages"));
  put_conditions(input, mesh, table.sublist("Conditions"));
  put_measure(input.loading, table.sublist("Measure"));
  auto& planes = table.sublist("Symmetry Planes");
  for (const auto& [name, group] : input.boundary_conditions.symmetry_planes) planes.sublist(name).set("Group", group);
  put_rigid_groups(input.boundary_conditions.rigid_groups, table.sublist("Rigid Groups"));
  put_probes(input.output.probes, table.sublist("Probes"));
  return table;
}

}  // namespace

void make_preview_folder(const base::Comm& comm, const std::string& folder) {
  base::on_all_ranks(comm, [&] {
    if (comm.getRank() != 0) return;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw base::UserError(fmt::format("{}: the folder cannot be made: {}", folder, error.message()));
    if (std::filesystem::exists(path_in(folder, table_name)) || std::filesystem::is_empty(folder, error)) return;
    throw base::UserError(fmt::format(
        "{}: found other files in it; allowed is a folder that is new, empty or an earlier preview's", folder));
  });
}

template <int dim>
void write_preview(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input,
                   const model::Problem<dim>& problem, fracture::Body<dim>& body, double element_size,
                   const std::string& folder) {
  body.renew_forces();  // fields are made of them
  output::FieldSeries<dim> series(comm, {path_in(folder, "preview.e"), input.title, {}, {}, false}, {}, {});
  series.write(0, body, {});
  base::on_all_ranks(*comm, [&] {
    if (comm->getRank() != 0) return;
    const std::string file = path_in(folder, table_name);
    std::ofstream stream(file);
    Teuchos::writeParameterListToXmlOStream(table_of(input, problem, body.mesh(), element_size), stream);
    stream.close();
    if (!stream) throw base::UserError(fmt::format("{}: cannot be written", file));
  });
}

#define PERIMORPH_INSTANTIATE(dim)                                                                                   \
  template void write_preview(const Teuchos::RCP<const base::Comm>&, const cases::Case&, const model::Problem<dim>&, \
                              fracture::Body<dim>&, double, const std::string&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::application
