#pragma once

// Names of components, as columns and variables have them.

#include <string>
#include <vector>

#include "perimorph/base/algebra.hpp"

namespace perimorph::output {

inline constexpr const char* axis_names[] = {"x", "y", "z"};

template <int dim>
const std::vector<std::string>& stress_names() {
  static const std::vector<std::string> names =
      dim == 2 ? std::vector<std::string>{"stress_xx", "stress_yy", "stress_xy"}
               : std::vector<std::string>{"stress_xx", "stress_yy", "stress_zz", "stress_yz", "stress_xz", "stress_xy"};
  return names;
}

}  // namespace perimorph::output
