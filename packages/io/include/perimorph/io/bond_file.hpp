#pragma once

#include <string>
#include <vector>

#include "perimorph/base/algebra.hpp"

namespace perimorph::io {

/// Bonds and the points that they join, as one file describes them. Lives on rank 0.
template <int dim>
struct BondModel {
  std::vector<base::GlobalId> point_ids;
  std::vector<base::Point<dim>> positions;      ///< of the undeformed points, [length]
  std::vector<base::Point<dim>> displacements;  ///< of the points, [length]
  std::vector<long long> ends;                  ///< two points for each bond, from 0
  std::vector<double> stretch;                  ///< of each bond [-]
  std::vector<signed char> broken;              ///< of each bond, 1 or 0
};

/// Writes bonds as lines of a VTK file (.vtp, XML with appended binary data), for ParaView and VTK's own readers.
/// Point data: id, displacement; cell data: stretch, broken. Local (rank 0).
/// @throws ComputationError naming the file, if it cannot be written.
template <int dim>
void write_bonds(const std::string& file, const BondModel<dim>& model);

}  // namespace perimorph::io
