#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "perimorph/base/slices.hpp"
#include "perimorph/elements/reference_element.hpp"

// Rows of elements and records of bonds on their way between the ranks that own elements and those that hold slices of
// all rows, in order.

namespace perimorph::output {

/// The rows that this rank is to hold, out of those that all ranks own. Collective.
/// @param holders who holds which rows
/// @param ids of the rows that this rank owns
/// @param values (ids.size(), width)
std::vector<double> rows_to_holders(const base::Comm& comm, const base::Slices& holders,
                                    const std::vector<base::GlobalId>& ids, std::size_t width,
                                    const std::vector<double>& values);

/// What ranks need of the rows that others hold.
class RowExchange {
 public:
  /// Asks for the rows of some elements. Collective. @param elements each once
  RowExchange(const base::Comm& comm, base::Slices holders, std::vector<base::GlobalId> elements);

  /// The rows of those elements. Collective. @param values of the rows that this rank holds, (n_rows_here, width)
  std::vector<double> fetch(std::size_t width, const std::vector<double>& values) const;

  /// Of all ranks' records, those of which the first point is in one of those elements, in their order. Collective.
  /// @throws Bug on all ranks if there is no such element
  template <class Record>
  std::vector<Record> select(const std::vector<Record>& records) const;

 private:
  using Asker = std::pair<base::GlobalId, int>;  ///< an element, and a rank that asks for its row

  const base::Comm& comm_;
  base::Slices holders_;
  std::vector<base::GlobalId> elements_;
  std::vector<std::vector<base::GlobalId>> questions_;  ///< the elements for whose rows each rank asks this one

  std::vector<std::vector<base::GlobalId>> ask(const std::vector<base::GlobalId>& elements) const;
  std::vector<Asker> askers_of(const std::vector<base::GlobalId>& elements) const;
};

/// All ranks' records in the order of their points: those of rank 0 come first, then those of rank 1, and so on. No
/// rank gets many more than the others, wherever they come from. Collective.
template <class Record>
std::vector<Record> sorted_among_ranks(const base::Comm& comm, std::vector<Record> records);

template <class Record>
base::GlobalId first_element(const Record& record) {
  return record.first / elements::max_points;
}

template <class Record>
std::vector<Record> RowExchange::select(const std::vector<Record>& records) const {
  std::vector<base::GlobalId> elements;
  for (const auto& record : records) elements.push_back(first_element(record));
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  const auto askers = askers_of(elements);
  std::vector<std::vector<Record>> outgoing(comm_.getSize());
  for (const auto& record : records) {
    const auto element = first_element(record);
    auto asker = std::lower_bound(askers.begin(), askers.end(), Asker(element, 0));
    for (; asker != askers.end() && asker->first == element; ++asker) outgoing[asker->second].push_back(record);
  }
  std::vector<Record> selected;
  for (const auto& part : base::exchange(comm_, outgoing)) selected.insert(selected.end(), part.begin(), part.end());
  return selected;
}

// Each rank sorts its own and takes regular samples; these divide all into parts of which none is much larger than two
// even ones (sorting by regular sampling).
template <class Record>
std::vector<Record> sorted_among_ranks(const base::Comm& comm, std::vector<Record> records) {
  const auto n_ranks = static_cast<std::size_t>(comm.getSize());
  const auto precedes = [](const Record& a, const Record& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  };
  std::sort(records.begin(), records.end(), precedes);
  const auto n_records = static_cast<std::size_t>(base::sum(comm, static_cast<base::GlobalId>(records.size())));
  const std::size_t stride = std::max<std::size_t>(1, n_records / (n_ranks * n_ranks));
  std::vector<Record> samples;
  for (std::size_t i = 0; i < records.size(); i += stride) samples.push_back(records[i]);
  samples = base::gather_on_all(comm, samples);
  std::sort(samples.begin(), samples.end(), precedes);
  std::vector<std::vector<Record>> outgoing(n_ranks);
  auto from = records.begin();
  for (std::size_t rank = 0; rank < n_ranks; ++rank) {
    const bool is_last = rank + 1 == n_ranks || samples.empty();
    const auto to =
        is_last ? records.end()
                : std::lower_bound(from, records.end(), samples[samples.size() * (rank + 1) / n_ranks], precedes);
    outgoing[rank].assign(from, to);
    from = to;
  }
  std::vector<Record> sorted;
  for (const auto& part : base::exchange(comm, outgoing)) sorted.insert(sorted.end(), part.begin(), part.end());
  std::sort(sorted.begin(), sorted.end(), precedes);
  return sorted;
}

}  // namespace perimorph::output
