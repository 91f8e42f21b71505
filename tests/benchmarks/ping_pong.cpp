// What messages between two ranks take, for tools/studies/predict-scaling: prints the latency of one, how much longer
// each of several takes that are sent at once [s], and the bandwidth of long ones [B/s].   mpirun -n 2
// perimorph_ping_pong

#include <mpi.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <vector>

namespace {

/// From one rank to the other, `n_messages` of `n_bytes` at once: half of there and back, in the fastest of many
/// batches [s]. Collective.
double one_way(int n_messages, int n_bytes) {
  constexpr int n_batches = 100, in_batch = 20;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  std::vector<char> data(static_cast<std::size_t>(n_messages) * n_bytes);
  std::vector<MPI_Request> requests(n_messages);
  const auto pass = [&](bool sends) {
    for (int m = 0; m < n_messages; ++m) {
      char* const message = &data[static_cast<std::size_t>(m) * n_bytes];
      if (sends) {
        MPI_Isend(message, n_bytes, MPI_CHAR, 1 - rank, m, MPI_COMM_WORLD, &requests[m]);
      } else {
        MPI_Irecv(message, n_bytes, MPI_CHAR, 1 - rank, m, MPI_COMM_WORLD, &requests[m]);
      }
    }
    MPI_Waitall(n_messages, requests.data(), MPI_STATUSES_IGNORE);
  };
  double fastest = std::numeric_limits<double>::max();
  for (int batch = 0; batch < n_batches; ++batch) {
    MPI_Barrier(MPI_COMM_WORLD);
    const double begin = MPI_Wtime();
    for (int n = 0; n < in_batch; ++n) {
      pass(rank == 0);
      pass(rank == 1);
    }
    fastest = std::min(fastest, (MPI_Wtime() - begin) / (2 * in_batch));
  }
  return fastest;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, n_ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  if (n_ranks == 2) {
    constexpr int several = 9, length = 1 << 18;
    const double one = one_way(1, 8), more = one_way(several, 8);
    const double overhead = (more - one) / (several - 1);
    const double bandwidth = length / (one_way(1, length) - one);
    if (rank == 0) std::printf("%g %g %g\n", one - overhead, overhead, bandwidth);
  }
  MPI_Finalize();
  return n_ranks == 2 ? 0 : 2;
}
