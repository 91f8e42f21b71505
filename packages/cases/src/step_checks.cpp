// What the steps of the load must agree on.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/cases/steps.hpp"

namespace perimorph::cases {

namespace {

using input::Values;

/// A condition that steps may name: whether its rate and its constant are not zero, and whether it is a displacement.
struct Condition {
  Values section;
  bool has_rate, has_constant, holds;

  bool has_effect() const { return holds || has_rate || has_constant; }
};
using Conditions = std::multimap<std::string, Condition>;  // by name; several may have one

bool is_nonzero(const Values& section, const char* name) {
  const double* number = section.number(name);
  if (number != nullptr) return *number != 0.;
  const auto* numbers = section.numbers(name);
  return numbers != nullptr && std::any_of(numbers->begin(), numbers->end(), [](double value) { return value != 0.; });
}

std::string name_of(const Values& section) { return section.path().substr(section.path().rfind('/') + 1); }

Conditions conditions_of(const Values& root) {
  const Values all = root.sub("Boundary Conditions");
  Conditions found;
  const auto add = [&](const Values& one, bool holds) {
    found.emplace(name_of(one), Condition{one, is_nonzero(one, "Rate"), is_nonzero(one, "Constant"), holds});
  };
  for (const auto& one : all.subs("Displacements")) add(one, true);
  for (const char* kind : {"Tractions", "Pressures", "Temperatures"}) {
    for (const auto& one : all.subs(kind)) add(one, false);
  }
  for (const char* kind : {"Body Force", "Self-Weight"}) add(all.sub(kind), false);
  return found;
}

/// Why a step cannot name this condition; "" if it can.
/// @param what conditions there are to name
template <class Allows>
std::string trouble_with(const std::string& name, const Conditions& conditions, const char* what, Allows allows) {
  std::vector<std::string> allowed;
  for (const auto& [one, condition] : conditions) {
    if (allows(condition)) allowed.push_back(one);
  }
  if (std::find(allowed.begin(), allowed.end(), name) == allowed.end()) {
    return fmt::format("found {}; the conditions {} are {}{}", input::in_quotes(name), what, base::quoted_list(allowed),
                       base::did_you_mean(name, allowed));
  }
  if (conditions.count(name) == 1) return "";
  return fmt::format("found {}, which is the name of several conditions; allowed are names that only one has",
                     input::in_quotes(name));
}

/// Conditions that steps have let go, and in which step: the path.
using Released = std::map<std::string, std::string>;

void check_released(const Values& step, bool is_first, const Conditions& conditions, Released& released) {
  const auto* names = step.texts("Released");
  if (names == nullptr) return;
  if (is_first) {
    step.mistake("Released", "found in the first step; allowed is it in later ones: the conditions would never hold");
  }
  for (const auto& name : *names) {
    const auto trouble = trouble_with(name, conditions, "that hold or load the body",
                                      [](const Condition& condition) { return condition.has_effect(); });
    if (!trouble.empty()) step.mistake("Released", trouble);
    const auto [first, is_new] = released.emplace(name, step.path());
    if (is_new) continue;
    step.mistake("Released", fmt::format("found {} again; {} has released it", input::in_quotes(name), first->second));
  }
}

/// Conditions that begin with a later step than the one that is looked at.
std::set<std::string> started_in(const std::vector<Values>& steps) {
  std::set<std::string> all;
  for (const auto& step : steps) {
    if (const auto* names = step.texts("Started")) all.insert(names->begin(), names->end());
  }
  return all;
}

/// Why a displacement cannot begin with a later step; "" if it can, and for loads. @param rigid groups that move as one
std::string trouble_with_later(const std::string& name, const Condition& condition,
                               const std::set<std::string>& rigid) {
  const auto* group = condition.section.text("Group");
  if (!condition.holds) return "";
  if (condition.section.given("Direction")) {
    return fmt::format("found {}, which has a \"Direction\"; allowed are displacements along an axis",
                       input::in_quotes(name));
  }
  if (group == nullptr || rigid.count(*group) == 0) return "";
  return fmt::format("found {}, which moves the rigid group {}; allowed are displacements of nodes",
                     input::in_quotes(name), input::in_quotes(*group));
}

/// @param rigid groups that move as one
/// @param waiting conditions that later steps start, from which those of this one are taken
void check_started(const Values& step, bool is_first, const Conditions& conditions, const std::set<std::string>& rigid,
                   const Released& released, std::set<std::string>& waiting) {
  const auto* names = step.texts("Started");
  if (names == nullptr) return;
  if (is_first) {
    step.mistake("Started",
                 "found in the first step; allowed is it in later ones: conditions hold from the first anyway");
  }
  for (const auto& name : *names) {
    auto trouble = trouble_with(name, conditions, "that hold the body or have a \"Constant\"",
                                [](const Condition& condition) { return condition.holds || condition.has_constant; });
    if (trouble.empty() && waiting.erase(name) == 0) {
      trouble = fmt::format("found {} again; allowed is each once", input::in_quotes(name));
    }
    if (trouble.empty() && released.count(name) != 0) {
      trouble = fmt::format("found {}, which {} releases", input::in_quotes(name), released.at(name));
    }
    if (trouble.empty()) trouble = trouble_with_later(name, conditions.find(name)->second, rigid);
    if (!trouble.empty()) step.mistake("Started", trouble);
  }
}

/// All that a step names, and each once.
std::set<std::string> check_names(const Values& step, const Conditions& conditions, const Released& released,
                                  const std::set<std::string>& waiting) {
  std::set<std::string> seen;
  const auto trouble_of = [&](const std::string& name) {
    if (waiting.count(name) != 0) {
      return fmt::format("found {}, which a later step starts", input::in_quotes(name));
    }
    if (!seen.insert(name).second) return fmt::format("found {} twice; allowed is each once", input::in_quotes(name));
    const auto ended = released.find(name);
    if (ended != released.end()) {
      return fmt::format("found {}, which {} has released for good", input::in_quotes(name), ended->second);
    }
    return trouble_with(name, conditions, "with a \"Rate\"",
                        [](const Condition& condition) { return condition.has_rate; });
  };
  const auto check = [&](const Values& section, const std::string& where, const std::string& name) {
    const auto trouble = trouble_of(name);
    if (!trouble.empty()) section.mistake(where, trouble);
  };
  if (const auto* names = step.texts("Conditions")) {
    for (const auto& name : *names) check(step, "Conditions", name);
  }
  for (const auto& table : step.subs("Tables")) check(step.sub("Tables"), name_of(table), name_of(table));
  return seen;
}

void check_values(const Values& step) {
  const bool has_names = step.given("Conditions"), has_values = step.given("Values");
  if (!has_names && step.subs("Tables").empty() && !step.given("Released") && !step.given("Started")) {
    step.mistake(
        "Conditions",
        "missing; needed is a list of conditions such as {press}, one in \"Tables\", \"Released\" or \"Started\"");
  }
  if (has_names && !has_values) step.mistake("Values", "missing; needed is one number for each of \"Conditions\"");
  if (has_values && !has_names) step.mistake("Values", "found without \"Conditions\", to which they would belong");
  const auto* names = step.texts("Conditions");
  const auto* values = step.numbers("Values");
  if (names == nullptr || values == nullptr || names->size() == values->size()) return;
  step.mistake("Values",
               fmt::format("found {} numbers for {}; allowed is one for each of \"Conditions\"", values->size(),
                           base::counted(static_cast<std::size_t>(names->size()), "condition")));
}

constexpr std::int64_t most_points = 1'000'000;  // of a condition's course in one step

/// @param n_points of the course in one cycle
void check_cycles(const Values& step, std::size_t n_points) {
  const int* cycles = step.count("Cycles");
  const std::int64_t most = most_points / static_cast<std::int64_t>(n_points);
  if (cycles == nullptr || *cycles <= most) return;
  step.mistake("Cycles", fmt::format("found {}; allowed are up to {}", *cycles, most));
}

void check_halves(const Values& step) {
  const int* increments = step.count("Increments");
  if (step.count("Cycles") == nullptr || step.texts("Conditions") == nullptr || increments == nullptr) return;
  check_cycles(step, 2);
  if (*increments % 2 == 0) return;
  step.mistake("Increments", fmt::format("found {} with \"Cycles\"; allowed are even numbers, of which half lead to "
                                         "\"Values\" and half back",
                                         *increments));
}

/// That a table goes on from what its condition has reached, and what it reaches itself.
double check_table(const Values& table, const Values& step, const std::string& folder, double reached) {
  const std::string* name = table.text("File");
  if (name == nullptr) return reached;
  const std::string file = std::filesystem::path(folder) / *name;
  std::vector<input::TableRow> rows;
  try {
    rows = read_load_table(file);
  } catch (const base::UserError& error) {
    table.mistake("File", error.what());
    return reached;
  }
  double largest = 0.;
  for (const auto& row : rows) largest = std::max(largest, std::abs(row.numbers[1]));
  const auto check = [&](const input::TableRow& row, double allowed, const char* what) {
    if (std::abs(row.numbers[1] - allowed) <= 1e-9 * largest) return;
    table.mistake("File", fmt::format("{}:{}: found the value {}; allowed is {}, {}", file, row.line, row.numbers[1],
                                      allowed, what));
  };
  check(rows.front(), reached, "which the condition has at the beginning of the step");
  if (step.count("Cycles") != nullptr) check(rows.back(), rows.front().numbers[1], "with which the next cycle begins");
  check_cycles(step, rows.size());
  return rows.back().numbers[1];
}

/// @param reached by each condition, before the step and after it
void check_courses(const Values& step, const std::string& folder, std::map<std::string, double>& reached) {
  check_halves(step);
  for (const auto& table : step.subs("Tables")) {
    double& value = reached[name_of(table)];
    value = check_table(table, step, folder, value);
  }
  const auto* names = step.texts("Conditions");
  const auto* values = step.numbers("Values");
  if (names == nullptr || values == nullptr || step.count("Cycles") != nullptr) return;
  for (int i = 0; i < std::min(names->size(), values->size()); ++i) reached[(*names)[i]] = (*values)[i];
}

void check_increments(const Values& loading, const std::vector<Values>& steps) {
  const int* increments = loading.count("Increments");
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  std::int64_t sum = 0;
  for (const auto& step : steps) {
    const int *own = step.count("Increments"), *cycles = step.count("Cycles");
    if (own == nullptr) return;
    sum = std::min(most, sum + std::int64_t{*own} * (cycles == nullptr ? 1 : *cycles));
  }
  if (increments == nullptr || *increments <= sum) return;
  loading.mistake("Increments",
                  fmt::format("found {}; allowed are up to {}, as many as the steps have", *increments, sum));
}

}  // namespace

void check_steps(const Values& root, const std::string& folder) {
  const Values loading = root.sub("Loading");
  const auto steps = loading.subs("Steps");
  if (steps.empty()) return;
  const std::string* control = loading.text("Control");
  if (control != nullptr && *control != "Load") {
    loading.mistake("Control", fmt::format("found {} beside /Loading/Steps; allowed is \"Load\" with steps: a measure "
                                           "decides on all loads together",
                                           input::in_quotes(*control)));
  }
  check_increments(loading, steps);
  const auto conditions = conditions_of(root);
  std::set<std::string> named;
  std::map<std::string, double> reached;
  Released released;
  std::set<std::string> rigid, waiting = started_in(steps);
  for (const auto& group : root.sub("Boundary Conditions").subs("Rigid Groups")) {
    if (const auto* name = group.text("Group")) rigid.insert(*name);
  }
  for (const auto& step : steps) {
    const bool is_first = step.path() == steps.front().path();
    check_values(step);
    check_released(step, is_first, conditions, released);
    check_started(step, is_first, conditions, rigid, released, waiting);
    named.merge(check_names(step, conditions, released, waiting));
    check_courses(step, folder, reached);
  }
  for (const auto& [name, condition] : conditions) {
    if (!condition.has_rate || named.count(name) != 0) continue;
    condition.section.mistake("Rate",
                              "found, but no step in /Loading/Steps names this condition, so that it has no effect");
  }
}

}  // namespace perimorph::cases
