#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace perimorph::base {

/// The user's mistake: the message names file, parameter, what was found and what is allowed. Exit status 2.
struct UserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The computation cannot go on (the solver does not converge, the disk is full). Exit status 3.
struct ComputationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The memory is used up. Exit status 3.
struct MemoryError : ComputationError {
  using ComputationError::ComputationError;
};

/// Whether an error says that, of whichever library. Local.
bool is_out_of_memory(const std::exception& error);

/// A broken invariant of the program itself. Exit status 1.
struct Bug : std::logic_error {
  using std::logic_error::logic_error;
};

/// Throws a Bug that names the place, this process' rank, the condition, and the values. For the macros below.
[[noreturn]] void fail_assertion(const char* file, int line, const char* condition, const std::string& values);

}  // namespace perimorph::base

/// Throws Bug with a formatted message (fmt syntax, with the values) if the condition does not hold. Always on: for
/// what costs nothing beside the work of the function that it stands in.
#define PERIMORPH_ASSERT(condition, ...)                                                           \
  do {                                                                                             \
    if (!(condition)) {                                                                            \
      ::perimorph::base::fail_assertion(__FILE__, __LINE__, #condition, fmt::format(__VA_ARGS__)); \
    }                                                                                              \
  } while (false)

/// The same where the cost would be felt: in an inner loop, or for every item of an argument. On in the presets debug
/// and sanitize; elsewhere it is compiled and never evaluated.
#ifdef PERIMORPH_DEBUG_ASSERTIONS
#define PERIMORPH_DEBUG_ASSERT(...) PERIMORPH_ASSERT(__VA_ARGS__)
#else
#define PERIMORPH_DEBUG_ASSERT(...)           \
  do {                                        \
    if (false) PERIMORPH_ASSERT(__VA_ARGS__); \
  } while (false)
#endif
