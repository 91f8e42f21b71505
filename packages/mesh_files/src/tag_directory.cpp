#include "tag_directory.hpp"

#include "perimorph/base/inquiry.hpp"

namespace perimorph::mesh_files {

namespace {

/// All bits of a number mixed (the end of SplitMix64), so that numbers with any regular gaps spread over the ranks.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

}  // namespace

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
  const auto n_ranks = static_cast<std::uint64_t>(comm_.getSize());
  std::vector<int> homes;
  homes.reserve(tags.size());
  for (const std::int64_t tag : tags) {
    homes.push_back(static_cast<int>(mixed(static_cast<std::uint64_t>(tag)) % n_ranks));
  }
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
