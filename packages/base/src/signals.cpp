#include "perimorph/base/signals.hpp"

#include <csignal>

#include "perimorph/base/errors.hpp"

namespace perimorph::base {

namespace {

// Signal handlers reach nothing but what is global.
volatile std::sig_atomic_t stop_signal = 0;
volatile std::sig_atomic_t checkpoint_asked = 0;
bool is_noting = false;  // there is one Signals at a time

void note_stop(int signal) {
  stop_signal = signal;
  std::signal(signal, SIG_DFL);
}

void note_checkpoint(int) { checkpoint_asked = 1; }

const char* name_of(int signal) {
  if (signal == SIGINT) return "SIGINT";
  if (signal == SIGHUP) return "SIGHUP";
  return signal == 0 ? "" : "SIGTERM";
}

}  // namespace

Signals::Signals() {
  PERIMORPH_ASSERT(!is_noting, "signals are noted already: {}", is_noting);
  is_noting = true;
  stop_signal = checkpoint_asked = 0;
  old_terminate_ = std::signal(SIGTERM, note_stop);
  old_interrupt_ = std::signal(SIGINT, note_stop);
  old_hang_up_ = std::signal(SIGHUP, note_stop);
  if (old_hang_up_ == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  old_user_ = std::signal(SIGUSR1, note_checkpoint);
}

Signals::~Signals() {
  is_noting = false;
  std::signal(SIGTERM, ends_ ? SIG_IGN : old_terminate_);
  std::signal(SIGINT, ends_ ? SIG_IGN : old_interrupt_);
  std::signal(SIGHUP, ends_ ? SIG_IGN : old_hang_up_);
  std::signal(SIGUSR1, old_user_);
}

Signals::Requests Signals::look(const Comm& comm) {
  const bool is_asked = checkpoint_asked != 0;
  if (is_asked) checkpoint_asked = 0;  // otherwise one that comes just now would be lost
  const GlobalId stop = max(comm, static_cast<GlobalId>(stop_signal));
  const GlobalId asked = max(comm, static_cast<GlobalId>(is_asked));
  ends_ = ends_ || stop != 0;
  return {name_of(static_cast<int>(stop)), asked > 0};
}

bool Signals::is_stop_asked() { return stop_signal != 0; }

}  // namespace perimorph::base
