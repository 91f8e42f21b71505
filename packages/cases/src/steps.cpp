#include "perimorph/cases/steps.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>

#include "perimorph/base/text.hpp"

namespace perimorph::cases {

namespace {

using input::Values;

constexpr const char* conditions_path = "Boundary Conditions";

/// A condition that steps may name, and whether its rate is not zero.
struct Condition {
  Values section;
  bool has_rate;
};

bool is_nonzero(const Values& section) {
  const double* number = section.number("Rate");
  if (number != nullptr) return *number != 0.;
  const auto* numbers = section.numbers("Rate");
  return numbers != nullptr && std::any_of(numbers->begin(), numbers->end(), [](double rate) { return rate != 0.; });
}

std::string name_of(const Values& section) { return section.path().substr(section.path().rfind('/') + 1); }

/// By name; several may have one.
std::multimap<std::string, Condition> conditions_of(const Values& root) {
  const Values all = root.sub(conditions_path);
  std::multimap<std::string, Condition> found;
  const auto add = [&](const Values& one) { found.emplace(name_of(one), Condition{one, is_nonzero(one)}); };
  for (const char* kind : {"Displacements", "Tractions", "Pressures"}) {
    for (const auto& one : all.subs(kind)) add(one);
  }
  for (const char* kind : {"Body Force", "Self-Weight"}) add(all.sub(kind));
  return found;
}

void check_names(const Values& step, const std::multimap<std::string, Condition>& conditions,
                 const Teuchos::Array<std::string>& names) {
  std::vector<std::string> allowed;
  for (const auto& [name, condition] : conditions) {
    if (condition.has_rate) allowed.push_back(name);
  }
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!seen.insert(name).second) {
      step.mistake("Conditions", fmt::format("found {} twice; allowed is each once", input::in_quotes(name)));
    } else if (std::find(allowed.begin(), allowed.end(), name) == allowed.end()) {
      step.mistake("Conditions",
                   fmt::format("found {}; the conditions with a \"Rate\" are {}{}", input::in_quotes(name),
                               base::quoted_list(allowed), base::did_you_mean(name, allowed)));
    } else if (conditions.count(name) > 1) {
      step.mistake("Conditions",
                   fmt::format("found {}, which is the name of several conditions; allowed are names that "
                               "only one has",
                               input::in_quotes(name)));
    }
  }
}

void check_step(const Values& step, const std::multimap<std::string, Condition>& conditions) {
  const auto* names = step.texts("Conditions");
  const auto* values = step.numbers("Values");
  if (names == nullptr || values == nullptr) return;
  check_names(step, conditions, *names);
  if (names->size() == values->size()) return;
  step.mistake("Values",
               fmt::format("found {} numbers for {}; allowed is one for each of \"Conditions\"", values->size(),
                           base::counted(static_cast<std::size_t>(names->size()), "condition")));
}

void check_increments(const Values& loading, const std::vector<Values>& steps) {
  const int* increments = loading.count("Increments");
  std::int64_t sum = 0;
  for (const auto& step : steps) {
    const int* own = step.count("Increments");
    if (own == nullptr) return;
    sum += *own;
  }
  if (increments == nullptr || *increments <= sum) return;
  loading.mistake("Increments",
                  fmt::format("found {}; allowed are up to {}, as many as the steps have", *increments, sum));
}

}  // namespace

void declare(const input::Section& section, Step& step) {
  using namespace input;
  section.required("Increments", step.increments, 10, count(), "Of this step.");
  section.required(
      "Conditions", step.conditions, {"press"}, names("a list of conditions such as {press}"),
      "Displacements, tractions and pressures by their names, \"Body Force\" and \"Self-Weight\". Those that are not "
      "listed stay as they are.");
  section.required(
      "Values", step.values, {1.}, numbers("one number for each condition"),
      "What the Rate of each condition is multiplied by at the end of the step [-]; within it that changes "
      "linearly from what it was before, which is 0 at first.");
}

void check_steps(const Values& root) {
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
  for (const auto& step : steps) {
    check_step(step, conditions);
    if (const auto* names = step.texts("Conditions")) named.insert(names->begin(), names->end());
  }
  for (const auto& [name, condition] : conditions) {
    if (!condition.has_rate || named.count(name) != 0) continue;
    condition.section.mistake("Rate",
                              "found, but no step in /Loading/Steps names this condition, so that it has no effect");
  }
}

std::shared_ptr<const discretization::Amplitude> amplitude_of(const std::string& condition,
                                                              const std::vector<Step>& steps) {
  std::vector<discretization::Amplitude::Knot> knots = {{0., 0.}};
  for (const Step& step : steps) {
    auto next = knots.back();
    next.increment += step.increments;
    const auto found = std::find(step.conditions.begin(), step.conditions.end(), condition);
    if (found != step.conditions.end()) next.value = step.values.at(found - step.conditions.begin());
    knots.push_back(next);
  }
  return std::make_shared<const discretization::Amplitude>(std::move(knots));
}

}  // namespace perimorph::cases
