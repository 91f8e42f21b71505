#pragma once

#include <Teuchos_ParameterEntry.hpp>
#include <Teuchos_ParameterEntryValidator.hpp>
#include <functional>
#include <string>
#include <vector>

namespace perimorph::input {

/// What happens when the case file leaves a parameter out: it is a mistake; it has no value (or another parameter
/// decides whether it needs one); it takes the default. The schema's value of the first two is an example.
enum class Presence { required, optional, defaulted };

/// What a parameter may be. Its description completes the sentence "allowed is ...".
class Rule : public Teuchos::ParameterEntryValidator {
 public:
  using Test = std::function<bool(const Teuchos::ParameterEntry&)>;

  Rule(std::string allowed, Test test, std::vector<std::string> choices = {});

  Presence presence() const { return presence_; }
  Rule with_presence(Presence presence) const;

  /// Whether a run that goes on from a checkpoint may have another value than the one that wrote it: the parameter does
  /// not decide what is computed.
  bool is_changeable() const { return is_changeable_; }
  Rule with_change() const;

  const std::string& allowed() const { return allowed_; }
  bool accepts(const Teuchos::ParameterEntry& entry) const { return test_(entry); }
  const std::vector<std::string>& choices() const { return choices_; }  ///< empty if any text will do

  const std::string getXMLTypeName() const override { return "PerimorphRule"; }
  void printDoc(const std::string& documentation, std::ostream& out) const override;
  ValidStringsList validStringValues() const override;
  void validate(const Teuchos::ParameterEntry& entry, const std::string& name, const std::string& list) const override;

 private:
  std::string allowed_;
  Test test_;
  std::vector<std::string> choices_;
  Presence presence_ = Presence::defaulted;
  bool is_changeable_ = false;
};

using RulePtr = Teuchos::RCP<const Rule>;

/// Of a parameter in a schema.
const Rule& rule_of(const Teuchos::ParameterEntry& declaration);

RulePtr required(const RulePtr& rule);
RulePtr optional(const RulePtr& rule);
RulePtr changeable(const RulePtr& rule);

RulePtr any_text();
RulePtr text(const std::string& what);  ///< not empty
RulePtr file_name();
RulePtr one_of(const std::vector<std::string>& choices);
RulePtr any_number();
RulePtr above(double low);
RulePtr at_least(double low);
RulePtr between(double low, double high);     ///< both excluded
RulePtr share();                              ///< above 0, up to 1
RulePtr count();                              ///< a whole number from 1
RulePtr whole_number();                       ///< from 0
RulePtr flag();                               ///< true or false
RulePtr increments(const std::string& what);  ///< array of whole numbers from 1
RulePtr either(int one, int other);
RulePtr numbers(const std::string& what);  ///< array; how many is checked with the dimension
RulePtr names(const std::string& what);    ///< array of texts that are not empty

}  // namespace perimorph::input
