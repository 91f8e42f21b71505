#pragma once

#include <array>
#include <string>
#include <vector>

#include "perimorph/cases/output.hpp"
#include "perimorph/discretization/measure.hpp"
#include "perimorph/fracture/body.hpp"

namespace perimorph::output {

/// All probes of a case in one mesh. Where elements have parted, a place is on one side of the crack.
template <int dim>
class Probes {
 public:
  /// What was measured at one place: displacement [length]; stress [stress], interpolated from the element's material
  /// points by the shape functions that take their values there.
  struct Sample {
    int place;  ///< in the order of places()
    std::array<double, dim> displacement;
    std::array<double, base::n_voigt<dim>> stress;
  };

  /// Collective.
  Probes(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const std::vector<cases::Probe>& probes);

  /// A probe's name, the number of the place in it from 1, and the place, [length].
  struct Place {
    std::string probe;
    int number;
    base::Point<dim> position;
  };
  const std::vector<Place>& places() const { return places_; }

  /// One sample for each place, in their order, on rank 0. Collective.
  std::vector<Sample> measure(const base::Comm& comm, const fracture::Body<dim>& body) const;

 private:
  std::vector<Place> places_;
  std::vector<discretization::Sampled> own_;
};

}  // namespace perimorph::output
