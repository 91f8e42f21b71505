#include "perimorph/output/results.hpp"

#include <Teuchos_XMLParameterListHelpers.hpp>
#include <algorithm>
#include <filesystem>
#include <sstream>

#include "open_table.hpp"

namespace perimorph::output {

using base::GlobalId;
using fracture::Body;

namespace {

/// A parameter list as lines of XML.
std::vector<std::string> lines_of(const Teuchos::ParameterList& list) {
  std::stringstream text;
  Teuchos::writeParameterListToXmlOStream(list, text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> names_of(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  for (const auto& column : columns) names.push_back(column.name);
  return names;
}

/// As they were at the end of an earlier run, if there was one.
template <int dim>
std::vector<Reaction> reactions_after(const cases::Case& input, const std::optional<ResultsState>& earlier) {
  auto reactions = reactions_of<dim>(input.output.reactions, input.boundary_conditions.rigid_groups);
  for (std::size_t i = 0; earlier && i < reactions.size(); ++i) {
    reactions[i].peak = earlier->peaks.at(i);
    reactions[i].peak_increment = static_cast<int>(earlier->peak_increments.at(i));
  }
  return reactions;
}

}  // namespace

std::string unfinished_file(const std::string& folder, const std::string& case_name) {
  return (std::filesystem::path(folder) / "unfinished" / (case_name + ".e")).string();
}

template <int dim>
Results<dim>::Results(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& folder,
                      ConsoleOptions console, base::Profile& profile, const std::optional<ResultsState>& earlier)
    : comm_(comm),
      profile_(profile),
      folder_(folder),
      earlier_seconds_(earlier ? earlier->seconds_before : 0.),
      output_every_(input.output.every),
      last_increment_(input.loading.increments),
      totals_(earlier ? earlier->totals : Totals{}),
      reactions_(reactions_after<dim>(input, earlier)),
      columns_(history_columns(reactions_, input.loading.control == cases::Control::measure,
                               input.peridynamics.friction > 0.)),
      unfinished_{unfinished_file(folder, input.name),
                  input.title,
                  names_of(columns_),
                  lines_of(input.resolved),
                  input.output.spread_files,
                  !input.boundary_conditions.temperatures.empty()},
      console_(std::move(console), profile, last_increment_, input.peridynamics.horizon,
               earlier ? earlier->seconds - earlier->seconds_before : 0.) {
  SeriesOptions series = unfinished_;
  series.file = (std::filesystem::path(folder) / (input.name + ".e")).string();
  fields_ = std::make_unique<FieldSeries<dim>>(comm, std::move(series), earlier ? earlier->series : io::SeriesExtent{},
                                               earlier ? earlier->fields : std::vector<io::FileExtent>{});
  base::on_all_ranks(*comm, [&] {
    if (comm_->getRank() != 0) return;
    std::vector<std::string> columns = names_of(columns_);
    columns.insert(columns.begin(), "increment");
    history_ = open_table(folder, "history.csv", columns, earlier);
    remove_unfinished();
  });
}

/// What an earlier run has left of an increment, on rank 0.
template <int dim>
void Results<dim>::remove_unfinished() const {
  io::ExodusSeries<dim>(unfinished_.file, "", {}, {}).remove_the_rest();
  std::error_code not_empty;
  std::filesystem::remove(std::filesystem::path(unfinished_.file).parent_path(), not_empty);
}

template <int dim>
ResultsState Results<dim>::state() const {
  ResultsState state{seconds(), earlier_seconds_, fields_->extent(), totals_, {}, {}, {}, fields_->files(), {}};
  if (history_) state.tables.push_back(history_->extent());
  if (exports_) exports_->note_files(state);
  for (const auto& r : reactions_) {
    state.peaks.push_back(r.peak);
    state.peak_increments.push_back(r.peak_increment);
  }
  return state;
}

/// Adds an increment to the totals; returns how many bonds broke in it.
template <int dim>
GlobalId Results<dim>::count(int increment, const discretization::Counts& counts) {
  const GlobalId newly_broken = counts.broken_bonds - totals_.broken;
  if (totals_.first_break == 0 && newly_broken > 0) totals_.first_break = increment;
  totals_.broken = counts.broken_bonds;
  totals_.solves += counts.linear_solves;
  totals_.iterations += counts.cg_iterations;
  return newly_broken;
}

/// Collective.
template <int dim>
IncrementRecord Results<dim>::record_of(int increment, const Body<dim>& body) {
  measure(*comm_, increment, body, reactions_);
  const auto overlap = body.overlap();
  return {increment,
          body.load_factor(),
          body.counts(),
          body.energies(),
          seconds(),
          overlap.depth,
          {overlap.place.begin(), overlap.place.end()},
          reactions_,
          body.measured()};
}

template <int dim>
std::vector<double> Results<dim>::values_of(const IncrementRecord& record) const {
  std::vector<double> values;
  for (const auto& column : columns_) values.push_back(column.value(record));
  return values;
}

template <int dim>
void Results<dim>::accept(const fracture::LoopPosition& position, const Body<dim>& body) {
  const auto timer = profile_.measure(base::Phase::write);
  const int increment = position.increment;
  const GlobalId newly_broken = count(increment, body.counts());
  const auto record = record_of(increment, body);
  const auto values = values_of(record);
  if (increment % output_every_ == 0 || newly_broken > 0 || position.step.begin >= last_increment_) {
    fields_->write(increment, body, values);
  }
  if (exports_) exports_->accept(increment, body);
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    std::vector<double> row = {static_cast<double>(increment)};
    row.insert(row.end(), values.begin(), values.end());
    history_->write(row);
    history_->check();
  });
  console_.show(record, newly_broken);
}

template <int dim>
std::string Results<dim>::write_unfinished(int increment, const Body<dim>& body) {
  const auto timer = profile_.measure(base::Phase::write);
  base::on_all_ranks(*comm_, [&] {
    const auto folder = std::filesystem::path(unfinished_.file).parent_path();
    std::error_code reported_later;
    if (comm_->getRank() == 0) std::filesystem::create_directory(folder, reported_later);
  });
  FieldSeries<dim>(comm_, unfinished_, {}, {}).write(increment, body, values_of(record_of(increment, body)));
  return unfinished_.file;
}

template <int dim>
void Results<dim>::bring_to_disk() {
  const auto timer = profile_.measure(base::Phase::write);
  fields_->bring_to_disk();
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    io::bring_to_disk((std::filesystem::path(folder_) / history_->extent().name).string());
    if (exports_) exports_->bring_to_disk();
    io::bring_to_disk(folder_);
  });
}

template class Results<2>;
template class Results<3>;

}  // namespace perimorph::output
