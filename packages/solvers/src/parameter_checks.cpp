#include "perimorph/solvers/parameter_checks.hpp"

#include <BelosBlockCGSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>
#include <MueLu_MasterList.hpp>
#include <regex>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"

namespace perimorph::solvers {

namespace {

using Teuchos::ParameterList;

/// Values that the libraries take, and then crash on or wait for other ranks.
std::string refused_value(const std::string& name, const Teuchos::ParameterEntry& entry) {
  if (name == "xml parameter file") return "found a file; allowed are the parameters themselves, in the case";
  if ((name == "max levels" || name == "Block Size") && Teuchos::getValue<int>(entry) < 1) {
    return fmt::format("found {}; allowed is 1 or more", Teuchos::getValue<int>(entry));
  }
  if ((name == "rap: triple product" || name == "repartition: enable") && Teuchos::getValue<bool>(entry)) {
    return "found true; allowed is false, since the cycle needs every level's matrices on every rank";
  }
  if (name == "aggregation: type" && Teuchos::getValue<std::string>(entry) == "brick") {
    return "found \"brick\", which is for grids of regular shape only; \"uncoupled\" is usual";
  }
  return "";
}

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
  if (fits) return refused_value(name, entry);
  return fmt::format("found a value of type \"{}\"; {} takes \"{}\"", entry.getAny(false).typeName(), library,
                     wanted.getAny(false).typeName());
}

void add(const ParameterList& given, const ParameterList& known, const char* library,
         std::vector<RefusedParameter>& refused) {
  static const std::regex free("level \\d+|Factories|Hierarchy|Matrix");  // MueLu's lists for experts
  for (const auto& item : given) {
    const std::string& name = item.first;
    const Teuchos::ParameterEntry& entry = item.second;
    if (entry.isList() && std::regex_match(name, free)) continue;
    if (auto what = mistake_in(name, entry, known, library); !what.empty()) {
      refused.push_back(RefusedParameter{fmt::format("{}/{}", library, name), std::move(what)});
    }
  }
}

}  // namespace

std::vector<RefusedParameter> refused_parameters(const SolverParameters& parameters) {
  std::vector<RefusedParameter> refused;
  const Belos::BlockCGSolMgr<double, MultiVector, Operator> conjugate_gradients;
  add(parameters.belos, *conjugate_gradients.getValidParameters(), "Belos", refused);
  add(parameters.muelu, *MueLu::MasterList::List(), "MueLu", refused);
  return refused;
}

}  // namespace perimorph::solvers
