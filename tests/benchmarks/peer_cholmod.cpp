// CHOLMOD on the systems of a folder (systems.hpp): supernodal factorisation; the symbolic analysis is kept when bonds
// break.   perimorph_peer_cholmod FOLDER

#include <cholmod.h>

#include <algorithm>
#include <numeric>

#include "systems.hpp"

namespace perimorph::tests {
namespace {

class Cholmod {
 public:
  Cholmod(const SymmetricMatrix& matrix, Table& load) {
    cholmod_l_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.final_ll = true;
    auto* triplets = cholmod_l_allocate_triplet(matrix.n, matrix.n, matrix.entries.size(), -1, CHOLMOD_REAL, &common_);
    for (std::size_t k = 0; k < matrix.entries.size(); ++k) {
      static_cast<SuiteSparse_long*>(triplets->i)[k] = matrix.entries[k].row;
      static_cast<SuiteSparse_long*>(triplets->j)[k] = matrix.entries[k].column;
      static_cast<double*>(triplets->x)[k] = matrix.entries[k].value;
    }
    triplets->nnz = matrix.entries.size();
    matrix_ = cholmod_l_triplet_to_sparse(triplets, matrix.entries.size(), &common_);
    cholmod_l_sort(matrix_, &common_);
    cholmod_l_free_triplet(&triplets, &common_);
    load_ = cholmod_l_allocate_dense(load.n_rows, 1, load.n_rows, CHOLMOD_REAL, &common_);
    std::copy(load.values.begin(), load.values.end(), static_cast<double*>(load_->x));
  }
  ~Cholmod() {
    cholmod_l_free_dense(&load_, &common_);
    cholmod_l_free_factor(&factor_, &common_);
    cholmod_l_free_sparse(&matrix_, &common_);
    cholmod_l_finish(&common_);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  void change(const SymmetricMatrix& change) {
    const auto* first = static_cast<const SuiteSparse_long*>(matrix_->p);
    const auto* rows = static_cast<const SuiteSparse_long*>(matrix_->i);
    auto* values = static_cast<double*>(matrix_->x);
    for (const auto& entry : change.entries) {
      const auto* end = rows + first[entry.column + 1];
      const auto* found = std::lower_bound(rows + first[entry.column], end, entry.row);
      if (found == end || *found != entry.row) throw std::runtime_error("a change where the matrix has no entry");
      values[found - rows] += entry.value;
    }
  }

  void analyze() {
    cholmod_l_free_factor(&factor_, &common_);
    factor_ = cholmod_l_analyze(matrix_, &common_);
  }
  void factorize() { cholmod_l_factorize(matrix_, factor_, &common_); }

  /// All that the cost of a solution is but the set-up.
  Cost solve() {
    Cost cost{};
    const Stopwatch watch;
    auto* x = cholmod_l_solve(CHOLMOD_A, factor_, load_, &common_);
    cost.solve = watch.seconds();
    if (x == nullptr || common_.status != CHOLMOD_OK) throw std::runtime_error("CHOLMOD failed");
    auto* residual = cholmod_l_copy_dense(load_, &common_);
    double minus[] = {-1., 0.}, one[] = {1., 0.};
    cholmod_l_sdmult(matrix_, 0, minus, one, x, residual, &common_);
    cost.residual = cholmod_l_norm_dense(residual, 2, &common_) / cholmod_l_norm_dense(load_, 2, &common_);
    const auto* loads = static_cast<const double*>(load_->x);
    cost.work = std::inner_product(loads, loads + load_->nrow, static_cast<const double*>(x->x), 0.);
    cholmod_l_free_dense(&residual, &common_);
    cholmod_l_free_dense(&x, &common_);
    return cost;
  }

 private:
  cholmod_common common_{};
  cholmod_sparse* matrix_ = nullptr;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* load_ = nullptr;
};

void solve(const std::string& state, Cholmod& cholmod, bool pattern_is_new) {
  const Stopwatch watch;
  if (pattern_is_new) cholmod.analyze();
  cholmod.factorize();
  const double set_up = watch.seconds();
  Cost cost = cholmod.solve();
  cost.set_up = set_up;
  report(state, cost);
}

void run(const std::string& folder) {
  auto load = read_table(folder + "/load.mtx");
  Cholmod cholmod(read_matrix(folder + "/matrix.mtx"), load);
  solve("intact", cholmod, true);
  cholmod.change(read_matrix(change_file(folder, 1)));
  solve("cracked", cholmod, true);
  for (int k = 2; k <= 1 + n_advances; ++k) {
    cholmod.change(read_matrix(change_file(folder, k)));
    solve("advanced", cholmod, false);
  }
}

}  // namespace
}  // namespace perimorph::tests

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    perimorph::tests::run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "perimorph_peer_cholmod: %s\n", error.what());
    return 1;
  }
}
