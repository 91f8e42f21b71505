#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "perimorph/base/field.hpp"
#include "perimorph/discretization/boundary_conditions.hpp"

namespace perimorph::discretization {

/// The unknowns of nodes at which displacements are prescribed along directions that are oblique to the axes: they are
/// components along axes of the node's own, of which the first ones are prescribed. Fields on nodes are (n_nodes, dim),
/// with copies or without. All local.
template <int dim>
class NodeFrames {
 public:
  using Block = Eigen::Matrix<double, dim, dim>;

  NodeFrames(const DofMap<dim>& dofs, const Dirichlet<dim>& dirichlet);

  bool is_empty() const { return frames_.empty(); }
  bool has(int node) const { return find(node) != nullptr; }

  /// The local degrees of freedom along axes that are prescribed, ascending.
  std::vector<int> prescribed() const;
  /// Whether what is prescribed at a node decides about a component, at least in part.
  bool decides(int node, int component) const;

  /// Puts in what is prescribed of a displacement, [length].
  void prescribe(base::Field u, double load_factor) const;
  /// Adds how fast it grows with the load factor in a step up to it, on average, [length].
  void add_rates(base::Field rates, double load_factor, double step) const;
  /// From components along x, y, z to those along the axes, in place, and back.
  void turn(base::Field vectors) const;
  void turn_back(base::Field vectors) const;
  /// Stiffness between two nodes as that between their unknowns.
  Block between_unknowns(int node, int other, const Block& stiffness) const;

 private:
  using Sum = std::vector<std::pair<double, Ramp<double>>>;  ///< of ramps, each times a factor
  struct Frame {
    int node;                 ///< local
    Block axes;               ///< columns, orthonormal
    std::vector<Sum> values;  ///< along the first axes, [length]
  };
  std::vector<Frame> frames_;
  std::vector<int> frame_at_;  ///< per local node, its place in the list; -1: none. Empty if there are none.

  static Frame make(int node, const std::vector<typename Dirichlet<dim>::Along>& along, double load_factor);
  const Frame* find(int node) const {
    return frames_.empty() || frame_at_[node] < 0 ? nullptr : &frames_[frame_at_[node]];
  }
};

}  // namespace perimorph::discretization
