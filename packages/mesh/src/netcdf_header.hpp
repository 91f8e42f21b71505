#pragma once

#include <string>

namespace perimorph::mesh {

/// Walks through the header of a classic netCDF file (CDF-1, 2 or 5), and says whether everything that it announces
/// fits into the file: the library believes the header, and would ask for the memory. Local.
bool header_fits(const std::string& file);

}  // namespace perimorph::mesh
