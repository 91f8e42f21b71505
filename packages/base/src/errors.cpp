#include "perimorph/base/errors.hpp"

#include <mpi.h>

#include <new>

namespace perimorph::base {

namespace {

/// Of this process among all, also in a program that has not begun with MPI or is done with it.
int rank_of_process() {
  int has_begun = 0, is_over = 0, rank = 0;
  MPI_Initialized(&has_begun);
  MPI_Finalized(&is_over);
  if (has_begun != 0 && is_over == 0) MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

}  // namespace

bool is_out_of_memory(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return true;
  if (dynamic_cast<const MemoryError*>(&error) != nullptr) return true;
  const std::string what = error.what();  // Kokkos throws a std::runtime_error; Tpetra another, with what it has caught
  return what.rfind("Kokkos failed to allocate memory", 0) == 0 || what.find("std::bad_alloc") != std::string::npos;
}

void fail_assertion(const char* file, int line, const char* condition, const std::string& values) {
  throw Bug(fmt::format("{}:{}: rank {}: {} does not hold: {}", file, line, rank_of_process(), condition, values));
}

}  // namespace perimorph::base
