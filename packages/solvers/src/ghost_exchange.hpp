#pragma once

#include <mpi.h>

#include <Teuchos_RCP.hpp>
#include <Tpetra_Map_fwd.hpp>
#include <vector>

#include "perimorph/base/parallel.hpp"

namespace perimorph::solvers {

/// Copies of other ranks' blocks of numbers at the end of a vector, and how they are brought up to date.
template <int size>
class GhostExchange {
 public:
  using Map = Tpetra::Map<>;

  /// @param owned numbers of this rank, in whole blocks; @param columns all that this rank needs. Collective.
  GhostExchange(const Teuchos::RCP<const Map>& owned, const Map& columns);

  int n_owned() const { return n_owned_; }
  int n_all() const { return n_owned_ + static_cast<int>(ghosts_.size()); }

  /// The block that a global number belongs to: owned, or the place of its copy.
  int local_block(base::GlobalId number) const;
  int component(base::GlobalId number) const { return static_cast<int>((number - base_) % size); }

  /// Overwrites the copies in x, (n_all, size). Collective.
  void update(std::vector<float>& x) const;

 private:
  Teuchos::RCP<const Map> owned_;
  base::GlobalId base_;
  int n_owned_;
  std::vector<base::GlobalId> ghosts_;  ///< global blocks, by owner and ascending
  struct Neighbour {
    int rank;
    std::vector<int> sent;           ///< owned blocks
    int first_received, n_received;  ///< blocks
  };
  std::vector<Neighbour> neighbours_;
  MPI_Comm comm_;
  mutable std::vector<float> outgoing_;
  mutable std::vector<MPI_Request> requests_;
};

}  // namespace perimorph::solvers
