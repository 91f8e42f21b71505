// PETSc on the systems of a folder (systems.hpp): conjugate gradients with GAMG, its smoothed aggregation, blocks of
// two, rigid-body modes; the preconditioner is kept when bonds break.   perimorph_peer_petsc FOLDER [PETSc's options]

#include <petscksp.h>

#include "systems.hpp"

namespace perimorph::tests {
namespace {

PetscReal threshold = 0.02;  // as ours: without it the iterations more than double in the cracked body

void check(PetscErrorCode error) {
  if (error != 0) throw std::runtime_error("PETSc's error " + std::to_string(error));
}

class Petsc {
 public:
  Petsc(const SymmetricMatrix& matrix, const Table& load, const Table& coordinates) {
    make_matrix(matrix);
    attach_rigid_body_modes(coordinates);
    check(MatCreateVecs(matrix_, &x_, &b_));
    check(VecDuplicate(b_, &residual_));
    fill(b_, load.values);
  }
  ~Petsc() {
    KSPDestroy(&ksp_);
    for (auto* vector : {&x_, &b_, &residual_}) VecDestroy(vector);
    MatDestroy(&matrix_);
  }
  Petsc(const Petsc&) = delete;
  Petsc& operator=(const Petsc&) = delete;

  void change(const SymmetricMatrix& change) {
    for (const auto& e : change.entries) {
      check(MatSetValue(matrix_, e.row, e.column, e.value, ADD_VALUES));
      if (e.row != e.column) check(MatSetValue(matrix_, e.column, e.row, e.value, ADD_VALUES));
    }
    check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
  }

  void set_up_again() {
    check(KSPDestroy(&ksp_));
    check(KSPCreate(PETSC_COMM_SELF, &ksp_));
    check(KSPSetType(ksp_, KSPCG));
    check(KSPSetNormType(ksp_, KSP_NORM_UNPRECONDITIONED));
    check(KSPSetTolerances(ksp_, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, 1000));
    PC preconditioner;
    check(KSPGetPC(ksp_, &preconditioner));
    check(PCSetType(preconditioner, PCGAMG));
    check(PCGAMGSetThreshold(preconditioner, &threshold, 1));
    check(KSPSetFromOptions(ksp_));
    check(KSPSetOperators(ksp_, matrix_, matrix_));
    check(KSPSetUp(ksp_));
    check(VecSet(x_, 0.));
  }

  void keep_preconditioner() {
    check(KSPSetReusePreconditioner(ksp_, PETSC_TRUE));
    check(KSPSetInitialGuessNonzero(ksp_, PETSC_TRUE));
  }

  int solve() {
    check(KSPSolve(ksp_, b_, x_));
    KSPConvergedReason reason;
    check(KSPGetConvergedReason(ksp_, &reason));
    if (reason <= 0) throw std::runtime_error("PETSc did not converge, reason " + std::to_string(reason));
    PetscInt iterations;
    check(KSPGetIterationNumber(ksp_, &iterations));
    return iterations;
  }

  double relative_residual() {
    PetscReal residual, load;
    check(MatMult(matrix_, x_, residual_));
    check(VecAYPX(residual_, -1., b_));
    check(VecNorm(residual_, NORM_2, &residual));
    check(VecNorm(b_, NORM_2, &load));
    return residual / load;
  }

  double work() {
    PetscScalar product;
    check(VecDot(b_, x_, &product));
    return product;
  }

 private:
  Mat matrix_ = nullptr;
  Vec x_ = nullptr, b_ = nullptr, residual_ = nullptr;
  KSP ksp_ = nullptr;

  void make_matrix(const SymmetricMatrix& matrix) {
    std::vector<PetscInt> rows, columns;
    std::vector<PetscScalar> values;
    const auto add = [&](int row, int column, double value) {
      rows.push_back(row);
      columns.push_back(column);
      values.push_back(value);
    };
    for (const auto& e : matrix.entries) {
      add(e.row, e.column, e.value);
      if (e.row != e.column) add(e.column, e.row, e.value);
    }
    check(MatCreate(PETSC_COMM_SELF, &matrix_));
    check(MatSetSizes(matrix_, matrix.n, matrix.n, matrix.n, matrix.n));
    check(MatSetType(matrix_, MATSEQAIJ));
    check(MatSetBlockSize(matrix_, 2));
    check(MatSetPreallocationCOO(matrix_, static_cast<PetscCount>(values.size()), rows.data(), columns.data()));
    check(MatSetValuesCOO(matrix_, values.data(), INSERT_VALUES));
    check(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));
    check(MatSetOption(matrix_, MAT_NEW_NONZERO_LOCATION_ERR, PETSC_TRUE));
  }

  void attach_rigid_body_modes(const Table& coordinates) {
    Vec positions;
    check(VecCreateSeq(PETSC_COMM_SELF, 2 * coordinates.n_rows, &positions));
    check(VecSetBlockSize(positions, 2));
    std::vector<double> by_node;
    for (int n = 0; n < coordinates.n_rows; ++n) {
      by_node.push_back(coordinates.values[n]);
      by_node.push_back(coordinates.values[coordinates.n_rows + n]);
    }
    fill(positions, by_node);
    MatNullSpace modes;
    check(MatNullSpaceCreateRigidBody(positions, &modes));
    check(MatSetNearNullSpace(matrix_, modes));
    check(MatNullSpaceDestroy(&modes));
    check(VecDestroy(&positions));
  }

  static void fill(Vec vector, const std::vector<double>& values) {
    PetscScalar* target;
    check(VecGetArray(vector, &target));
    std::copy(values.begin(), values.end(), target);
    check(VecRestoreArray(vector, &target));
  }
};

void solve(const std::string& state, Petsc& petsc, bool from_scratch) {
  Cost cost{};
  const Stopwatch set_up;
  if (from_scratch) petsc.set_up_again();
  cost.set_up = set_up.seconds();
  const Stopwatch solution;
  cost.iterations = petsc.solve();
  cost.solve = solution.seconds();
  cost.residual = petsc.relative_residual();
  cost.work = petsc.work();
  report(state, cost);
}

void run(const std::string& folder) {
  Petsc petsc(read_matrix(folder + "/matrix.mtx"), read_table(folder + "/load.mtx"),
              read_table(folder + "/coordinates.mtx"));
  solve("intact", petsc, true);
  petsc.change(read_matrix(change_file(folder, 1)));
  solve("cracked", petsc, true);
  petsc.keep_preconditioner();
  for (int k = 2; k <= 1 + n_advances; ++k) {
    petsc.change(read_matrix(change_file(folder, k)));
    solve("advanced", petsc, false);
  }
}

}  // namespace
}  // namespace perimorph::tests

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::string folder = argv[1];
  int status = 0;
  PetscInitialize(&argc, &argv, nullptr, nullptr);
  try {
    perimorph::tests::run(folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "perimorph_peer_petsc: %s\n", error.what());
    status = 1;
  }
  PetscFinalize();
  return status;
}
