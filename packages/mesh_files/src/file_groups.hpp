#pragma once

#include <string>
#include <vector>

#include "mesh_file.hpp"
#include "perimorph/base/parallel.hpp"
#include "remarks.hpp"

namespace perimorph::mesh_files {

/// What gmsh calls an entity of a dimension.
const char* entity_name(int dimension);

/// The groups of a file, of which each rank has a slice: all ranks number them alike, by dimension and number.
class FileGroups {
 public:
  /// Collective.
  /// @param slice is kept as a reference
  FileGroups(const base::Comm& comm, const MeshFile& slice, const Remarks& remarks);

  int n() const { return static_cast<int>(keys_.size()); }
  const GroupKey& key(int group) const { return keys_[static_cast<std::size_t>(group)]; }
  int index_of(const GroupKey& key) const;

  /// Whether any rank has an element in the group.
  bool has_elements(int group) const { return n_elements_[static_cast<std::size_t>(group)] > 0.; }

  /// Local; the same on all ranks.
  /// @throws UserError if it is no readable name
  std::string name(int group) const;

 private:
  const MeshFile& slice_;
  const Remarks& remarks_;
  std::vector<GroupKey> keys_;      // ascending
  std::vector<double> n_elements_;  // of all ranks
};

}  // namespace perimorph::mesh_files
