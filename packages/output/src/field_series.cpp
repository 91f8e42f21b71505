#include "perimorph/output/field_series.hpp"

#include <filesystem>
#include <functional>

#include "component_names.hpp"
#include "file_layout.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/bonds/crack.hpp"
#include "perimorph/operators/fields.hpp"

namespace perimorph::output {

using base::GlobalId;
using fracture::Body;

namespace {

/// What element variables are made of.
template <int dim>
struct View {
  const Body<dim>& body;
  operators::CoupledModel<dim> model;
  operators::ElementFields<dim> fields;
};

template <int dim>
struct ElementVariable {
  std::string name;
  std::function<double(const View<dim>&, int element)> value;
};

/// The mean over an element's material points.
template <int dim, class Value>
double mean_over_points(const operators::CoupledModel<dim>& model, int element, Value value) {
  double mean = 0.;
  for (int p = model.points.first(element); p < model.points.first(element + 1); ++p) {
    mean += value(p) / model.points.count(element);
  }
  return mean;
}

template <int dim>
std::vector<ElementVariable<dim>> element_variables(bool has_eigenstrain) {
  using V = const View<dim>&;
  std::vector<ElementVariable<dim>> variables = {
      {"alpha", [](V v, int e) { return mean_over_points(v.model, e, [&](int p) { return v.model.alpha(p); }); }},
      {"damage",
       [](V v, int e) { return mean_over_points(v.model, e, [&](int p) { return v.model.bonds.damage(p); }); }},
      {"class", [](V v, int e) { return static_cast<double>(kind_of(v.body, e)); }},
      {"energy", [](V v, int e) { return v.body.problem().thickness * v.fields.energy[e]; }},
  };
  for (int c = 0; c < base::n_voigt<dim>; ++c) {
    variables.push_back({stress_names<dim>()[c], [c](V v, int e) { return v.fields.stress[e][c]; }});
  }
  if (has_eigenstrain) {
    variables.push_back({"eigenstrain", [](V v, int e) {
                           const auto& at_points = v.body.system().eigenstrain().at_points();
                           return mean_over_points(v.model, e, [&](int p) { return at_points[p]; });
                         }});
  }
  return variables;
}

template <int dim>
typename io::ExodusSeries<dim>::Names variable_names(const SeriesOptions& options) {
  typename io::ExodusSeries<dim>::Names names{options.globals, {}, {}};
  for (int c = 0; c < dim; ++c) names.nodal.push_back(std::string("displacement_") + axis_names[c]);
  for (const auto& variable : element_variables<dim>(options.has_eigenstrain)) {
    names.element.push_back(variable.name);
  }
  return names;
}

}  // namespace

template <int dim>
FieldSeries<dim>::FieldSeries(const Teuchos::RCP<const base::Comm>& comm, SeriesOptions options,
                              const io::SeriesExtent& earlier, std::vector<io::FileExtent> earlier_files)
    : comm_(comm),
      is_spread_(options.is_spread),
      has_eigenstrain_(options.has_eigenstrain),
      files_(std::move(earlier_files)),
      n_closed_files_(files_.size()) {
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0 && !is_spread_) return;
    std::optional<io::SpreadPart> part;
    if (is_spread_) part = io::SpreadPart{comm_->getRank(), comm_->getSize()};
    series_ = std::make_unique<io::ExodusSeries<dim>>(options.file, options.title, variable_names<dim>(options),
                                                      options.information, part);
    series_->resume(earlier);
    if (comm_->getRank() == 0) series_->remove_the_rest();
  });
}

template <int dim>
void FieldSeries<dim>::bring_to_disk() {
  base::on_all_ranks(*comm_, [&] {
    if (series_) series_->bring_to_disk();
  });
}

/// Of the files that are being written.
template <int dim>
void FieldSeries<dim>::note_sizes() {
  std::vector<GlobalId> own;
  base::on_all_ranks(*comm_, [&] {
    if (series_) own.push_back(series_->current_size());
  });
  const auto sizes = base::gather_on_root(*comm_, own);
  files_.resize(n_closed_files_);
  for (std::size_t rank = 0; rank < sizes.size(); ++rank) {
    const std::filesystem::path file = series_->file(series_->extent().files, static_cast<int>(rank));
    files_.push_back({file.filename(), sizes[rank]});
  }
}

template <int dim>
void FieldSeries<dim>::start_file(const Body<dim>& body, const std::vector<mesh::Side>& broken_surface) {
  auto layout =
      is_spread_ ? spread_layout(*comm_, body, broken_surface) : gathered_layout(*comm_, body, broken_surface);
  nodes_ = std::move(layout.nodes);
  element_place_ = std::move(layout.element_place);
  n_closed_files_ = files_.size();
  base::on_all_ranks(*comm_, [&] {
    if (series_) series_->start(layout.model);
  });
}

template <int dim>
void FieldSeries<dim>::write(int increment, const Body<dim>& body, std::vector<double> globals) {
  const auto surface = bonds::broken_surface(body.mesh(), body.topology().bonds());
  const GlobalId n_broken_sides = base::sum(*comm_, static_cast<GlobalId>(surface.size()));  // it only grows
  if (topology_written_ != body.counts().topologies || broken_sides_written_ != n_broken_sides) {
    start_file(body, surface);
  }
  topology_written_ = body.counts().topologies;
  broken_sides_written_ = n_broken_sides;

  io::ExodusStep step{static_cast<double>(increment), std::move(globals), {}, {}};
  for (int c = 0; c < dim; ++c) step.nodal.push_back(on_nodes(body, c));
  const View<dim> view{body, body.model(),
                       operators::element_fields(body.model(), body.displacement(), body.system().at_points())};
  for (const auto& variable : element_variables<dim>(has_eigenstrain_)) {
    std::vector<double> own;
    for (int e = 0; e < body.mesh().n_owned_elements; ++e) own.push_back(variable.value(view, e));
    step.element.push_back(on_elements(own));
  }
  base::on_all_ranks(*comm_, [&] {
    if (series_) series_->write(step);
  });
  note_sizes();
}

/// A component of the displacement in the order of the file's nodes, on ranks that write.
template <int dim>
std::vector<double> FieldSeries<dim>::on_nodes(const Body<dim>& body, int component) const {
  std::vector<double> own;
  for (const int n : nodes_) own.push_back(body.displacement()[n * dim + component]);
  return is_spread_ ? own : base::gather_on_root(*comm_, own);
}

template <int dim>
std::vector<double> FieldSeries<dim>::on_elements(const std::vector<double>& own) const {
  const auto values = is_spread_ ? own : base::gather_on_root(*comm_, own);
  PERIMORPH_ASSERT(values.size() == element_place_.size(), "{} values for {} elements", values.size(),
                   element_place_.size());
  std::vector<double> ordered(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) ordered[element_place_[i]] = values[i];
  return ordered;
}

template class FieldSeries<2>;
template class FieldSeries<3>;

}  // namespace perimorph::output
