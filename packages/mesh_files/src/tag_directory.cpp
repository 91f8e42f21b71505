#include "tag_directory.hpp"

#include "homes.hpp"
#include "perimorph/base/inquiry.hpp"

namespace perimorph::mesh_files {

TagDirectory::TagDirectory(const base::Comm& comm, const std::vector<std::int64_t>& tags,
                           const std::vector<GlobalId>& places)
    : comm_(comm) {
  PERIMORPH_ASSERT(tags.size() == places.size(), "{} tags, {} places", tags.size(), places.size());
  std::vector<Entry> entries;
  entries.reserve(tags.size());
  for (std::size_t i = 0; i < tags.size(); ++i) entries.push_back({tags[i], places[i]});
  const base::Inquiry<Entry> arriving(comm, homes_of(tags), entries);
  std::size_t n = 0;
  for (const auto& some : arriving.received()) n += some.size();
  places_.reserve(n);
  for (const auto& some : arriving.received()) {
    for (const Entry& entry : some) {
      if (!places_.emplace(entry.tag, entry.place).second) repeated_.push_back(entry);
    }
  }
}

std::vector<int> TagDirectory::homes_of(const std::vector<std::int64_t>& tags) const {
  std::vector<int> homes;
  homes.reserve(tags.size());
  for (const std::int64_t tag : tags) homes.push_back(home_of(tag, comm_.getSize()));
  return homes;
}

std::vector<GlobalId> TagDirectory::places_of(const std::vector<std::int64_t>& tags) const {
  const base::Inquiry<std::int64_t> inquiry(comm_, homes_of(tags), tags);
  return inquiry.answers<GlobalId>([&](std::int64_t tag) {
    const auto found = places_.find(tag);
    return found == places_.end() ? none : found->second;
  });
}

}  // namespace perimorph::mesh_files
