#pragma once

#include <fmt/format.h>

#include <stdexcept>

namespace perimorph::base {

/// The user's mistake: the message names file, parameter, what was found and what is allowed. Exit status 2.
struct UserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The computation cannot go on (the solver does not converge, the disk is full). Exit status 3.
struct ComputationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A broken invariant of the program itself. Exit status 1.
struct Bug : std::logic_error {
  using std::logic_error::logic_error;
};

}  // namespace perimorph::base

/// Throws Bug with a formatted message (fmt syntax, with the values) if the condition does not hold. Always on.
#define PERIMORPH_ASSERT(condition, ...)                                                                      \
  do {                                                                                                        \
    if (!(condition)) {                                                                                       \
      throw ::perimorph::base::Bug(fmt::format("{}:{}: {} does not hold: ", __FILE__, __LINE__, #condition) + \
                                   fmt::format(__VA_ARGS__));                                                 \
    }                                                                                                         \
  } while (false)
