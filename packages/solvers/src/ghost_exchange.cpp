#include "ghost_exchange.hpp"

#include <Tpetra_Map.hpp>
#include <algorithm>
#include <cstring>

#include "perimorph/base/errors.hpp"

namespace perimorph::solvers {

using base::GlobalId;

template <int size>
GhostExchange<size>::GhostExchange(const Teuchos::RCP<const Map>& owned, const Map& columns)
    : owned_(owned),
      base_(owned->getIndexBase()),
      n_owned_(static_cast<int>(owned->getNodeNumElements()) / size),
      comm_(base::mpi_communicator(*owned->getComm())) {
  PERIMORPH_ASSERT(owned->getNodeNumElements() % size == 0, "{} numbers are no blocks of {}",
                   owned->getNodeNumElements(), size);
  const base::Comm& comm = *owned->getComm();
  for (std::size_t i = 0; i < columns.getNodeNumElements(); ++i) {
    const GlobalId number = columns.getGlobalElement(static_cast<int>(i));
    if (!owned->isNodeGlobalElement(number)) ghosts_.push_back((number - base_) / size);
  }
  std::sort(ghosts_.begin(), ghosts_.end());
  ghosts_.erase(std::unique(ghosts_.begin(), ghosts_.end()), ghosts_.end());

  std::vector<GlobalId> numbers;
  for (const GlobalId block : ghosts_) numbers.push_back(block * size + base_);
  std::vector<int> owners(numbers.size());
  owned->getRemoteIndexList(Teuchos::arrayViewFromVector(numbers), Teuchos::arrayViewFromVector(owners));

  // Ranks own ascending ranges, so blocks in ascending order are also grouped by owner.
  std::vector<std::vector<GlobalId>> wanted(comm.getSize());
  for (std::size_t i = 0; i < ghosts_.size(); ++i) wanted[owners[i]].push_back(numbers[i]);
  const auto asked = base::exchange(comm, wanted);
  int first = n_owned_;
  std::size_t n_sent = 0;
  for (int rank = 0; rank < comm.getSize(); ++rank) {
    if (wanted[rank].empty() && asked[rank].empty()) continue;
    Neighbour neighbour{rank, {}, first, static_cast<int>(wanted[rank].size())};
    first += neighbour.n_received;
    n_sent += asked[rank].size();
    for (const GlobalId number : asked[rank]) neighbour.sent.push_back(owned->getLocalElement(number) / size);
    neighbours_.push_back(std::move(neighbour));
  }
  outgoing_.resize(n_sent * size);
  requests_.resize(2 * neighbours_.size());
}

template <int size>
int GhostExchange<size>::local_block(GlobalId number) const {
  const int local = owned_->getLocalElement(number);
  if (local >= 0) return local / size;
  const auto place = std::lower_bound(ghosts_.begin(), ghosts_.end(), (number - base_) / size);
  PERIMORPH_DEBUG_ASSERT(place != ghosts_.end() && *place == (number - base_) / size, "number {} is not held here",
                         number);
  return n_owned_ + static_cast<int>(place - ghosts_.begin());
}

template <int size>
void GhostExchange<size>::update(std::vector<float>& x) const {
  PERIMORPH_DEBUG_ASSERT(x.size() >= static_cast<std::size_t>(n_owned_ + ghosts_.size()) * size,
                         "{} numbers for {} blocks", x.size(), n_owned_ + ghosts_.size());
  constexpr int tag = 4711;
  float* out = outgoing_.data();
  MPI_Request* request = requests_.data();
  for (const auto& neighbour : neighbours_) {
    MPI_Irecv(x.data() + static_cast<std::ptrdiff_t>(neighbour.first_received) * size, neighbour.n_received * size,
              MPI_FLOAT, neighbour.rank, tag, comm_, request++);
    const float* begin = out;
    for (const int block : neighbour.sent) {
      std::memcpy(out, x.data() + static_cast<std::ptrdiff_t>(block) * size, size * sizeof(float));
      out += size;
    }
    MPI_Isend(begin, static_cast<int>(out - begin), MPI_FLOAT, neighbour.rank, tag, comm_, request++);
  }
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

template class GhostExchange<2>;
template class GhostExchange<3>;
template class GhostExchange<6>;

}  // namespace perimorph::solvers
