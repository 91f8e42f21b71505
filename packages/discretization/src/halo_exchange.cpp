#include "perimorph/discretization/halo_exchange.hpp"

#include <unordered_map>
#include <utility>

#include "perimorph/base/errors.hpp"

namespace perimorph::discretization {

HaloExchange::HaloExchange(const base::Comm& comm, const std::vector<base::GlobalId>& keys,
                           const std::vector<int>& owners, std::vector<int> twins)
    : comm_(comm),
      n_items_(keys.size() + twins.size()),
      sent_(comm.getSize()),
      received_(comm.getSize()),
      twins_(std::move(twins)) {
  PERIMORPH_ASSERT(keys.size() == owners.size(), "{} items with {} owners", keys.size(), owners.size());
  std::unordered_map<base::GlobalId, int> owned;
  std::vector<std::vector<base::GlobalId>> wanted(comm.getSize());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (owners[i] == comm.getRank()) {
      owned.emplace(keys[i], static_cast<int>(i));
    } else {
      wanted[owners[i]].push_back(keys[i]);
      received_[owners[i]].push_back(static_cast<int>(i));
    }
  }
  const auto asked = base::exchange(comm, wanted);
  base::on_all_ranks(comm, [&] {
    for (int r = 0; r < comm.getSize(); ++r) {
      for (const base::GlobalId key : asked[r]) {
        const auto item = owned.find(key);
        PERIMORPH_ASSERT(item != owned.end(), "rank {} asks rank {} for item {}", r, comm.getRank(), key);
        sent_[r].push_back(item->second);
      }
    }
  });
}

}  // namespace perimorph::discretization
