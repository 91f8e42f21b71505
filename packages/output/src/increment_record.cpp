#include "perimorph/output/increment_record.hpp"

namespace perimorph::output {

namespace {

using Record = IncrementRecord;

/// What the loads have done beyond what is stored and what breaking and friction took: lost in brittle jumps.
double jump_loss(const Record& r) {
  return r.energies.external_work - r.energies.elastic - r.energies.dissipated - r.energies.friction;
}

}  // namespace

std::vector<Column> history_columns(const std::vector<Reaction>& reactions, bool is_measured, bool rubs) {
  const auto count = [](base::GlobalId discretization::Counts::*which) {
    return [which](const Record& r) { return static_cast<double>(r.counts.*which); };
  };
  const auto energy = [](double discretization::Energies::*which) {
    return [which](const Record& r) { return r.energies.*which; };
  };
  using discretization::Counts;
  using discretization::Energies;
  std::vector<Column> columns = {
      {"load_factor", [](const Record& r) { return r.load_factor; }},
      {"broken_bonds", count(&Counts::broken_bonds)},
      {"damaged_elements", count(&Counts::damaged_elements)},
      {"dgfe_elements", count(&Counts::dgfe_elements)},
      {"unknowns", count(&Counts::unknowns)},
      {"linear_solves", count(&Counts::linear_solves)},
      {"cg_iterations", count(&Counts::cg_iterations)},
      {"wall_seconds", [](const Record& r) { return r.seconds; }},
      {"elastic_energy", energy(&Energies::elastic)},
      {"dissipated_energy", energy(&Energies::dissipated)},
      {"external_work", energy(&Energies::external_work)},
      {"jump_loss", jump_loss},
      {"overlap", [](const Record& r) { return r.overlap; }},
  };
  if (rubs) columns.push_back({"friction_energy", energy(&Energies::friction)});
  if (is_measured) columns.push_back({"measure", [](const Record& r) { return r.measured; }});
  const auto of_each = [&](const std::string& prefix, double Reaction::*which) {
    for (std::size_t i = 0; i < reactions.size(); ++i) {
      columns.push_back({prefix + reactions[i].column, [=](const Record& r) { return r.reactions.at(i).*which; }});
    }
  };
  of_each("reaction_", &Reaction::force);
  of_each("displacement_", &Reaction::displacement);
  return columns;
}

}  // namespace perimorph::output
