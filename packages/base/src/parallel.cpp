#include "perimorph/base/parallel.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultMpiComm.hpp>

#include "failure.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::base {

namespace {

std::string broadcast_from(const Comm& comm, int root, std::string text) {
  PERIMORPH_ASSERT(root >= 0 && root < comm.getSize(), "rank {} of {}", root, comm.getSize());
  int length = static_cast<int>(text.size());
  Teuchos::broadcast(comm, root, &length);
  text.resize(length);
  Teuchos::broadcast(comm, root, length, text.data());
  return text;
}

template <class T>
T reduce(const Comm& comm, Teuchos::EReductionType operation, T value) {
  T result = value;
  Teuchos::reduceAll(comm, operation, value, Teuchos::outArg(result));
  return result;
}

/// Whether all ranks have the same number. Collective: it ends on all of them, whatever they have.
bool is_alike(const Comm& comm, std::size_t n) {
  const auto value = static_cast<GlobalId>(n);
  const GlobalId smallest = reduce(comm, Teuchos::REDUCE_MIN, value);
  const GlobalId largest = reduce(comm, Teuchos::REDUCE_MAX, value);
  return smallest == largest;
}

}  // namespace

MPI_Comm mpi_communicator(const Comm& comm) {
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  if (mpi == nullptr) return MPI_COMM_SELF;
  return *mpi->getRawMpiComm();
}

void on_all_ranks(const Comm& comm, const std::function<void()>& local_work) {
  const Failure failure = failure_of(local_work);
  const int first_failed = reduce(comm, Teuchos::REDUCE_MIN, failure.has_happened() ? comm.getRank() : comm.getSize());
  if (first_failed == comm.getSize()) return;
  int kind = static_cast<int>(failure.kind);
  Teuchos::broadcast(comm, first_failed, &kind);
  raise({static_cast<Failure::Kind>(kind), broadcast_from(comm, first_failed, failure.message)});
}

double sum(const Comm& comm, double value) { return reduce(comm, Teuchos::REDUCE_SUM, value); }
GlobalId sum(const Comm& comm, GlobalId value) { return reduce(comm, Teuchos::REDUCE_SUM, value); }
double max(const Comm& comm, double value) { return reduce(comm, Teuchos::REDUCE_MAX, value); }
GlobalId max(const Comm& comm, GlobalId value) { return reduce(comm, Teuchos::REDUCE_MAX, value); }

void sum(const Comm& comm, std::vector<double>& values) {
  PERIMORPH_DEBUG_ASSERT(is_alike(comm, values.size()), "{} values here, other ranks have more or fewer",
                         values.size());
  const std::vector<double> local = values;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(local.size()), local.data(), values.data());
}

std::string broadcast(const Comm& comm, std::string text) { return broadcast_from(comm, 0, std::move(text)); }

}  // namespace perimorph::base
