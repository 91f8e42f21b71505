#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "perimorph/base/parallel.hpp"

namespace perimorph::mesh_files {

using base::GlobalId;

/// A table from tags, which may be any numbers, to places, each entry on a rank that its tag alone determines.
class TagDirectory {
 public:
  static constexpr GlobalId none = -1;

  /// Collective.
  /// @param tags   of this rank's entries; of several with one tag the first is kept, by rank and then in the list
  /// @param places of these, not negative
  TagDirectory(const base::Comm& comm, const std::vector<std::int64_t>& tags, const std::vector<GlobalId>& places);

  struct Entry {
    std::int64_t tag;
    GlobalId place;
  };
  /// Entries on this rank that were not kept.
  const std::vector<Entry>& repeated() const { return repeated_; }

  /// The place of each tag, or none. Collective.
  std::vector<GlobalId> places_of(const std::vector<std::int64_t>& tags) const;

 private:
  std::vector<int> homes_of(const std::vector<std::int64_t>& tags) const;

  const base::Comm& comm_;
  std::unordered_map<std::int64_t, GlobalId> places_;
  std::vector<Entry> repeated_;
};

}  // namespace perimorph::mesh_files
