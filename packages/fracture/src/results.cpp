#include "perimorph/fracture/results.hpp"

#include <fmt/ranges.h>

#include <Teuchos_XMLParameterListHelpers.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <tuple>

#include "columns.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/bonds/crack.hpp"
#include "perimorph/operators/fields.hpp"

namespace perimorph::fracture {

using base::GlobalId;

namespace {

constexpr const char* broken_surface_name = "broken_surface";  // a side set

template <int dim>
typename io::ExodusSeries<dim>::Names variable_names(std::vector<std::string> globals) {
  typename io::ExodusSeries<dim>::Names names{std::move(globals), {}, {"alpha", "damage", "class", "energy"}};
  for (int c = 0; c < dim; ++c) names.nodal.push_back(std::string("displacement_") + axis_names[c]);
  names.element.insert(names.element.end(), stress_names<dim>().begin(), stress_names<dim>().end());
  return names;
}

/// A parameter list as lines of XML.
std::vector<std::string> lines_of(const Teuchos::ParameterList& list) {
  std::stringstream text;
  Teuchos::writeParameterListToXmlOStream(list, text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// FE, MORPH, PD: continuous elements by their class; DGFE: peridynamic ones that have been split off.
constexpr const char* kind_names[] = {"FE", "MORPH", "PD", "DGFE"};
template <int dim>
int kind(const Body<dim>& body, int element) {
  const auto& topology = body.topology();
  return topology.discontinuous()[element] != 0 ? 3 : static_cast<int>(topology.classes()[element]);
}

template <int dim>
std::vector<ElementRecord> own_elements(const Body<dim>& body) {
  std::vector<ElementRecord> records;
  const auto& mesh = body.mesh();
  const auto model = body.model();
  for (int e = 0; e < mesh.n_owned_elements; ++e) {
    ElementRecord record{mesh.element_ids[e], {}, mesh.blocks[e], kind(body, e), mesh.types[e]};
    for (int k = 0; k < mesh.n_corners(e); ++k) record.nodes[k] = model.dofs.global_node(model.dofs.nodes_of(e)[k]);
    records.push_back(record);
  }
  return records;
}

BlockKey key_of(const ElementRecord& record) { return {record.block, record.kind, record.type}; }

/// Of all ranks' elements. Collective.
std::set<BlockKey> all_keys(const base::Comm& comm, const std::vector<ElementRecord>& own) {
  std::set<BlockKey> keys;
  for (const auto& record : own) keys.insert(key_of(record));
  const auto all = base::gather_on_all(comm, std::vector<BlockKey>(keys.begin(), keys.end()));
  return {all.begin(), all.end()};
}

/// The type of each block's elements; of several the first.
std::map<int, mesh::ElementType> first_types(const std::set<BlockKey>& keys) {
  std::map<int, mesh::ElementType> types;
  for (const auto& key : keys) {
    auto& type = types.try_emplace(key.block, key.type).first->second;
    type = std::min(type, key.type);
  }
  return types;
}

/// Blocks by material, class and type, elements in each by id. Returns each record's place in the file. A block's name
/// and id depend on these three only, not on the topology: 11, 12, 13, 14 are FE to DGFE of the mesh's first block, 21
/// to 24 of its second. Elements of other types than a block's first are in blocks of their own, numbered after all
/// these.
template <int dim>
std::vector<int> sort_into_blocks(const std::vector<ElementRecord>& records, const std::set<BlockKey>& keys,
                                  const std::vector<std::string>& block_names, io::ExodusModel<dim>& model) {
  const auto types = first_types(keys);
  std::map<BlockKey, std::size_t> block_of;
  for (const auto& key : keys) {
    const int other_type = static_cast<int>(key.type) - static_cast<int>(types.at(key.block));
    const int id = 10 * (other_type * static_cast<int>(block_names.size()) + key.block + 1) + key.kind + 1;
    std::string name = block_names[key.block] + "_" + kind_names[key.kind];
    if (other_type > 0) name += "_" + mesh::exodus_name(key.type);
    block_of[key] = model.blocks.size();
    model.blocks.push_back({name, key.type, {}, {}, id});
  }
  std::vector<int> order(records.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    const auto &a = records[i], &b = records[j];
    return std::tie(a.block, a.kind, a.type, a.id) < std::tie(b.block, b.kind, b.type, b.id);
  });
  std::vector<int> place(records.size());
  for (std::size_t position = 0; position < order.size(); ++position) {
    const auto& record = records[order[position]];
    place[order[position]] = static_cast<int>(position);
    auto& block = model.blocks[block_of.at(key_of(record))];
    block.element_ids.push_back(record.id);
    for (int k = 0; k < mesh::n_corners(record.type); ++k)
      block.connectivity.push_back(static_cast<int>(record.nodes[k]));
  }
  return place;
}

template <int dim>
std::vector<int> own_nodes_in(const Body<dim>& body, const std::vector<int>& reference_nodes) {
  const auto model = body.model();
  std::vector<int> found;
  for (int n = 0; n < model.dofs.n_owned_nodes(); ++n) {
    if (std::binary_search(reference_nodes.begin(), reference_nodes.end(), model.dofs.reference_node(n)))
      found.push_back(n);
  }
  return found;
}

/// By place in the file, whatever the ranks.
void sort_sides(std::vector<mesh::Side>& sides) {
  std::sort(sides.begin(), sides.end(), [](const mesh::Side& a, const mesh::Side& b) {
    return std::tie(a.element, a.side) < std::tie(b.element, b.side);
  });
}

/// The mesh's, and the surface of its cracks.
template <int dim>
SideSets side_sets(const mesh::Mesh<dim>& mesh, const std::vector<mesh::Side>& broken_surface) {
  SideSets sets(mesh.side_sets.begin(), mesh.side_sets.end());
  sets[broken_surface_name] = broken_surface;
  return sets;
}

/// Groups of own nodes and of own elements' sides, gathered on rank 0.
template <int dim>
void gather_groups(const base::Comm& comm, const Body<dim>& body, const SideSets& side_sets,
                   const std::map<GlobalId, int>& place_of, io::ExodusModel<dim>& model) {
  const auto view = body.model();
  for (const auto& [name, reference_nodes] : body.mesh().node_sets) {
    std::vector<int> own;
    for (const int n : own_nodes_in(body, reference_nodes)) own.push_back(static_cast<int>(view.dofs.global_node(n)));
    model.node_sets[name] = base::gather_on_root(comm, own);
  }
  struct SideRecord {
    GlobalId element;
    int side;
  };
  for (const auto& [name, sides] : side_sets) {
    std::vector<SideRecord> own;
    for (const auto& side : sides) {
      if (side.element < body.mesh().n_owned_elements)
        own.push_back({body.mesh().element_ids[side.element], side.side});
    }
    auto& all = model.side_sets[name];
    for (const auto& record : base::gather_on_root(comm, own))
      all.push_back({place_of.at(record.element), record.side});
    sort_sides(all);
  }
}

template <int dim>
std::vector<base::Point<dim>> own_coordinates(const Body<dim>& body) {
  const auto model = body.model();
  std::vector<base::Point<dim>> own;
  for (int n = 0; n < model.dofs.n_owned_nodes(); ++n)
    own.push_back(model.mesh.coordinates[model.dofs.reference_node(n)]);
  return own;
}

/// All ranks' points on rank 0. They travel as numbers: Eigen's vectors are not trivially copyable.
template <int dim>
std::vector<base::Point<dim>> gather_points(const base::Comm& comm, const std::vector<base::Point<dim>>& own) {
  std::vector<double> flat;
  for (const auto& x : own) flat.insert(flat.end(), x.begin(), x.end());
  const auto all = base::gather_on_root(comm, flat);
  std::vector<base::Point<dim>> points;
  for (std::size_t i = 0; i < all.size(); i += dim)
    points.push_back(Eigen::Map<const base::Point<dim>>(all.data() + i));
  return points;
}

/// Local nodes of the elements that this rank owns, by ascending global number.
template <int dim>
std::vector<int> nodes_of_own_elements(const Body<dim>& body) {
  const auto model = body.model();
  std::map<GlobalId, int> nodes;
  for (int e = 0; e < body.mesh().n_owned_elements; ++e) {
    for (int k = 0; k < body.mesh().n_corners(e); ++k) {
      const int node = model.dofs.nodes_of(e)[k];
      nodes[model.dofs.global_node(node)] = node;
    }
  }
  std::vector<int> ordered;
  for (const auto& [id, node] : nodes) ordered.push_back(node);
  return ordered;
}

/// The groups within one rank's part. @param nodes its nodes; @param place of own elements
template <int dim>
void take_own_groups(const Body<dim>& body, const SideSets& side_sets, const std::vector<int>& nodes,
                     const std::vector<int>& place, io::ExodusModel<dim>& model) {
  const auto& dofs = body.model().dofs;
  for (const auto& [name, reference_nodes] : body.mesh().node_sets) {
    auto& members = model.node_sets[name];
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (std::binary_search(reference_nodes.begin(), reference_nodes.end(), dofs.reference_node(nodes[n])))
        members.push_back(static_cast<int>(n));
    }
  }
  for (const auto& [name, sides] : side_sets) {
    auto& members = model.side_sets[name];
    for (const auto& side : sides) {
      if (side.element < body.mesh().n_owned_elements) members.push_back({place[side.element], side.side});
    }
    sort_sides(members);
  }
}

}  // namespace

template <int dim>
Results<dim>::Results(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& folder,
                      Voice voice, base::Profile& profile, int increment, const std::optional<ResultsState>& earlier)
    : comm_(comm),
      voice_(std::move(voice)),
      profile_(profile),
      is_spread_(input.output.spread_files),
      horizon_(input.peridynamics.horizon),
      output_every_(input.output.every),
      last_increment_(input.loading.increments) {
  for (const auto& group : input.output.reactions) {
    for (int c = 0; c < dim; ++c) reactions_.push_back({group + "_" + axis_names[c], group, c});
  }
  if (earlier) take_over(*earlier);
  std::vector<std::string> globals = {"load_factor",    "broken_bonds",      "damaged_elements", "dgfe_elements",
                                      "unknowns",       "linear_solves",     "cg_iterations",    "wall_seconds",
                                      "elastic_energy", "dissipated_energy", "external_work",    "jump_loss",
                                      "overlap"};
  for (const auto& r : reactions_) globals.push_back("reaction_" + r.column);
  for (const auto& r : reactions_) globals.push_back("displacement_" + r.column);

  base::on_all_ranks(*comm, [&] {
    if (comm_->getRank() != 0) return;
    std::vector<std::string> columns = {"increment"};
    columns.insert(columns.end(), globals.begin(), globals.end());
    const std::string history = (std::filesystem::path(folder) / "history.csv").string();
    history_ = std::make_unique<io::History>(earlier ? io::History::resume(history, columns, increment)
                                                     : io::History(history, columns));
  });
  open_series(input, folder, std::move(globals), earlier);
}

/// On rank 0, or for spread files on all. Collective.
template <int dim>
void Results<dim>::open_series(const cases::Case& input, const std::string& folder, std::vector<std::string> globals,
                               const std::optional<ResultsState>& earlier) {
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0 && !is_spread_) return;
    std::optional<io::SpreadPart> part;
    if (is_spread_) part = io::SpreadPart{comm_->getRank(), comm_->getSize()};
    series_ = std::make_unique<io::ExodusSeries<dim>>((std::filesystem::path(folder) / (input.name + ".e")).string(),
                                                      input.title, variable_names<dim>(std::move(globals)),
                                                      lines_of(input.resolved), part);
    if (!earlier) return;
    series_->resume(earlier->series);
    if (comm_->getRank() == 0) series_->remove_the_rest();
  });
}

template <int dim>
void Results<dim>::take_over(const ResultsState& earlier) {
  first_file_is_new_ = false;
  earlier_seconds_ = earlier.seconds_before;
  seconds_before_ = last_word_ = earlier.seconds - earlier.seconds_before;
  first_break_ = earlier.first_break;
  broken_before_ = earlier.broken;
  total_solves_ = earlier.solves;
  total_iterations_ = earlier.iterations;
  for (std::size_t i = 0; i < reactions_.size(); ++i) {
    reactions_[i].peak = earlier.peaks.at(i);
    reactions_[i].peak_increment = static_cast<int>(earlier.peak_increments.at(i));
  }
}

template <int dim>
ResultsState Results<dim>::state() const {
  ResultsState state{
      seconds(), earlier_seconds_, {}, first_break_, broken_before_, total_solves_, total_iterations_, {}, {}};
  if (series_) state.series = series_->extent();
  for (const auto& r : reactions_) {
    state.peaks.push_back(r.peak);
    state.peak_increments.push_back(r.peak_increment);
  }
  return state;
}

template <int dim>
void Results<dim>::accept(int increment, const Body<dim>& body) {
  const auto timer = profile_.measure(base::Phase::write);
  const GlobalId broken = body.counts().broken_bonds;
  const bool new_breaks = broken > broken_before_;
  if (first_break_ == 0 && new_breaks) first_break_ = increment;
  total_solves_ += body.counts().linear_solves;
  total_iterations_ += body.counts().cg_iterations;
  measure_reactions(increment, body);
  overlap_ = body.overlap();
  const auto values = globals(body);
  if (increment % output_every_ == 0 || new_breaks || increment == last_increment_) write_fields(body, values);
  if (exports_) exports_->accept(increment, body);
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    std::vector<double> row = {static_cast<double>(increment)};
    row.insert(row.end(), values.begin(), values.end());
    history_->write(row);
    show_line(increment, body);
    warn_of_overlap();
  });
  broken_before_ = broken;
  if (increment > 1) pace_.add(profile_.elapsed() - seconds_before_);
  seconds_before_ = last_word_ = profile_.elapsed();
}

/// In the order of the columns of history.csv after "increment". Collective.
template <int dim>
std::vector<double> Results<dim>::globals(const Body<dim>& body) const {
  const auto& counts = body.counts();
  const Energies energies = body.energies();
  std::vector<double> values = {body.load_factor(),
                                static_cast<double>(counts.broken_bonds),
                                static_cast<double>(counts.damaged_elements),
                                static_cast<double>(counts.dgfe_elements),
                                static_cast<double>(counts.unknowns),
                                static_cast<double>(counts.linear_solves),
                                static_cast<double>(counts.cg_iterations),
                                seconds(),
                                energies.elastic,
                                energies.dissipated,
                                energies.external_work,
                                energies.external_work - energies.elastic - energies.dissipated,
                                overlap_.depth};
  for (const auto& r : reactions_) values.push_back(r.force);
  for (const auto& r : reactions_) values.push_back(r.displacement);
  return values;
}

template <int dim>
void Results<dim>::measure_reactions(int increment, const Body<dim>& body) {
  std::vector<double> sums;  // force, displacement and number of nodes, for each column
  for (const auto& r : reactions_) {
    double force = 0., displacement = 0., count = 0.;
    for (const int n : own_nodes_in(body, body.mesh().node_sets.at(r.group))) {
      force += body.reaction(n)[r.component];
      displacement += body.displacement()[n * dim + r.component];
      count += 1.;
    }
    sums.insert(sums.end(), {force, displacement, count});
  }
  base::sum(*comm_, sums);
  for (std::size_t i = 0; i < reactions_.size(); ++i) {
    auto& r = reactions_[i];
    r.force = sums[3 * i];
    r.displacement = sums[3 * i + 1] / std::max(sums[3 * i + 2], 1.);
    if (std::abs(r.force) <= std::abs(r.peak)) continue;
    r.peak = r.force;
    r.peak_increment = increment;
  }
}

template <int dim>
void Results<dim>::show_line(int increment, const Body<dim>& body) {
  if (voice_.shows_progress) fmt::print("\r\033[K");
  if (!has_shown_a_line_ && !reactions_.empty()) {  // the one to follow: the largest at first
    const auto largest = std::max_element(reactions_.begin(), reactions_.end(), [](const auto& a, const auto& b) {
      return std::abs(a.force) < std::abs(b.force);
    });
    shown_reaction_ = static_cast<int>(largest - reactions_.begin());
  }
  const std::string shown = reactions_.empty() ? "" : reactions_[shown_reaction_].column;
  if (!has_shown_a_line_) {
    voice_.log->info("{:>6} {:>9} {:>22} {:>12} {:>12} {:>8} {:>10} {:>7} {:>6} {:>9}", "step", "load",
                     "reaction " + shown, "new broken", "all broken", "DGFE", "unknowns", "solves", "its", "seconds");
  }
  has_shown_a_line_ = true;
  const auto& counts = body.counts();
  voice_.log->info("{:>6} {:>9.4g} {:>22.6g} {:>12} {:>12} {:>8} {:>10} {:>7} {:>6} {:>9.2f}", increment,
                   body.load_factor(), reactions_.empty() ? 0. : reactions_[shown_reaction_].force,
                   counts.broken_bonds - broken_before_, counts.broken_bonds, counts.dgfe_elements, counts.unknowns,
                   counts.linear_solves, counts.cg_iterations, profile_.elapsed() - seconds_before_);
}

/// Once, as soon as it is more than the solver's tolerance can be.
template <int dim>
void Results<dim>::warn_of_overlap() {
  constexpr double of_horizon = 1e-3;
  if (has_warned_ || overlap_.depth <= of_horizon * horizon_) return;
  has_warned_ = true;
  voice_.log->warn(
      "warning: crack faces overlap, by {:.3g} at ({:.6g}): there is no contact; see overlap in history.csv",
      overlap_.depth, fmt::join(overlap_.place.begin(), overlap_.place.end(), ", "));
}

template <int dim>
void Results<dim>::show_progress(int increment, const Body<dim>& body) {
  constexpr double patience = 60.;  // seconds without a word
  if (profile_.elapsed() - last_word_ > patience) {
    last_word_ = profile_.elapsed();
    voice_.log->info("       in step {}: {} solves, {} broken bonds, {} discontinuous elements, {:.0f} s", increment,
                     body.counts().linear_solves, body.counts().broken_bonds, body.counts().dgfe_elements,
                     profile_.elapsed());
  }
  if (!voice_.shows_progress) return;
  constexpr int width = 30;
  const int done = width * (increment - 1) / last_increment_;
  const double left = pace_.left(last_increment_ - increment + 1, profile_.elapsed() - seconds_before_);
  fmt::print("\r\033[K[{:=>{}}{:>{}}] step {}/{}: {} solves, {} broken bonds{}", ">", done + 1, "", width - done,
             increment, last_increment_, body.counts().linear_solves, body.counts().broken_bonds,
             increment > 2 ? fmt::format(", at this pace {} left", base::duration(left)) : "");
  std::fflush(stdout);
}

template <int dim>
void Results<dim>::summarize(const Body<dim>& body) {
  if (voice_.shows_progress) fmt::print("\r\033[K");
  const auto& counts = body.counts();
  voice_.log->info("");
  voice_.log->info("broken bonds     {}{}", counts.broken_bonds,
                   first_break_ > 0 ? fmt::format(", the first in step {}", first_break_) : "");
  voice_.log->info("damaged elements {}, discontinuous {}", counts.damaged_elements, counts.dgfe_elements);
  voice_.log->info("linear solves    {} with {} iterations; {} topologies", total_solves_, total_iterations_,
                   counts.topologies);
  const double memory = base::peak_memory();
  voice_.log->info("memory           {:.0f} MB in all, {:.0f} MB on the rank with most",
                   base::sum(*comm_, memory) / 1e6, base::max(*comm_, memory) / 1e6);
  for (const auto& r : reactions_) {
    if (std::abs(r.peak) > 0.) {
      voice_.log->info("reaction {:<24} peak {:>12.6g} in step {}, last {:>12.6g}", r.column, r.peak, r.peak_increment,
                       r.force);
    }
  }
  voice_.log->info("\n{}", profile_.table());
}

template <int dim>
void Results<dim>::start_file(const Body<dim>& body, const std::vector<mesh::Side>& broken_surface) {
  const auto own = own_elements(body);
  const auto keys = all_keys(*comm_, own);
  const auto sides = side_sets(body.mesh(), broken_surface);
  const auto model = is_spread_ ? own_part(body, own, keys, sides) : gathered(body, own, keys, sides);
  const bool is_first = first_file_is_new_;
  first_file_is_new_ = false;
  base::on_all_ranks(*comm_, [&] {
    if (is_first && comm_->getRank() == 0) series_->remove_the_rest();
  });
  base::on_all_ranks(*comm_, [&] {
    if (series_) series_->start(model);
  });
}

/// The whole body, on rank 0. Collective.
template <int dim>
io::ExodusModel<dim> Results<dim>::gathered(const Body<dim>& body, const std::vector<ElementRecord>& own,
                                            const std::set<BlockKey>& keys, const SideSets& side_sets) {
  io::ExodusModel<dim> model;
  model.coordinates = gather_points<dim>(*comm_, own_coordinates(body));
  const auto records = base::gather_on_root(*comm_, own);
  if (comm_->getRank() == 0) element_place_ = sort_into_blocks(records, keys, body.mesh().block_names, model);
  std::map<GlobalId, int> place_of;
  for (std::size_t i = 0; i < records.size(); ++i) place_of[records[i].id] = element_place_[i];
  gather_groups(*comm_, body, side_sets, place_of, model);
  return model;
}

/// This rank's elements with all their nodes. Local.
template <int dim>
io::ExodusModel<dim> Results<dim>::own_part(const Body<dim>& body, std::vector<ElementRecord> own,
                                            const std::set<BlockKey>& keys, const SideSets& side_sets) {
  io::ExodusModel<dim> model;
  const auto& dofs = body.model().dofs;
  spread_nodes_ = nodes_of_own_elements(body);
  for (const int node : spread_nodes_) {
    model.coordinates.push_back(body.mesh().coordinates[dofs.reference_node(node)]);
    model.node_ids.push_back(dofs.global_node(node));
  }
  for (auto& record : own) {
    for (int k = 0; k < mesh::n_corners(record.type); ++k) {
      const auto found = std::lower_bound(model.node_ids.begin(), model.node_ids.end(), record.nodes[k]);
      record.nodes[k] = found - model.node_ids.begin();
    }
  }
  element_place_ = sort_into_blocks(own, keys, body.mesh().block_names, model);
  take_own_groups(body, side_sets, spread_nodes_, element_place_, model);
  return model;
}

template <int dim>
void Results<dim>::write_fields(const Body<dim>& body, const std::vector<double>& global_values) {
  const auto model = body.model();
  const auto surface = bonds::broken_surface(body.mesh(), model.bonds);
  const GlobalId n_broken_sides = base::sum(*comm_, static_cast<GlobalId>(surface.size()));  // it only grows
  if (topology_written_ != body.counts().topologies || broken_sides_written_ != n_broken_sides) {
    start_file(body, surface);
  }
  topology_written_ = body.counts().topologies;
  broken_sides_written_ = n_broken_sides;

  io::ExodusStep step{body.load_factor(), global_values, {}, {}};
  for (int c = 0; c < dim; ++c) step.nodal.push_back(nodal_in_file_order(body, c));
  const auto fields = operators::element_fields(model, body.displacement(), body.system().displacement_at_points());
  std::vector<std::vector<double>> own(4 + stress_names<dim>().size());
  for (int e = 0; e < body.mesh().n_owned_elements; ++e) {
    double alpha = 0., damage = 0.;
    for (int p = model.points.first(e); p < model.points.first(e + 1); ++p) {
      alpha += model.alpha(p) / model.points.count(e);
      damage += model.bonds.damage(p) / model.points.count(e);
    }
    own[0].push_back(alpha);
    own[1].push_back(damage);
    own[2].push_back(kind(body, e));
    own[3].push_back(fields.energy[e]);
    for (int v = 0; v < base::n_voigt<dim>; ++v) own[4 + v].push_back(fields.stress[e][v]);
  }
  for (const auto& values : own) step.element.push_back(in_file_order(values));
  base::on_all_ranks(*comm_, [&] {
    if (series_) series_->write(step);
  });
}

/// A component of the displacement: of all nodes on rank 0, or of a spread file's.
template <int dim>
std::vector<double> Results<dim>::nodal_in_file_order(const Body<dim>& body, int component) const {
  const auto u = body.displacement();
  std::vector<double> own;
  if (is_spread_) {
    for (const int n : spread_nodes_) own.push_back(u[n * dim + component]);
    return own;
  }
  for (int n = 0; n < body.model().dofs.n_owned_nodes(); ++n) own.push_back(u[n * dim + component]);
  return base::gather_on_root(*comm_, own);
}

template <int dim>
std::vector<double> Results<dim>::in_file_order(const std::vector<double>& own_elements) const {
  const auto values = is_spread_ ? own_elements : base::gather_on_root(*comm_, own_elements);
  std::vector<double> ordered(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) ordered[element_place_[i]] = values[i];
  return ordered;
}

template class Results<2>;
template class Results<3>;

}  // namespace perimorph::fracture
