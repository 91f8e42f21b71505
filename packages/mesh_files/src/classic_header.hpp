#pragma once

#include <string>

namespace perimorph::mesh_files {

/// Walks through the header of a classic netCDF file (CDF-1, 2 or 5), and says whether the Exodus library can be
/// trusted with it: the library believes what a header says. It allocates whatever a count asks for, and reads a whole
/// variable into an array of the size that the file states elsewhere. Local.
bool is_valid_header(const std::string& file);

}  // namespace perimorph::mesh_files
