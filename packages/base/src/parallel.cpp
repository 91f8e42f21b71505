#include "perimorph/base/parallel.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultMpiComm.hpp>

#include "perimorph/base/errors.hpp"

namespace perimorph::base {

namespace {

enum class Failure : int { none, user, computation, bug };

[[noreturn]] void raise(Failure failure, const std::string& message) {
  if (failure == Failure::user) throw UserError(message);
  if (failure == Failure::computation) throw ComputationError(message);
  throw Bug(message);
}

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

}  // namespace

MPI_Comm mpi_communicator(const Comm& comm) {
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  if (mpi == nullptr) return MPI_COMM_SELF;
  return *mpi->getRawMpiComm();
}

void on_all_ranks(const Comm& comm, const std::function<void()>& local_work) {
  Failure failure = Failure::none;
  std::string message;
  try {
    local_work();
  } catch (const UserError& error) {
    failure = Failure::user;
    message = error.what();
  } catch (const ComputationError& error) {
    failure = Failure::computation;
    message = error.what();
  } catch (const std::exception& error) {
    failure = Failure::bug;
    message = error.what();
  }
  const int first_failed =
      reduce(comm, Teuchos::REDUCE_MIN, failure == Failure::none ? comm.getSize() : comm.getRank());
  if (first_failed == comm.getSize()) return;
  int kind = static_cast<int>(failure);
  Teuchos::broadcast(comm, first_failed, &kind);
  raise(static_cast<Failure>(kind), broadcast_from(comm, first_failed, message));
}

double sum(const Comm& comm, double value) { return reduce(comm, Teuchos::REDUCE_SUM, value); }
GlobalId sum(const Comm& comm, GlobalId value) { return reduce(comm, Teuchos::REDUCE_SUM, value); }
double max(const Comm& comm, double value) { return reduce(comm, Teuchos::REDUCE_MAX, value); }
GlobalId max(const Comm& comm, GlobalId value) { return reduce(comm, Teuchos::REDUCE_MAX, value); }

void sum(const Comm& comm, std::vector<double>& values) {
  const auto n = static_cast<GlobalId>(values.size());
  PERIMORPH_DEBUG_ASSERT(max(comm, n) == n && max(comm, -n) == -n, "{} values here, other ranks have more or fewer", n);
  const std::vector<double> local = values;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(local.size()), local.data(), values.data());
}

std::string broadcast(const Comm& comm, std::string text) { return broadcast_from(comm, 0, std::move(text)); }

}  // namespace perimorph::base
