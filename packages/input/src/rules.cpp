#include "perimorph/input/rules.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterListExceptions.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <utility>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"

namespace perimorph::input {

namespace {

using Teuchos::ParameterEntry;

template <class T, class Condition>
RulePtr rule(const std::string& allowed, Condition condition, std::vector<std::string> choices = {}) {
  const auto test = [condition](const ParameterEntry& entry) {
    return entry.isType<T>() && condition(Teuchos::getValue<T>(entry));
  };
  return Teuchos::rcp(new Rule(allowed, test, std::move(choices)));
}

}  // namespace

Rule::Rule(std::string allowed, Test test, std::vector<std::string> choices)
    : allowed_(std::move(allowed)), test_(std::move(test)), choices_(std::move(choices)) {
  PERIMORPH_ASSERT(!allowed_.empty() && test_, "a rule '{}' needs words for what is allowed, and a test", allowed_);
}

Rule Rule::with_presence(Presence presence) const {
  Rule copy = *this;
  copy.presence_ = presence;
  return copy;
}

Rule Rule::with_change() const {
  Rule copy = *this;
  copy.is_changeable_ = true;
  return copy;
}

void Rule::printDoc(const std::string& documentation, std::ostream& out) const {
  out << "# " << documentation << "\n# Allowed is " << allowed_ << "\n";
}

Rule::ValidStringsList Rule::validStringValues() const {
  if (choices_.empty()) return Teuchos::null;
  return Teuchos::rcp(new Teuchos::Array<std::string>(choices_));
}

void Rule::validate(const ParameterEntry& entry, const std::string& name, const std::string& list) const {
  if (accepts(entry)) return;
  throw Teuchos::Exceptions::InvalidParameterValue(
      fmt::format("{}/{}: found {}; allowed is {}", list, name, Teuchos::toString(entry.getAny(false)), allowed_));
}

const Rule& rule_of(const ParameterEntry& declaration) {
  PERIMORPH_ASSERT(!declaration.validator().is_null(), "'{}' is declared without a rule", declaration.docString());
  return dynamic_cast<const Rule&>(*declaration.validator());
}

RulePtr required(const RulePtr& rule) { return Teuchos::rcp(new Rule(rule->with_presence(Presence::required))); }
RulePtr optional(const RulePtr& rule) { return Teuchos::rcp(new Rule(rule->with_presence(Presence::optional))); }

RulePtr changeable(const RulePtr& rule) { return Teuchos::rcp(new Rule(rule->with_change())); }

RulePtr any_text() {
  return rule<std::string>("any text", [](const std::string&) { return true; });
}

RulePtr text(const std::string& what) {
  return rule<std::string>(what, [](const std::string& value) { return !value.empty(); });
}

RulePtr file_name() {
  return rule<std::string>("a readable name of a file", [](const std::string& value) {
    return !value.empty() && !base::has_control_characters(value);
  });
}

RulePtr one_of(const std::vector<std::string>& choices) {
  PERIMORPH_ASSERT(!choices.empty(), "there is nothing to choose from");
  const auto is_one = [choices](const std::string& value) {
    return std::find(choices.begin(), choices.end(), value) != choices.end();
  };
  return rule<std::string>(base::quoted_list(choices, " or "), is_one, choices);
}

RulePtr any_number() {
  return rule<double>("any number", [](double value) { return std::isfinite(value); });
}

RulePtr above(double low) {
  PERIMORPH_ASSERT(std::isfinite(low), "a limit of {}", low);
  return rule<double>(fmt::format("a number > {}", low), [low](double value) { return value > low; });
}

RulePtr at_least(double low) {
  PERIMORPH_ASSERT(std::isfinite(low), "a limit of {}", low);
  return rule<double>(fmt::format("a number >= {}", low), [low](double value) { return value >= low; });
}

RulePtr between(double low, double high) {
  PERIMORPH_ASSERT(low < high, "nothing is between {} and {}", low, high);
  return rule<double>(fmt::format("a number > {} and < {}", low, high),
                      [low, high](double value) { return value > low && value < high; });
}

RulePtr share() {
  return rule<double>("a number > 0 and <= 1", [](double value) { return value > 0. && value <= 1.; });
}

RulePtr count() {
  return rule<int>("a whole number >= 1", [](int value) { return value >= 1; });
}

RulePtr whole_number() {
  return rule<int>("a whole number >= 0", [](int value) { return value >= 0; });
}

RulePtr flag() {
  return rule<bool>("true or false", [](bool) { return true; });
}

RulePtr increments(const std::string& what) {
  return rule<Teuchos::Array<int>>(what, [](const Teuchos::Array<int>& values) {
    return std::all_of(values.begin(), values.end(), [](int value) { return value >= 1; });
  });
}

RulePtr either(int one, int other) {
  PERIMORPH_ASSERT(one != other, "{} is no choice", one);
  return rule<int>(fmt::format("{} or {}", one, other), [=](int found) { return found == one || found == other; });
}

RulePtr numbers(const std::string& what) {
  return rule<Teuchos::Array<double>>(what, [](const Teuchos::Array<double>&) { return true; });
}

RulePtr names(const std::string& what) {
  return rule<Teuchos::Array<std::string>>(what, [](const Teuchos::Array<std::string>& values) {
    return std::none_of(values.begin(), values.end(), [](const std::string& value) { return value.empty(); });
  });
}

}  // namespace perimorph::input
