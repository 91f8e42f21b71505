#include "failure.hpp"

#include "perimorph/base/errors.hpp"

namespace perimorph::base {

Failure failure_of(const std::function<void()>& work) {
  using Kind = Failure::Kind;
  try {
    work();
    return {};
  } catch (const UserError& error) {
    return {Kind::user, error.what()};
  } catch (const MemoryError& error) {
    return {Kind::memory, error.what()};
  } catch (const ComputationError& error) {
    return {Kind::computation, error.what()};
  } catch (const std::exception& error) {
    if (is_out_of_memory(error)) return {Kind::memory, "there is no memory left"};
    return {Kind::bug, error.what()};
  }
}

void raise(const Failure& failure) {
  using Kind = Failure::Kind;
  PERIMORPH_ASSERT(failure.has_happened(), "nothing has failed: {}", failure.message);
  if (failure.kind == Kind::user) throw UserError(failure.message);
  if (failure.kind == Kind::memory) throw MemoryError(failure.message);
  if (failure.kind == Kind::computation) throw ComputationError(failure.message);
  throw Bug(failure.message);
}

int exit_status(Failure::Kind kind) {
  using Kind = Failure::Kind;
  if (kind == Kind::none) return 0;
  if (kind == Kind::user) return 2;
  return kind == Kind::bug ? 1 : 3;
}

}  // namespace perimorph::base
