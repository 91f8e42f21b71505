#include "perimorph/cases/steps.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "perimorph/base/errors.hpp"

namespace perimorph::cases {

namespace {

using discretization::Amplitude;

/// Grows by the steps.
class Course {
 public:
  const Amplitude::Knot& end() const { return knots_.back(); }

  /// Not between increments that round alike.
  void go_to(double increment, double value) {
    if (increment > end().place) knots_.push_back({increment, value});
  }

  Amplitude amplitude() && { return Amplitude(std::move(knots_)); }

 private:
  std::vector<Amplitude::Knot> knots_ = {{0., 0.}};
};

void follow_table(const Step& step, const std::vector<input::TableRow>& rows, Course& course) {
  const double start = course.end().place, first = rows.front().numbers[0], last = rows.back().numbers[0];
  for (int cycle = 0; cycle < step.cycles.value_or(1); ++cycle) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double share = (rows[i].numbers[0] - first) / (last - first);
      course.go_to(start + (cycle + share) * step.increments, rows[i].numbers[1]);
    }
  }
}

void go_there_and_back(const Step& step, double value, Course& course) {
  const auto start = course.end();
  for (int cycle = 0; cycle < *step.cycles; ++cycle) {
    course.go_to(start.place + (cycle + 0.5) * step.increments, value);
    course.go_to(start.place + (cycle + 1.) * step.increments, start.value);
  }
}

void follow(const Step& step, const std::string& condition, Course& course) {
  const auto table =
      std::find_if(step.tables.begin(), step.tables.end(), [&](const LoadTable& one) { return one.name == condition; });
  const auto found = std::find(step.conditions.begin(), step.conditions.end(), condition);
  const auto value = [&] { return step.values.at(static_cast<std::size_t>(found - step.conditions.begin())); };
  const double end = course.end().place + step.all_increments();
  if (table != step.tables.end()) {
    follow_table(step, table->rows, course);
  } else if (found == step.conditions.end()) {
    course.go_to(end, course.end().value);
  } else if (step.cycles) {
    go_there_and_back(step, value(), course);
  } else {
    course.go_to(end, value());
  }
}

}  // namespace

void declare(const input::Section& section, Step& step) {
  using namespace input;
  section.required("Increments", step.increments, 10, count(), "Of this step; with \"Cycles\" of each of them.");
  section.optional("Conditions", step.conditions, {"press"}, names("a list of conditions such as {press}"),
                   "Displacements, tractions, pressures and temperatures by their names, \"Body Force\" and "
                   "\"Self-Weight\". Those that are "
                   "neither listed here nor in \"Tables\" stay as they are.");
  section.optional(
      "Values", step.values, {1.}, numbers("one number for each condition"),
      "What the Rate of each condition is multiplied by at the end of the step [-]; within it that changes "
      "linearly from what it was before, which is 0 at first.");
  section.optional("Cycles", step.cycles, 5, count(),
                   "If given: within so many cycles, conditions go to their values and back to what they were before, "
                   "half of the increments each way, and through their tables, which then end as they begin.");
  section.optional("Released", step.released, {"prop"}, names("a list of conditions such as {prop}"),
                   "Conditions that end when this step begins, and for good. What a displacement prescribed is free "
                   "from the first increment on, and its reaction gone; of a load its Constant is gone, too.");
  section.optional(
      "Started", step.started, {"grip"}, names("a list of conditions such as {grip}"),
      "Conditions that begin with this step, and are not there before. A displacement then counts from where "
      "the nodes are: without a Rate it holds them there.");
  section.entries("Tables", step.tables, declare,
                  "Conditions that follow a table from a file in this step, each a list with the condition's name.",
                  "The table of one condition.");
}

void read_tables(const std::string& folder, std::vector<Step>& steps) {
  for (Step& step : steps) {
    for (auto& table : step.tables) table.rows = read_load_table(std::filesystem::path(folder) / table.file);
  }
}

std::string listing_of_tables(const std::vector<Step>& steps) {
  std::string text;
  for (const auto& step : steps) {
    for (const auto& table : step.tables) {
      for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& numbers = table.rows[i].numbers;
        text += fmt::format("/Loading/Steps/{}/Tables/{}: row {} = {}, {}\n", step.name, table.name, i + 1, numbers[0],
                            numbers[1]);
      }
    }
  }
  return text;
}

std::shared_ptr<const Amplitude> amplitude_of(const std::string& condition, const std::vector<Step>& steps) {
  Course course;
  for (const Step& step : steps) follow(step, condition, course);
  return std::make_shared<const Amplitude>(std::move(course).amplitude());
}

namespace {

/// The increment after which the first step begins that has a condition in a list of its own; none: infinity.
double begin_of_step(const std::string& condition, const std::vector<Step>& steps,
                     std::vector<std::string> Step::*list) {
  double begin = 0.;
  for (const Step& step : steps) {
    if (std::find((step.*list).begin(), (step.*list).end(), condition) != (step.*list).end()) return begin;
    begin += step.all_increments();
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

double end_of(const std::string& condition, const std::vector<Step>& steps) {
  return begin_of_step(condition, steps, &Step::released);
}

double begin_of(const std::string& condition, const std::vector<Step>& steps) {
  const double begin = begin_of_step(condition, steps, &Step::started);
  return std::isfinite(begin) ? begin : -begin;
}

}  // namespace perimorph::cases
