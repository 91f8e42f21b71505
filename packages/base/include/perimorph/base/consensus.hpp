#pragma once

#include <functional>
#include <memory>

#include "perimorph/base/parallel.hpp"

namespace perimorph::base {

/// Lets all ranks agree on how work has ended that communicates and may throw on some of them only. The others may then
/// wait for that rank within the work, and would do so forever.
class Consensus {
 public:
  /// Has a communicator of its own, so that nobody takes its messages for those of the work. Collective.
  /// @param patience how long a rank that has failed waits for the others to end their work, [s]
  explicit Consensus(const Comm& comm, double patience = 5.);
  ~Consensus();
  Consensus(const Consensus&) = delete;
  Consensus& operator=(const Consensus&) = delete;

  /// Runs the work. If it threw on any rank, every rank throws that error (of the lowest such rank). If the others do
  /// not come, the failed rank says why on stderr and ends the whole job with the status of its error. Collective.
  /// @throws UserError, ComputationError (MemoryError) or Bug, the same on all ranks.
  void run(const std::function<void()>& work) const;

 private:
  struct Channel;
  std::unique_ptr<Channel> channel_;
  double patience_;
};

}  // namespace perimorph::base
