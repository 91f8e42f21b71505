#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "perimorph/cases/load_table.hpp"
#include "perimorph/discretization/amplitude.hpp"
#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"

namespace perimorph::cases {

/// A stage of the load: so many increments, at the end of which conditions have reached values.
struct Step {
  std::string name;
  int increments = 1;  ///< with cycles, of each
  std::vector<std::string> conditions;
  std::vector<double> values;         ///< of each condition, by which its rate is multiplied, [-]
  std::vector<LoadTable> tables;      ///< of other conditions
  std::optional<int> cycles;          ///< so often to the values and back, and through the tables
  std::vector<std::string> released;  ///< conditions that end where it begins
  std::vector<std::string> started;   ///< conditions that begin with it

  double all_increments() const { return static_cast<double>(increments) * cycles.value_or(1); }
};

void declare(const input::Section& section, Step& step);

/// @param root of the case: steps name conditions
/// @param folder where the names of tables start
void check_steps(const input::Values& root, const std::string& folder);

/// Of steps without mistakes.
void read_tables(const std::string& folder, std::vector<Step>& steps);

/// The tables' rows, a line each: they decide what a run computes.
std::string listing_of_tables(const std::vector<Step>& steps);

/// What a condition's rate is multiplied by over the increments: 0 at first, linear to a value or by a table within the
/// step that names it, and held otherwise. Local.
std::shared_ptr<const discretization::Amplitude> amplitude_of(const std::string& condition,
                                                              const std::vector<Step>& steps);

/// The increment after which a condition is released; infinity if it never is. Local.
double end_of(const std::string& condition, const std::vector<Step>& steps);
/// The increment after which it begins; minus infinity if it holds from the first. Local.
double begin_of(const std::string& condition, const std::vector<Step>& steps);

}  // namespace perimorph::cases
