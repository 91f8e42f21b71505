#include "perimorph/base/profile.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

namespace perimorph::base {

const char* name(Phase phase) {
  static constexpr std::array<const char*, n_phases> names = {"read",     "search", "assemble", "preconditioner", "CG",
                                                              "residual", "bonds",  "adapt",    "write"};
  return names[static_cast<int>(phase)];
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024. * static_cast<double>(usage.ru_maxrss);
}

std::string Profile::table() const {
  const double total = elapsed();
  double rest = total;
  std::string text = fmt::format("{:<16}{:>12}{:>9}{:>10}\n", "phase", "seconds", "share", "calls");
  const auto row = [&](const char* what, double time, const std::string& calls) {
    text += fmt::format("{:<16}{:>12.3f}{:>8.1f}%{:>10}\n", what, time, 100. * time / total, calls);
  };
  for (int p = 0; p < n_phases; ++p) {
    row(name(static_cast<Phase>(p)), seconds_[p], fmt::format("{}", calls_[p]));
    rest -= seconds_[p];
  }
  row("other", rest, "");
  row("total", total, "");
  return text;
}

}  // namespace perimorph::base
