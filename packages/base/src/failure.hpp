#pragma once

#include <functional>
#include <string>

namespace perimorph::base {

/// How a piece of work ended on one rank, in a form that can travel to the others.
struct Failure {
  enum class Kind : int { none, user, memory, computation, bug };

  Kind kind = Kind::none;
  std::string message;

  bool has_happened() const { return kind != Kind::none; }
};

/// Runs the work and catches what it throws. Local.
Failure failure_of(const std::function<void()>& work);

/// Throws the error of the same kind. Local.
[[noreturn]] void raise(const Failure& failure);

/// The exit status that stands for it.
int exit_status(Failure::Kind kind);

}  // namespace perimorph::base
