// The main program of every GoogleTest program: starts MPI, and fails on all ranks if a test failed on one.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "perimorph/base/parallel.hpp"

int main(int argc, char** argv) {
  Tpetra::ScopeGuard mpi(&argc, &argv);
  ::testing::InitGoogleTest(&argc, argv);
  const auto comm = Tpetra::getDefaultComm();
  if (comm->getRank() != 0) {
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  const int failed = RUN_ALL_TESTS();
  return perimorph::base::max(*comm, static_cast<perimorph::base::GlobalId>(failed)) == 0 ? 0 : 1;
}
