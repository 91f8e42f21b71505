#pragma once

#include <string>

#include "perimorph/base/parallel.hpp"

namespace perimorph::base {

/// While one of these lives, SIGTERM, SIGINT, SIGHUP (unless it was ignored) and SIGUSR1 do not end the program but are
/// noted as requests, for a computation that asks for them where it can stop. A second one of the first three ends the
/// program at once; once the ranks have agreed to stop and this object is gone, they are ignored. One at a time:
/// signals belong to the process.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// What signals on any rank have asked for.
  struct Requests {
    std::string stop;  ///< the name of the signal that asks the run to stop, or ""
    bool checkpoint;   ///< whether SIGUSR1 came since the last call
  };
  /// Collective.
  Requests look(const Comm& comm);

  /// Whether a signal has asked this process to stop, for what waits where no other can be asked. Local.
  static bool is_stop_asked();

 private:
  /// Whether all ranks know of a request to stop: one that reaches this rank later still is the same, not another.
  bool ends_ = false;
  void (*old_terminate_)(int);
  void (*old_interrupt_)(int);
  void (*old_hang_up_)(int);
  void (*old_user_)(int);
};

}  // namespace perimorph::base
