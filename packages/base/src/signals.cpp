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

}  // namespace

Signals::Signals() {
  PERIMORPH_ASSERT(!is_noting, "signals are noted already: {}", is_noting);
  is_noting = true;
  stop_signal = checkpoint_asked = 0;
  old_terminate_ = std::signal(SIGTERM, note_stop);
  old_interrupt_ = std::signal(SIGINT, note_stop);
  old_user_ = std::signal(SIGUSR1, note_checkpoint);
}

Signals::~Signals() {
  is_noting = false;
  std::signal(SIGTERM, old_terminate_);
  std::signal(SIGINT, old_interrupt_);
  std::signal(SIGUSR1, old_user_);
}

Signals::Requests Signals::look(const Comm& comm) {
  const bool is_asked = checkpoint_asked != 0;
  checkpoint_asked = 0;
  const GlobalId stop = max(comm, static_cast<GlobalId>(stop_signal));
  const GlobalId asked = max(comm, static_cast<GlobalId>(is_asked));
  return {stop == 0 ? "" : stop == SIGINT ? "SIGINT" : "SIGTERM", asked > 0};
}

}  // namespace perimorph::base
