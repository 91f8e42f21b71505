#include "perimorph/base/consensus.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <sched.h>

#include <cstdio>

#include "failure.hpp"

namespace perimorph::base {

struct Consensus::Channel {
  MPI_Comm comm = MPI_COMM_NULL;
  int rank = 0, n_ranks = 1;

  explicit Channel(MPI_Comm other) {
    MPI_Comm_dup(other, &comm);
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &n_ranks);
  }
  ~Channel() { MPI_Comm_free(&comm); }
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  /// The lowest rank that has failed, or the number of ranks. Collective.
  /// @param give_up called when the others have not come in so many seconds; never if that is 0
  template <class Action>
  int first_failed(bool has_failed, double patience, const Action& give_up) const {
    const int mine = has_failed ? rank : n_ranks;
    int lowest = n_ranks;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallreduce(&mine, &lowest, 1, MPI_INT, MPI_MIN, comm, &request);
    const double start = MPI_Wtime();
    for (int is_complete = 0;;) {
      MPI_Test(&request, &is_complete, MPI_STATUS_IGNORE);
      if (is_complete != 0) return lowest;
      if (patience > 0. && MPI_Wtime() - start > patience) give_up();
      sched_yield();
    }
  }

  /// The failure of that rank on all ranks. Collective.
  Failure shared(Failure failure, int root) const {
    int numbers[2] = {static_cast<int>(failure.kind), static_cast<int>(failure.message.size())};
    MPI_Bcast(numbers, 2, MPI_INT, root, comm);
    failure.kind = static_cast<Failure::Kind>(numbers[0]);
    failure.message.resize(static_cast<std::size_t>(numbers[1]));
    MPI_Bcast(failure.message.data(), numbers[1], MPI_CHAR, root, comm);
    return failure;
  }
};

Consensus::Consensus(const Comm& comm, double patience)
    : channel_(std::make_unique<Channel>(mpi_communicator(comm))), patience_(patience) {
  PERIMORPH_ASSERT(patience > 0., "patience of {} s", patience);
}

Consensus::~Consensus() = default;

void Consensus::run(const std::function<void()>& work) const {
  const Failure failure = failure_of(work);
  const auto end_the_job = [&] {
    std::fprintf(stderr, "perimorph: rank %d alone: %s; the other ranks wait for it: all are ended\n", channel_->rank,
                 failure.message.c_str());
    MPI_Abort(channel_->comm, exit_status(failure.kind));
  };
  const int first =
      channel_->first_failed(failure.has_happened(), failure.has_happened() ? patience_ : 0., end_the_job);
  if (first < channel_->n_ranks) raise(channel_->shared(failure, first));
}

}  // namespace perimorph::base
