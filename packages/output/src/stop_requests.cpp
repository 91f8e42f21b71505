#include "perimorph/output/stop_requests.hpp"

#include <utility>

namespace perimorph::output {

bool StopRequests::stop_requested(const base::Comm& comm) {
  const auto requests = signals_.look(comm);
  checkpoint_requested_ = checkpoint_requested_ || requests.checkpoint;
  signal_ = requests.stop;
  return !signal_.empty();
}

bool StopRequests::take_checkpoint_request() { return std::exchange(checkpoint_requested_, false); }

}  // namespace perimorph::output
