#include "perimorph/input/values.hpp"

#include <fmt/format.h>

#include "perimorph/input/literal.hpp"

namespace perimorph::input {

Values Values::sub(const std::string& name) const {
  return {resolved_, mistakes_, list_.sublist(name), path_ + "/" + name};
}

std::vector<Values> Values::subs(const std::string& name) const {
  std::vector<Values> all;
  const Values parent = sub(name);
  for (const auto& item : parent.list_) all.push_back(parent.sub(item.first));
  return all;
}

std::string Values::shown(const std::string& name) const { return to_literal(list_.getEntry(name)); }

void Values::mistake(const std::string& name, const std::string& what) const {
  const std::string path = path_ + "/" + name;
  mistakes_.add(resolved_.line(path), path, what);
}

void check_order(const Values& section, const std::string& smaller, const std::string& larger) {
  const double *low = section.number(smaller), *high = section.number(larger);
  if (low == nullptr || high == nullptr || *high > *low) return;
  section.mistake(larger, fmt::format("found {}; allowed is a number > \"{}\", which is {}", *high, smaller, *low));
}

}  // namespace perimorph::input
