#pragma once

#include <string>

#include "perimorph/base/parallel.hpp"

namespace perimorph::base {

/// While one of these lives, SIGTERM, SIGINT and SIGUSR1 do not end the program but are noted, for a computation that
/// looks at them where it can stop. A second SIGTERM or SIGINT ends the program at once. One at a time: signals
/// belong to the process.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// What came on any rank since the beginning: the name of the signal to stop at ("" if none came), and whether
  /// SIGUSR1 came since the last look. Collective.
  struct Requests {
    std::string stop;
    bool checkpoint;
  };
  Requests look(const Comm& comm);

 private:
  void (*old_terminate_)(int);
  void (*old_interrupt_)(int);
  void (*old_user_)(int);
};

}  // namespace perimorph::base
