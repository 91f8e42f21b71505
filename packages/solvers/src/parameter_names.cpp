#include "perimorph/solvers/parameter_names.hpp"

#include <BelosBlockCGSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>
#include <MueLu_MasterList.hpp>
#include <regex>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"

namespace perimorph::solvers {

namespace {

using Teuchos::ParameterList;

/// What is wrong with an entry, or "".
std::string mistake_in(const std::string& name, const Teuchos::ParameterEntry& entry, const ParameterList& known,
                       const char* library) {
  if (!known.isParameter(name)) {
    std::vector<std::string> names;
    for (const auto& item : known) names.push_back(item.first);
    return fmt::format("{} knows no parameter of that name{}", library, base::did_you_mean(name, names));
  }
  const auto& wanted = known.getEntry(name);
  const bool fits = entry.isList() == wanted.isList() &&
                    (entry.isList() || entry.getAny(false).type() == wanted.getAny(false).type());
  if (fits) return "";
  return fmt::format("found a value of type \"{}\"; {} takes \"{}\"", entry.getAny(false).typeName(), library,
                     wanted.getAny(false).typeName());
}

void add(const ParameterList& given, const ParameterList& known, const char* library,
         std::vector<UnknownParameter>& unknown) {
  static const std::regex free("level \\d+|Factories|Hierarchy|Matrix");  // MueLu's lists for experts
  for (const auto& item : given) {
    const std::string& name = item.first;
    const Teuchos::ParameterEntry& entry = item.second;
    if (entry.isList() && std::regex_match(name, free)) continue;
    if (auto what = mistake_in(name, entry, known, library); !what.empty()) {
      unknown.push_back(UnknownParameter{fmt::format("{}/{}", library, name), std::move(what)});
    }
  }
}

}  // namespace

std::vector<UnknownParameter> unknown_parameters(const SolverParameters& parameters) {
  std::vector<UnknownParameter> unknown;
  const Belos::BlockCGSolMgr<double, MultiVector, Operator> conjugate_gradients;
  add(parameters.belos, *conjugate_gradients.getValidParameters(), "Belos", unknown);
  add(parameters.muelu, *MueLu::MasterList::List(), "MueLu", unknown);
  return unknown;
}

}  // namespace perimorph::solvers
