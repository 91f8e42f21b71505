#include "perimorph/input/section.hpp"

#include "perimorph/base/errors.hpp"

namespace perimorph::input {

using Teuchos::ParameterList;

Section Section::of_schema(ParameterList& schema) { return {&schema, nullptr, nullptr}; }

Section Section::of_values(const ParameterList& values, const Mistakes& mistakes) {
  return {nullptr, &values, &mistakes};
}

Section Section::section(const std::string& name, const std::string& documentation) const {
  PERIMORPH_ASSERT(!name.empty(), "{}: a section without a name", path_);
  Section inner = *this;
  inner.path_ += "/" + name;
  if (schema_ != nullptr) {
    inner.schema_ = &schema_->sublist(name, false, documentation);
  } else {
    inner.values_ = &values_->sublist(name);
  }
  return inner;
}

Section Section::changeable() const {
  Section same = *this;
  same.is_changeable_ = true;
  return same;
}

std::vector<std::string> Section::names_of_entries() const {
  if (schema_ != nullptr) return {"*"};
  std::vector<std::string> names;
  for (const auto& item : *values_) {
    if (mistakes_->none_in(path_ + "/" + item.first)) names.push_back(item.first);
  }
  return names;
}

void Section::anything(const std::string& name, ParameterList& variable, const std::string& documentation) const {
  if (schema_ != nullptr) {
    PERIMORPH_ASSERT(!schema_->isSublist(name), "{}/{} is declared twice", path_, name);
    schema_->sublist(name, false, documentation);
  } else {
    variable = values_->sublist(name);
  }
}

}  // namespace perimorph::input
