#include "perimorph/output/state_transfer.hpp"

#include <Teuchos_DefaultSerialComm.hpp>
#include <algorithm>

#include "data_sets.hpp"
#include "perimorph/base/errors.hpp"
#include "row_exchange.hpp"

namespace perimorph::output {

using base::GlobalId;
using discretization::BrokenBond;
using discretization::FlagPoint;
using discretization::SavedState;
using discretization::SoftBond;

namespace {

constexpr const char *displacement_name = "displacement", *starts_name = "starts";

/// All that is alike on all ranks.
template <class DataSets, class State, class Flag>
void describe(DataSets& sets, State& state, Flag /*type of flag points*/) {
  auto& counts = state.counts;
  sets.numbers("body", state.load_factor, state.load_step, state.force_scale, state.energies.dissipated,
               state.energies.external_work, state.energies.friction);
  sets.integers("body_counts", counts.broken_bonds, counts.damaged_elements, counts.dgfe_elements, counts.unknowns,
                counts.linear_solves, counts.cg_iterations, counts.topologies, state.break_calls,
                state.break_calls_before_topology);
  sets.records("flagged_elements", state.flag_points, &Flag::element, &Flag::growth);
  sets.arrays("flag_points", state.flag_points, &Flag::centroid);
}

/// Bonds, of which each rank has some.
template <class RowSets, class State>
void describe_bonds(RowSets& sets, State& state) {
  sets.records("broken_bonds", state.broken, &BrokenBond::first, &BrokenBond::second, &BrokenBond::call);
  sets.records("softened_bonds", state.softened, &SoftBond::first, &SoftBond::second);
  sets.arrays("largest_stretches", state.softened, &SoftBond::largest_stretches);
  using Slip = typename decltype(state.slips)::value_type;
  sets.records("slips", state.slips, &Slip::first, &Slip::second);
  sets.arrays("slips_and_friction", state.slips, &Slip::values);
}

/// A state of which rank 0 has all, and the others nothing. Collective.
io::Checkpoint gathered(const base::Comm& comm, const io::Checkpoint& sliced) {
  io::Checkpoint whole = sliced;
  for (auto& entry : whole.number_rows) entry.second.values = base::gather_on_root(comm, entry.second.values);
  for (auto& entry : whole.integer_rows) entry.second.values = base::gather_on_root(comm, entry.second.values);
  return whole;
}

/// Values at the corners of elements, on a finer mesh.
template <int dim>
std::vector<double> interpolated(const std::vector<double>& values, const std::vector<mesh::Descent>& descents) {
  constexpr auto stride = static_cast<std::size_t>(SavedState<dim>::values_per_element);
  std::vector<double> finer(descents.size() * stride, 0.);
  for (std::size_t e = 0; e < descents.size(); ++e) {
    const auto& [ancestor, weights] = descents[e];
    const double* from = values.data() + static_cast<std::size_t>(ancestor) * stride;
    double* to = finer.data() + e * stride;
    if (weights.empty()) std::copy_n(from, stride, to);
    for (std::size_t k = 0; k < weights.size(); ++k) {
      for (std::size_t l = 0; l < weights[k].size(); ++l) {
        for (std::size_t c = 0; c < dim; ++c) to[k * dim + c] += weights[k][l] * from[l * dim + c];
      }
    }
  }
  return finer;
}

/// The elements that are in both meshes, by their ids in the coarser one; -1 for those that are divided.
std::vector<GlobalId> undivided(const std::vector<mesh::Descent>& descents) {
  std::vector<GlobalId> ids;
  for (std::size_t e = 0; e < descents.size(); ++e) {
    const auto ancestor = static_cast<std::size_t>(descents[e].ancestor);
    ids.resize(std::max(ids.size(), ancestor + 1), -1);
    if (descents[e].weights.empty()) ids[ancestor] = static_cast<GlobalId>(e);
  }
  return ids;
}

/// On rank 0, which has all of the state.
template <int dim>
io::Checkpoint refined(const io::Checkpoint& whole, const std::vector<mesh::Descent>& descents) {
  const Teuchos::SerialComm<int> alone;
  SavedState<dim> state;
  DataSetReader reader(alone, whole);
  describe(reader, state, FlagPoint<dim>{});
  RowReader row_reader(whole);
  describe_bonds(row_reader, state);
  const auto ids = undivided(descents);
  const auto n_before = static_cast<GlobalId>(ids.size()), n_after = static_cast<GlobalId>(descents.size());
  const auto follow = [&](GlobalId& element) {
    const GlobalId found = ids[element % n_before], images = element / n_before;  // mesh/images.hpp
    PERIMORPH_ASSERT(found >= 0, "an element with {} broken bonds is divided", state.broken.size());
    element = images * n_after + found;
  };
  const auto follow_points = [&](auto& records) {
    constexpr int n = elements::max_points;
    for (auto& record : records) {
      for (GlobalId* point : {&record.first, &record.second}) {
        GlobalId element = *point / n;
        follow(element);
        *point = element * n + *point % n;
      }
    }
  };
  for (auto& flag : state.flag_points) follow(flag.element);
  follow_points(state.broken);
  follow_points(state.softened);
  follow_points(state.slips);
  io::Checkpoint finer;
  DataSetWriter writer(finer);
  describe(writer, state, FlagPoint<dim>{});
  RowWriter row_writer(finer);
  describe_bonds(row_writer, state);
  for (const auto& [name, rows] : whole.number_rows) {
    const bool is_of_elements = name == displacement_name || name == starts_name;
    if (is_of_elements) finer.number_rows[name] = {rows.width, interpolated<dim>(rows.values, descents)};
  }
  return finer;
}

}  // namespace

template <int dim>
std::vector<FlagPoint<dim>> share_flag_points(const base::Comm& comm, const io::Checkpoint& sliced) {
  SavedState<dim> state;
  DataSetReader reader(comm, sliced);
  describe(reader, state, FlagPoint<dim>{});
  return state.flag_points;
}

template <int dim>
io::Checkpoint refine_state(const base::Comm& comm, const io::Checkpoint& sliced,
                            const std::vector<mesh::Descent>& descents) {
  io::Checkpoint state = gathered(comm, sliced);  // as the refined mesh is whole on rank 0
  base::on_all_ranks(comm, [&] {
    if (comm.getRank() == 0) state = refined<dim>(state, descents);
  });
  return state;
}

template <int dim>
std::vector<GlobalId> owned_ids(const mesh::Mesh<dim>& mesh) {
  return {mesh.element_ids.begin(), mesh.element_ids.begin() + mesh.n_owned_elements};
}

template <int dim>
io::Checkpoint slice_state(const base::Comm& comm, const SavedState<dim>& state,
                           const std::vector<GlobalId>& owned_elements) {
  constexpr auto width = static_cast<std::size_t>(SavedState<dim>::values_per_element);
  io::Checkpoint checkpoint;
  DataSetWriter writer(checkpoint);
  if (comm.getRank() == 0) describe(writer, state, FlagPoint<dim>{});

  SavedState<dim> slice;
  slice.broken = sorted_among_ranks(comm, state.broken);
  slice.softened = sorted_among_ranks(comm, state.softened);
  slice.slips = sorted_among_ranks(comm, state.slips);
  RowWriter row_writer(checkpoint);
  describe_bonds(row_writer, slice);

  const auto n_elements = base::sum(comm, static_cast<GlobalId>(owned_elements.size()));
  const auto holders = base::Slices::even(comm, n_elements);
  const auto write = [&](const char* name, const std::vector<double>& values) {
    checkpoint.number_rows[name] = {width, rows_to_holders(comm, holders, owned_elements, width, values)};
  };
  write(displacement_name, state.displacement);
  if (base::max(comm, static_cast<GlobalId>(!state.starts.empty())) > 0) write(starts_name, state.starts);
  return checkpoint;
}

template <int dim>
io::Checkpoint slice_state(const base::Comm& comm, const fracture::Body<dim>& body) {
  return slice_state(comm, body.save(), owned_ids(body.mesh()));
}

template <int dim>
SavedState<dim> share_state(const base::Comm& comm, const io::Checkpoint& sliced, const mesh::Mesh<dim>& mesh) {
  SavedState<dim> state, slice;
  DataSetReader reader(comm, sliced);
  describe(reader, state, FlagPoint<dim>{});
  RowReader row_reader(sliced);
  describe_bonds(row_reader, slice);

  const auto& displacement = sliced.number_rows.at(displacement_name);
  const RowExchange rows(comm, base::Slices::of(comm, displacement.n_rows()),
                         {mesh.element_ids.begin(), mesh.element_ids.begin() + mesh.n_real_elements()});
  state.displacement = rows.fetch(displacement.width, displacement.values);
  const auto starts = sliced.number_rows.find(starts_name);  // on all ranks or none
  if (starts != sliced.number_rows.end()) state.starts = rows.fetch(starts->second.width, starts->second.values);
  state.broken = rows.select(slice.broken);
  state.softened = rows.select(slice.softened);
  state.slips = rows.select(slice.slips);
  return state;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                              \
  template std::vector<GlobalId> owned_ids(const mesh::Mesh<dim>&);                                             \
  template io::Checkpoint slice_state(const base::Comm&, const SavedState<dim>&, const std::vector<GlobalId>&); \
  template io::Checkpoint slice_state(const base::Comm&, const fracture::Body<dim>&);                           \
  template std::vector<FlagPoint<dim>> share_flag_points(const base::Comm&, const io::Checkpoint&);             \
  template io::Checkpoint refine_state<dim>(const base::Comm&, const io::Checkpoint&,                           \
                                            const std::vector<mesh::Descent>&);                                 \
  template SavedState<dim> share_state(const base::Comm&, const io::Checkpoint&, const mesh::Mesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::output
