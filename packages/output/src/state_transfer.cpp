#include "perimorph/output/state_transfer.hpp"

#include <Teuchos_DefaultSerialComm.hpp>
#include <algorithm>

#include "data_sets.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::output {

using base::GlobalId;
using discretization::BrokenBond;
using discretization::FlagPoint;
using discretization::SavedState;
using discretization::SoftBond;

namespace {

constexpr const char *displacement_name = "displacement", *starts_name = "starts";

/// All but displacements, which each rank has a part of.
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
  sets.records("broken_bonds", state.broken, &BrokenBond::first, &BrokenBond::second, &BrokenBond::call);
  sets.records("softened_bonds", state.softened, &SoftBond::first, &SoftBond::second);
  sets.arrays("largest_stretches", state.softened, &SoftBond::largest_stretches);
  using Slip = typename decltype(state.slips)::value_type;
  sets.records("slips", state.slips, &Slip::first, &Slip::second);
  sets.arrays("slips_and_friction", state.slips, &Slip::values);
}

/// Values of elements by their ids.
std::vector<double> in_order(const std::vector<double>& values, const std::vector<GlobalId>& ids, std::size_t stride) {
  std::vector<double> ordered(values.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    std::copy_n(values.begin() + static_cast<long>(i * stride), stride,
                ordered.begin() + ids[i] * static_cast<long>(stride));
  }
  return ordered;
}

/// Every rank's elements' values out of those of all elements, which rank 0 has. Collective.
std::vector<double> fetch(const base::Comm& comm, const std::vector<GlobalId>& elements, std::size_t stride,
                          const std::vector<double>& all) {
  std::vector<std::vector<GlobalId>> asked(comm.getSize());
  asked[0] = elements;
  std::vector<std::vector<double>> answers(comm.getSize());
  const auto questions = base::exchange(comm, asked);
  for (std::size_t rank = 0; rank < questions.size(); ++rank) {
    for (const GlobalId element : questions[rank]) {
      PERIMORPH_DEBUG_ASSERT((element + 1) * static_cast<GlobalId>(stride) <= static_cast<GlobalId>(all.size()),
                             "element {} of {} values, {} each", element, all.size(), stride);
      const auto values = all.begin() + element * static_cast<GlobalId>(stride);
      answers[rank].insert(answers[rank].end(), values, values + static_cast<GlobalId>(stride));
    }
  }
  return base::exchange(comm, answers)[0];
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

}  // namespace

template <int dim>
std::vector<FlagPoint<dim>> share_flag_points(const base::Comm& comm, const io::Checkpoint& gathered) {
  SavedState<dim> state;
  DataSetReader reader(comm, gathered);
  describe(reader, state, FlagPoint<dim>{});
  return state.flag_points;
}

template <int dim>
io::Checkpoint refine_state(const io::Checkpoint& gathered, const std::vector<mesh::Descent>& descents) {
  const Teuchos::SerialComm<int> alone;
  SavedState<dim> state;
  DataSetReader reader(alone, gathered);
  describe(reader, state, FlagPoint<dim>{});
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
  for (const char* name : {displacement_name, starts_name}) {
    const auto found = gathered.numbers.find(name);
    if (found != gathered.numbers.end()) finer.numbers[name] = interpolated<dim>(found->second, descents);
  }
  return finer;
}

template <int dim>
std::vector<GlobalId> owned_ids(const mesh::Mesh<dim>& mesh) {
  return {mesh.element_ids.begin(), mesh.element_ids.begin() + mesh.n_owned_elements};
}

template <int dim>
io::Checkpoint gather_state(const base::Comm& comm, const SavedState<dim>& state,
                            const std::vector<GlobalId>& owned_elements) {
  constexpr auto stride = static_cast<std::size_t>(SavedState<dim>::values_per_element);
  SavedState<dim> whole = state;
  whole.broken = base::gather_on_root(comm, state.broken);
  whole.softened = base::gather_on_root(comm, state.softened);
  whole.slips = base::gather_on_root(comm, state.slips);
  const auto ids = base::gather_on_root(comm, owned_elements);
  const auto displacement = base::gather_on_root(comm, state.displacement);
  const auto starts = base::gather_on_root(comm, state.starts);
  io::Checkpoint checkpoint;
  if (comm.getRank() != 0) return checkpoint;

  DataSetWriter writer(checkpoint);
  describe(writer, whole, FlagPoint<dim>{});
  checkpoint.numbers[displacement_name] = in_order(displacement, ids, stride);
  if (!starts.empty()) checkpoint.numbers[starts_name] = in_order(starts, ids, stride);
  return checkpoint;
}

template <int dim>
io::Checkpoint gather_state(const base::Comm& comm, const fracture::Body<dim>& body) {
  return gather_state(comm, body.save(), owned_ids(body.mesh()));
}

template <int dim>
SavedState<dim> share_state(const base::Comm& comm, const io::Checkpoint& gathered, const mesh::Mesh<dim>& mesh) {
  SavedState<dim> state;
  DataSetReader reader(comm, gathered);
  describe(reader, state, FlagPoint<dim>{});
  const std::vector<GlobalId> elements(mesh.element_ids.begin(), mesh.element_ids.begin() + mesh.n_real_elements());
  const auto share = [&](const char* name) {
    const auto all = comm.getRank() == 0 ? gathered.numbers.at(name) : std::vector<double>();
    return fetch(comm, elements, SavedState<dim>::values_per_element, all);
  };
  state.displacement = share(displacement_name);
  if (base::max(comm, static_cast<GlobalId>(gathered.numbers.count(starts_name))) > 0)
    state.starts = share(starts_name);
  return state;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                               \
  template std::vector<GlobalId> owned_ids(const mesh::Mesh<dim>&);                                              \
  template io::Checkpoint gather_state(const base::Comm&, const SavedState<dim>&, const std::vector<GlobalId>&); \
  template io::Checkpoint gather_state(const base::Comm&, const fracture::Body<dim>&);                           \
  template std::vector<FlagPoint<dim>> share_flag_points(const base::Comm&, const io::Checkpoint&);              \
  template io::Checkpoint refine_state<dim>(const io::Checkpoint&, const std::vector<mesh::Descent>&);           \
  template SavedState<dim> share_state(const base::Comm&, const io::Checkpoint&, const mesh::Mesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::output
