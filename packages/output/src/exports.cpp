#include "perimorph/output/exports.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "component_names.hpp"
#include "open_table.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/io/bond_file.hpp"

namespace perimorph::output {

using base::GlobalId;
using base::Point;
using fracture::Body;
using Texts = std::vector<std::string>;

namespace {

template <int dim>
Texts probe_columns() {
  Texts columns = {"increment", "load_factor", "probe", "place"};
  for (int c = 0; c < dim; ++c) columns.emplace_back(axis_names[c]);
  for (int c = 0; c < dim; ++c) columns.push_back(std::string("displacement_") + axis_names[c]);
  columns.insert(columns.end(), stress_names<dim>().begin(), stress_names<dim>().end());
  return columns;
}

template <int dim>
Texts crack_columns() {
  const std::string size = dim == 2 ? "length" : "area";
  return {"increment", "load_factor", "open_sides", "side_" + size, "crack_" + size};
}

template <int dim>
Texts path_columns() {
  Texts columns = {"increment", "element_1", "element_2"};
  for (int k = 1; k <= bonds::OpenSide<dim>::max_corners; ++k) {
    for (int c = 0; c < dim; ++c) columns.push_back(fmt::format("{}_{}", axis_names[c], k));
  }
  return columns;
}

/// The pairs of elements in a table of open sides.
std::set<std::pair<GlobalId, GlobalId>> sides_in(const std::string& file) {
  std::set<std::pair<GlobalId, GlobalId>> sides;
  std::ifstream table(file);
  std::string row;
  std::getline(table, row);  // names of the columns
  while (std::getline(table, row)) {
    long long first = 0, second = 0;
    const int n_read = std::sscanf(row.c_str(), "%*d,%lld,%lld", &first, &second);
    PERIMORPH_ASSERT(n_read == 2, "{}: \"{}\" names no two elements", file, row);
    sides.insert({first - 1, second - 1});
  }
  return sides;
}

std::string bonds_file(const std::string& folder, int increment) {
  return (std::filesystem::path(folder) / fmt::format("bonds-{:06d}.vtp", increment)).string();
}

/// Those of an earlier run that went further, so that all in the folder belong to one run.
void remove_bonds_after(const std::string& folder, int increment) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    int found = 0;
    const std::string name = entry.path().filename();
    const bool is_bonds = std::sscanf(name.c_str(), "bonds-%d.vtp", &found) == 1 &&
                          entry.path() == std::filesystem::path(bonds_file(folder, found));
    if (is_bonds && found > increment) std::filesystem::remove(entry.path(), ignored);
  }
}

/// A bond and a point as they travel to rank 0.
struct BondRecord {
  GlobalId first, second;
  double stretch;
  signed char broken;
};
template <int dim>
struct PointRecord {
  GlobalId id;
  std::array<double, dim> position, displacement;
};

/// The bonds that count on this rank.
template <int dim>
std::vector<BondRecord> own_bonds(const Body<dim>& body) {
  const auto model = body.model();
  const auto& at_points = body.system().at_points();
  const auto& u = at_points.displacement;
  std::vector<BondRecord> records;
  model.bonds.for_each_bond([&](const bonds::Bond<dim>& bond) {
    if (!model.bonds.counts_here(bond)) return;
    const double length = (bond.xi + u[bond.second_point] - u[bond.first_point]).norm();
    records.push_back({model.points.global_id(bond.first_element, bond.first_end),
                       model.points.global_id(bond.second_element, bond.second_end),
                       length / bond.xi.norm() - 1. - bond.mean_of(at_points.eigenstrain),
                       static_cast<signed char>(bond.is_broken)});
  });
  return records;
}

/// With their images beyond planes of symmetry.
template <int dim>
std::vector<PointRecord<dim>> own_bonded_points(const Body<dim>& body) {
  const auto model = body.model();
  const auto& mesh = body.mesh();
  std::vector<PointRecord<dim>> records;
  const auto add = [&](int element, int source, const Point<dim>& signs) {
    if (source >= mesh.n_owned_elements || model.bonds.pairs_of(source).empty()) return;
    for (int q = 0; q < model.points.count(element); ++q) {
      const Point<dim>& u = body.system().at_points().displacement[model.points.first(source) + q];
      PointRecord<dim> record{model.points.global_id(element, q), {}, {}};
      Eigen::Map<Point<dim>>(record.position.data()) = model.points.position(model.points.first(element) + q);
      Eigen::Map<Point<dim>>(record.displacement.data()) = signs.cwiseProduct(u);
      records.push_back(record);
    }
  };
  for (int e = 0; e < mesh.n_owned_elements; ++e) add(e, e, Point<dim>::Ones());
  for (int e = mesh.n_real_elements(); e < mesh.n_elements(); ++e) add(e, mesh.image(e).element, mesh.image(e).signs);
  return records;
}

template <int dim>
io::BondModel<dim> model_of(std::vector<PointRecord<dim>> points, std::vector<BondRecord> bonds) {
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  std::sort(bonds.begin(), bonds.end(),
            [](const auto& a, const auto& b) { return std::tie(a.first, a.second) < std::tie(b.first, b.second); });
  io::BondModel<dim> model;
  for (const auto& point : points) {
    model.point_ids.push_back(point.id);
    model.positions.emplace_back(Eigen::Map<const Point<dim>>(point.position.data()));
    model.displacements.emplace_back(Eigen::Map<const Point<dim>>(point.displacement.data()));
  }
  const auto place = [&](GlobalId id) {
    return std::lower_bound(model.point_ids.begin(), model.point_ids.end(), id) - model.point_ids.begin();
  };
  for (const auto& bond : bonds) {
    model.ends.insert(model.ends.end(), {place(bond.first), place(bond.second)});
    model.stretch.push_back(bond.stretch);
    model.broken.push_back(bond.broken);
  }
  return model;
}

}  // namespace

template <int dim>
Exports<dim>::Exports(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh, const cases::Case& input,
                      const std::string& folder, int increment, const std::optional<ResultsState>& earlier)
    : comm_(comm),
      folder_(folder),
      probes_(*comm, mesh, input.output.probes),
      horizon_(input.peridynamics.horizon),
      bond_increments_(input.output.bond_increments),
      records_crack_(input.output.records_crack) {
  base::on_all_ranks(*comm, [&] {
    if (comm_->getRank() != 0) return;
    open_tables(earlier);
    remove_bonds_after(folder_, increment);
  });
}

template <int dim>
void Exports<dim>::open_tables(const std::optional<ResultsState>& earlier) {
  const auto table = [&](const char* name, const Texts& columns) {
    return open_table(folder_, name, columns, earlier);
  };
  if (!probes_.places().empty()) probe_table_ = table("probes.csv", probe_columns<dim>());
  if (records_crack_) {
    crack_table_ = table("crack.csv", crack_columns<dim>());
    path_table_ = table("crack_path.csv", path_columns<dim>());
    known_sides_ = sides_in((std::filesystem::path(folder_) / "crack_path.csv").string());
  }
  if (earlier) bond_files_ = earlier->bonds;
  n_bond_files_on_disk_ = bond_files_.size();
}

/// Those that there are.
template <int dim>
std::vector<const io::History*> Exports<dim>::tables() const {
  std::vector<const io::History*> tables = {probe_table_.get(), crack_table_.get(), path_table_.get()};
  tables.erase(std::remove(tables.begin(), tables.end(), nullptr), tables.end());
  return tables;
}

template <int dim>
void Exports<dim>::note_files(ResultsState& state) const {
  for (const auto* table : tables()) state.tables.push_back(table->extent());
  state.bonds = bond_files_;
}

template <int dim>
void Exports<dim>::bring_to_disk() {
  const auto bring = [&](const io::FileExtent& file) {
    io::bring_to_disk((std::filesystem::path(folder_) / file.name).string());
  };
  for (const auto* table : tables()) bring(table->extent());
  for (; n_bond_files_on_disk_ < bond_files_.size(); ++n_bond_files_on_disk_) bring(bond_files_[n_bond_files_on_disk_]);
}

template <int dim>
void Exports<dim>::accept(int increment, const Body<dim>& body) {
  if (!probes_.places().empty()) record_probes(increment, body);
  if (records_crack_) record_crack(increment, body);
  if (std::find(bond_increments_.begin(), bond_increments_.end(), increment) != bond_increments_.end()) {
    write_bonds(increment, body);
  }
  base::on_all_ranks(*comm_, [&] {
    for (const auto* table : tables()) table->check();
  });
}

template <int dim>
void Exports<dim>::record_probes(int increment, const Body<dim>& body) {
  const auto samples = probes_.measure(*comm_, body);
  base::on_all_ranks(*comm_, [&] {
    for (const auto& sample : samples) {
      const auto& place = probes_.places()[sample.place];
      Texts row = {std::to_string(increment), io::History::number(body.load_factor()), place.probe,
                   std::to_string(place.number)};
      const auto append = [&](const auto& values) {
        std::transform(values.begin(), values.end(), std::back_inserter(row), io::History::number);
      };
      append(place.position);
      append(sample.displacement);
      append(sample.stress);
      probe_table_->write_texts(row);
    }
  });
}

template <int dim>
void Exports<dim>::record_crack(int increment, const Body<dim>& body) {
  auto open = base::gather_on_root(*comm_, bonds::open_sides(body.mesh(), body.model().bonds));
  std::sort(open.begin(), open.end());
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    double sides_size = 0.;
    for (const auto& side : open) {
      sides_size += bonds::size(side);
      if (!known_sides_.insert({side.first, side.second}).second) continue;
      std::vector<double> row = {static_cast<double>(increment), static_cast<double>(side.first + 1),
                                 static_cast<double>(side.second + 1)};
      for (int k = 0; k < bonds::OpenSide<dim>::max_corners; ++k) {  // of a triangle the last one twice
        const auto& point = side.points[std::min(k, side.n_corners - 1)];
        row.insert(row.end(), point.begin(), point.end());
      }
      path_table_->write(row);
    }
    crack_table_->write({static_cast<double>(increment), body.load_factor(), static_cast<double>(open.size()),
                         sides_size, bonds::crack_size(open, horizon_)});
  });
}

template <int dim>
void Exports<dim>::write_bonds(int increment, const Body<dim>& body) {
  const auto points = base::gather_on_root(*comm_, own_bonded_points(body));
  const auto bonds = base::gather_on_root(*comm_, own_bonds(body));
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    const std::filesystem::path file = bonds_file(folder_, increment);
    io::write_bonds(file.string(), model_of<dim>(points, bonds));
    bond_files_.push_back({file.filename(), io::size_of(file.string())});
  });
}

template class Exports<2>;
template class Exports<3>;

}  // namespace perimorph::output
