#pragma once

#include <Teuchos_RCP.hpp>
#include <Tpetra_Import_fwd.hpp>
#include <Tpetra_Vector_fwd.hpp>
#include <vector>

#include "perimorph/base/algebra.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::operators {

/// What the volume around points adds to their bonds: linear ordinary state-based peridynamics, scaled so that it is
/// positive definite whichever bonds have broken, and bond-based peridynamics where kappa = 0 (DECISIONS.md, 36). At a
/// point, over its intact bonds,
///   M = Sum c |xi|^4,   S = Sum c (alpha(x) + alpha(p))/2 |xi|^2 (xi . eta),   energy 1/2 g S^2,   g = factor / M,
/// so that a bond's tension is c (alpha(x) + alpha(p))/2 (xi . eta + |xi|^2 (p(x) + p(p))) with p = g S.
class Dilatation {
 public:
  /// Of points without bonds. Collective.
  /// @param ids of the points over all ranks, (n_points), those of this rank first
  /// @param n_owned how many are of this rank; it has all of their bonds
  /// @param factors dim kappa / (2 (dim + 2) mu) of their materials, (n_points), [-]
  /// @param twins further points, each by the one that it is a mirror image of
  Dilatation(const Teuchos::RCP<const base::Comm>& comm, const std::vector<base::GlobalId>& ids, std::size_t n_owned,
             std::vector<double> factors, std::vector<std::size_t> twins = {});

  /// A bond that a point has, or has no longer. @param weight c |xi|^4, [force length]
  void add(std::size_t point, double weight);
  void remove(std::size_t point, double weight);
  /// It still has it, with less weight. @param weight what is lost
  void weaken(std::size_t point, double weight);

  /// Makes p of S, (n_points and twins), [force length] to [-]; at points of other ranks as it is there. Collective.
  void to_stretch(std::vector<double>& sums) const;

  std::size_t bytes() const;  ///< of memory

 private:
  std::vector<double> factors_;
  std::vector<std::size_t> twins_;
  std::size_t n_owned_;
  std::vector<double> weighted_volumes_;         ///< M, [force length]
  std::vector<int> n_bonds_;                     ///< that make it up: of none it is zero, whatever rounding has left
  Teuchos::RCP<const Tpetra::Import<>> import_;  ///< null on a single rank
  Teuchos::RCP<Tpetra::Vector<double>> owned_, all_;
};

}  // namespace perimorph::operators
