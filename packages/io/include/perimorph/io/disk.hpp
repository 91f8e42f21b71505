#pragma once

#include <string>
#include <vector>

#include "perimorph/base/algebra.hpp"

namespace perimorph::io {

/// Waits until the disk has all that was written to a file, or the names of all files in a folder: from then on they
/// survive a power cut. Local. @throws ComputationError naming it, if that fails.
void bring_to_disk(const std::string& path);

/// The size of a file that the run has written, [bytes]. Local. @throws ComputationError naming it, if it is gone.
base::GlobalId size_of(const std::string& path);

/// How far a file of results had come at some time.
struct FileExtent {
  static constexpr base::GlobalId no_checksum = -1;

  std::string name;                       ///< within the folder of the results
  base::GlobalId size = 0;                ///< [bytes]
  base::GlobalId checksum = no_checksum;  ///< of these bytes, if it is known
};

/// Why a run cannot continue a file from that extent, such as "is missing"; "" if the file has all these bytes,
/// whatever follows them. Local.
std::string trouble_with(const std::string& folder, const FileExtent& extent);

}  // namespace perimorph::io
