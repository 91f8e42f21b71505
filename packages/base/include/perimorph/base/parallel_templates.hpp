#pragma once

#include <mpi.h>

#include <limits>
#include <numeric>
#include <type_traits>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::base {

/// The MPI communicator behind a Teuchos one (MPI_COMM_SELF for a serial one).
MPI_Comm mpi_communicator(const Comm& comm);

namespace detail {
/// MPI counts and displacements in bytes are ints: items are sent as one MPI type of sizeof(T) bytes.
class ItemType {
 public:
  explicit ItemType(std::size_t bytes) {
    MPI_Type_contiguous(static_cast<int>(bytes), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~ItemType() { MPI_Type_free(&type_); }
  ItemType(const ItemType&) = delete;
  ItemType& operator=(const ItemType&) = delete;
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

inline std::vector<int> offsets(const std::vector<int>& counts) {
  const long long total = std::accumulate(counts.begin(), counts.end(), 0LL);
  PERIMORPH_ASSERT(total <= std::numeric_limits<int>::max(), "a message of {} items", total);
  std::vector<int> first(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), first.begin() + 1);
  return first;
}
}  // namespace detail

template <class T>
std::vector<T> gather_on_root(const Comm& comm, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const MPI_Comm mpi = mpi_communicator(comm);
  const int count = static_cast<int>(values.size());
  std::vector<int> counts(comm.getSize());
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, mpi);
  const std::vector<int> first = detail::offsets(counts);
  std::vector<T> all(comm.getRank() == 0 ? first.back() : 0);
  const detail::ItemType item(sizeof(T));
  MPI_Gatherv(values.data(), count, item, all.data(), counts.data(), first.data(), item, 0, mpi);
  return all;
}

template <class T>
std::vector<T> gather_on_all(const Comm& comm, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> all = values;
  if (comm.getSize() > 1) {
    const MPI_Comm mpi = mpi_communicator(comm);
    const int count = static_cast<int>(values.size());
    std::vector<int> counts(comm.getSize());
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, mpi);
    const std::vector<int> first = detail::offsets(counts);
    all.resize(first.back());
    const detail::ItemType item(sizeof(T));
    MPI_Allgatherv(values.data(), count, item, all.data(), counts.data(), first.data(), item, mpi);
  }
  return all;
}

template <class T>
std::vector<std::vector<T>> exchange(const Comm& comm, const std::vector<std::vector<T>>& outgoing) {
  static_assert(std::is_trivially_copyable_v<T>);
  const MPI_Comm mpi = mpi_communicator(comm);
  const int n_ranks = comm.getSize();
  PERIMORPH_ASSERT(static_cast<int>(outgoing.size()) == n_ranks, "messages to {} of {} ranks", outgoing.size(),
                   n_ranks);
  if (n_ranks == 1) return outgoing;
  std::vector<int> send_counts(n_ranks), receive_counts(n_ranks);
  for (int r = 0; r < n_ranks; ++r) send_counts[r] = static_cast<int>(outgoing[r].size());
  MPI_Alltoall(send_counts.data(), 1, MPI_INT, receive_counts.data(), 1, MPI_INT, mpi);

  std::vector<T> send, receive;
  for (const auto& part : outgoing) send.insert(send.end(), part.begin(), part.end());
  const std::vector<int> send_first = detail::offsets(send_counts), receive_first = detail::offsets(receive_counts);
  receive.resize(receive_first.back());
  const detail::ItemType item(sizeof(T));
  MPI_Alltoallv(send.data(), send_counts.data(), send_first.data(), item, receive.data(), receive_counts.data(),
                receive_first.data(), item, mpi);

  std::vector<std::vector<T>> incoming(n_ranks);
  for (int r = 0; r < n_ranks; ++r) {
    incoming[r].assign(receive.begin() + receive_first[r], receive.begin() + receive_first[r + 1]);
  }
  return incoming;
}

}  // namespace perimorph::base
