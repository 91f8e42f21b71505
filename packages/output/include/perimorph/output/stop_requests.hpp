#pragma once

#include <string>

#include "perimorph/base/signals.hpp"

namespace perimorph::output {

/// What signals have asked a run for. One at a time, since signals belong to the process.
class StopRequests {
 public:
  /// Whether the run is to stop. Collective.
  bool stop_requested(const base::Comm& comm);

  /// The signal that asked it to, "" if none did. Local.
  const std::string& signal() const { return signal_; }

  /// Whether a checkpoint was asked for since the last call. The same on all ranks. Local.
  bool take_checkpoint_request();

 private:
  base::Signals signals_;
  std::string signal_;
  bool checkpoint_requested_ = false;
};

}  // namespace perimorph::output
