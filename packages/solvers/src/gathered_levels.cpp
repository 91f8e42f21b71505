#include "gathered_levels.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <algorithm>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::solvers {

namespace {

using Map = Teuchos::RCP<const Tpetra::Map<>>;

/// The same numbers, held by the first of each of `n_holders` groups of consecutive ranks. Collective.
Map on_fewer_ranks(const Tpetra::Map<>& map, int n_holders) {
  const auto comm = map.getComm();
  const int n_ranks = comm->getSize();
  const auto group = [&](int rank) { return static_cast<long>(rank) * n_holders / n_ranks; };
  const auto n_rows = base::gather_on_all(*comm, std::vector{map.getNodeNumElements()});
  const int here = comm->getRank();
  std::size_t n_here = 0;
  if (here == 0 || group(here - 1) != group(here)) {
    for (int rank = here; rank < n_ranks && group(rank) == group(here); ++rank) n_here += n_rows[rank];
  }
  return Teuchos::rcp(new Tpetra::Map<>(map.getGlobalNumElements(), n_here, map.getIndexBase(), comm));
}

Teuchos::RCP<const Matrix> moved(const Teuchos::RCP<const Matrix>& matrix, const Map& rows, const Map& columns) {
  const auto longest = base::max(*rows->getComm(), static_cast<base::GlobalId>(matrix->getNodeMaxNumRowEntries()));
  const auto result = Teuchos::rcp(new Matrix(rows, static_cast<std::size_t>(longest)));
  result->doImport(*matrix, Tpetra::Import<>(matrix->getRowMap(), rows), Tpetra::INSERT);
  result->fillComplete(columns, rows);
  return result;
}

}  // namespace

int n_holders_of(const Matrix& matrix, int most, int fewest_rows) {
  return static_cast<int>(
      std::clamp(matrix.getGlobalNumRows() / fewest_rows, Tpetra::global_size_t{1}, Tpetra::global_size_t(most)));
}

std::size_t first_on_fewer_ranks(const std::vector<CycleLevel>& levels, int n_ranks, int fewest_rows) {
  for (std::size_t l = 1; l < levels.size(); ++l) {
    if (n_holders_of(*levels[l].matrix, n_ranks, fewest_rows) < n_ranks) return l;
  }
  return levels.size();
}

std::vector<CycleLevel> gather_small_levels(std::vector<CycleLevel> levels, int n_ranks, int fewest_rows) {
  PERIMORPH_ASSERT(n_ranks >= 1 && fewest_rows >= 1, "{} rows on {} ranks", fewest_rows, n_ranks);
  Map fine = levels.front().matrix->getRowMap();
  int n_fine_holders = n_ranks;
  for (std::size_t l = 1; l < levels.size(); ++l) {
    const int n_holders = n_holders_of(*levels[l].matrix, n_fine_holders, fewest_rows);
    if (n_holders == n_ranks) {
      fine = levels[l].matrix->getRowMap();
      continue;
    }
    const Map coarse = on_fewer_ranks(*levels[l].matrix->getRowMap(), n_holders);
    levels[l].matrix = moved(levels[l].matrix, coarse, coarse);
    levels[l - 1].restriction = moved(levels[l - 1].restriction, coarse, fine);
    levels[l - 1].prolongation = moved(levels[l - 1].prolongation, fine, coarse);
    fine = coarse;
    n_fine_holders = n_holders;
  }
  return levels;
}

}  // namespace perimorph::solvers
