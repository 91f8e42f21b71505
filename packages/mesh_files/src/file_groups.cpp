#include "file_groups.hpp"

#include <algorithm>
#include <array>

#include "perimorph/base/text.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr std::size_t longest_name = 200;

}  // namespace

const char* entity_name(int dimension) {
  static constexpr std::array<const char*, 4> names = {"point", "curve", "surface", "volume"};
  return names.at(static_cast<std::size_t>(dimension));
}

FileGroups::FileGroups(const base::Comm& comm, const MeshFile& slice, const Remarks& remarks)
    : slice_(slice), remarks_(remarks) {
  for (const auto& [key, name] : slice.group_names) keys_.push_back(key);
  n_elements_.assign(keys_.size(), 0.);
  base::on_all_ranks(comm, [&] {
    std::vector<std::array<double, 4>> in_lists(slice.group_lists.size());  // by dimension
    for (std::size_t e = 0; e < slice.n_elements(); ++e) {
      ++in_lists[slice.element_groups[e]][dimension(slice.shapes[e])];
    }
    for (std::size_t list = 0; list < in_lists.size(); ++list) {
      for (int d = 0; d < 4; ++d) {
        if (in_lists[list][d] == 0.) continue;
        for (const int number : slice.group_lists[list]) n_elements_[index_of({d, number})] += in_lists[list][d];
      }
    }
  });
  base::sum(comm, n_elements_);
}

int FileGroups::index_of(const GroupKey& key) const {
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), key);
  PERIMORPH_ASSERT(found != keys_.end() && *found == key, "group {} of dimension {} has no name", key.second,
                   key.first);
  return static_cast<int>(found - keys_.begin());
}

std::string FileGroups::name(int group) const {
  const std::string& name = slice_.group_names.at(key(group));
  if (name.empty() || name.size() > longest_name || base::has_control_characters(name)) {
    remarks_.fail("{} {} has a name of {} characters; allowed are readable names of at most {}",
                  entity_name(key(group).first), key(group).second, name.size(), longest_name);
  }
  return name;
}

}  // namespace perimorph::mesh_files
