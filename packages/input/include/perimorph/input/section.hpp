#pragma once

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <optional>
#include <string>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/input/mistakes.hpp"
#include "perimorph/input/rules.hpp"

namespace perimorph::input {

namespace detail {

/// How values stand in a Teuchos list.
template <class T>
struct Storage {
  using Value = T;  ///< of a variable that may have none
  static const T& put(const T& value) { return value; }
  static const T& take(const T& value) { return value; }
};
template <class T>
struct Storage<std::vector<T>> {
  using Value = std::vector<T>;
  static Teuchos::Array<T> put(const std::vector<T>& values) { return values; }
  static std::vector<T> take(const Teuchos::Array<T>& values) { return values.toVector(); }
};
template <class T>
struct Storage<std::optional<T>> : Storage<T> {
  using Value = T;
};

}  // namespace detail

/// A table of {word, value, ...}: all its words, the first word of a value, and the value of a word. Local.
template <class Choices>
std::vector<std::string> words(const Choices& choices) {
  std::vector<std::string> all;
  for (const auto& choice : choices) all.emplace_back(choice.word);
  return all;
}

template <class Choices, class E>
std::string word_of(const Choices& choices, const E& value) {
  for (const auto& choice : choices) {
    if (choice.value == value) return choice.word;
  }
  throw base::Bug("a value without a word");
}

template <class Choices>
auto value_of(const Choices& choices, const std::string& word) {
  for (const auto& choice : choices) {
    if (word == choice.word) return choice.value;
  }
  throw base::Bug("no such choice: " + word);
}

/// A section of a case file and the variables that it fills. The same lines, one a parameter, do both: they declare the
/// parameters in a schema, with the variables' values as defaults, and take the values of a case into the variables.
/// Documentation says units in brackets. All local.
class Section {
  template <class T>
  using Value = typename detail::Storage<T>::Value;

 public:
  /// The root of a schema, to be filled.
  static Section of_schema(Teuchos::ParameterList& schema);

  /// The root of a case's values. Variables whose parameter has none stay as they are; of the entries that the user
  /// names, those are left out in which there are mistakes.
  static Section of_values(const Teuchos::ParameterList& values, const Mistakes& mistakes);

  /// A section in this one.
  Section section(const std::string& name, const std::string& documentation) const;

  /// This section, for parameters that may change when a run goes on from a checkpoint: they do not decide what is
  /// computed.
  Section changeable() const;

  /// A parameter that may be left out: the variable's value is the default.
  template <class T>
  void parameter(const std::string& name, T& variable, const RulePtr& rule, const std::string& documentation) const {
    pass(name, variable, variable, rule, documentation);
  }

  /// A parameter that must be given.
  template <class T>
  void required(const std::string& name, T& variable, const Value<T>& example, const RulePtr& rule,
                const std::string& documentation) const {
    pass(name, variable, example, input::required(rule), documentation);
  }

  /// A parameter that may be left out and has no default; the documentation says what that means.
  template <class T>
  void optional(const std::string& name, T& variable, const Value<T>& example, const RulePtr& rule,
                const std::string& documentation) const {
    pass(name, variable, example, input::optional(rule), documentation);
  }

  /// One of some words, each with its value: the first word of the variable's value is the default.
  /// @param choices of {word, value, ...}
  template <class E, class Choices>
  void choice(const std::string& name, E& variable, const Choices& choices, const std::string& documentation) const {
    choose(name, variable, choices, one_of(words(choices)), documentation);
  }

  /// The same, and must be given.
  template <class E, class Choices>
  void required_choice(const std::string& name, E& variable, const Choices& choices,
                       const std::string& documentation) const {
    choose(name, variable, choices, input::required(one_of(words(choices))), documentation);
  }

  /// The same, and may be left out: the variable's value, which needs no word, then stays; the documentation says what
  /// that means.
  template <class E, class Choices>
  void optional_choice(const std::string& name, E& variable, const Choices& choices,
                       const std::string& documentation) const {
    std::string word;
    pass(name, word, choices.front().word, input::optional(one_of(words(choices))), documentation);
    if (!word.empty()) variable = value_of(choices, word);
  }

  /// Entries that the user names, each a section; the name goes to Entry::name.
  /// @param declare the parameters of one entry
  template <class Entry>
  void entries(const std::string& name, std::vector<Entry>& all, void (*declare)(const Section&, Entry&),
               const std::string& documentation, const std::string& documentation_of_one) const {
    const Section parent = section(name, documentation);
    for (const auto& one : parent.names_of_entries()) {
      Entry entry{};
      entry.name = one;
      declare(parent.section(one, documentation_of_one), entry);
      if (schema_ == nullptr) all.push_back(std::move(entry));
    }
  }

  /// A section with any parameters, which is handed on as it is.
  void anything(const std::string& name, Teuchos::ParameterList& variable, const std::string& documentation) const;

 private:
  Section(Teuchos::ParameterList* schema, const Teuchos::ParameterList* values, const Mistakes* mistakes)
      : schema_(schema), values_(values), mistakes_(mistakes) {}

  template <class T>
  void pass(const std::string& name, T& variable, const Value<T>& example, const RulePtr& rule,
            const std::string& documentation) const {
    using Storage = detail::Storage<T>;
    using Stored = std::decay_t<decltype(Storage::put(example))>;
    if (schema_ != nullptr) {
      PERIMORPH_ASSERT(!schema_->isParameter(name), "{}/{} is declared twice", path_, name);
      schema_->set(name, Storage::put(example), documentation, is_changeable_ ? input::changeable(rule) : rule);
    } else if (values_->isParameter(name)) {
      variable = Storage::take(values_->get<Stored>(name));
    }
  }

  template <class E, class Choices>
  void choose(const std::string& name, E& variable, const Choices& choices, const RulePtr& rule,
              const std::string& documentation) const {
    std::string word = word_of(choices, variable);
    pass(name, word, word, rule, documentation);
    variable = value_of(choices, word);
  }

  std::vector<std::string> names_of_entries() const;

  Teuchos::ParameterList* schema_ = nullptr;        ///< to which it is declared, or
  const Teuchos::ParameterList* values_ = nullptr;  ///< from which it is taken
  const Mistakes* mistakes_ = nullptr;
  std::string path_;
  bool is_changeable_ = false;
};

}  // namespace perimorph::input
