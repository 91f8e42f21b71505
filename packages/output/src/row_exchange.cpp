#include "row_exchange.hpp"

#include "perimorph/base/errors.hpp"

namespace perimorph::output {

using base::GlobalId;

namespace {

/// Appends a row of some values to others.
void append_row(std::vector<double>& to, const std::vector<double>& values, GlobalId row, std::size_t width) {
  const auto begin = values.begin() + row * static_cast<GlobalId>(width);
  to.insert(to.end(), begin, begin + static_cast<GlobalId>(width));
}

/// Calls exchange(begin, end) for one batch of this rank's rows after the other, as often on all ranks: what is on its
/// way takes memory several times. Collective.
template <class Exchange>
void for_each_batch(const base::Comm& comm, std::size_t n_rows, const Exchange& exchange) {
  constexpr std::size_t rows_of_batch = 1 << 16;
  const auto largest = static_cast<std::size_t>(base::max(comm, static_cast<GlobalId>(n_rows)));
  for (std::size_t begin = 0; begin < largest; begin += rows_of_batch) {
    exchange(std::min(begin, n_rows), std::min(begin + rows_of_batch, n_rows));
  }
}

}  // namespace

std::vector<double> rows_to_holders(const base::Comm& comm, const base::Slices& holders,
                                    const std::vector<GlobalId>& ids, std::size_t width,
                                    const std::vector<double>& values) {
  const int here = comm.getRank();
  const GlobalId first = holders.begin(here);
  std::vector<double> held(holders.size(here) * width);
  const auto hold = [&](GlobalId id, std::vector<double>::const_iterator row) {
    std::copy_n(row, width, held.begin() + (id - first) * static_cast<GlobalId>(width));
  };
  for_each_batch(comm, ids.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<std::vector<GlobalId>> ids_to(comm.getSize());
    std::vector<std::vector<double>> values_to(comm.getSize());
    base::on_all_ranks(comm, [&] {
      PERIMORPH_ASSERT(values.size() == ids.size() * width, "{} values in {} rows", values.size(), ids.size());
      for (std::size_t i = begin; i < end; ++i) {
        const auto row = static_cast<GlobalId>(i);
        const int holder = holders.holder(ids[i]);
        if (holder == here) hold(ids[i], values.begin() + row * static_cast<GlobalId>(width));
        if (holder != here) ids_to[holder].push_back(ids[i]);
        if (holder != here) append_row(values_to[holder], values, row, width);
      }
    });
    const auto ids_from = base::exchange(comm, ids_to);
    const auto values_from = base::exchange(comm, values_to);
    for (std::size_t rank = 0; rank < ids_from.size(); ++rank) {
      auto row = values_from[rank].begin();
      for (const GlobalId id : ids_from[rank]) {
        hold(id, row);
        row += static_cast<GlobalId>(width);
      }
    }
  });
  return held;
}

RowExchange::RowExchange(const base::Comm& comm, base::Slices holders, std::vector<GlobalId> elements)
    : comm_(comm), holders_(std::move(holders)), elements_(std::move(elements)), questions_(ask(elements_)) {}

/// Tells the holders of the rows of some elements; returns those of which each rank tells this one. Collective.
std::vector<std::vector<GlobalId>> RowExchange::ask(const std::vector<GlobalId>& elements) const {
  std::vector<std::vector<GlobalId>> asked(comm_.getSize());
  base::on_all_ranks(comm_, [&] {
    for (const GlobalId element : elements) asked[holders_.holder(element)].push_back(element);
  });
  return base::exchange(comm_, asked);
}

std::vector<double> RowExchange::fetch(std::size_t width, const std::vector<double>& values) const {
  const int here = comm_.getRank();
  const GlobalId first = holders_.begin(here);
  std::vector<double> fetched;
  fetched.reserve(elements_.size() * width);
  for_each_batch(comm_, elements_.size(), [&](std::size_t begin, std::size_t end) {
    const std::vector<GlobalId> batch(elements_.begin() + static_cast<GlobalId>(begin),
                                      elements_.begin() + static_cast<GlobalId>(end));
    const auto questions = ask(batch);
    std::vector<std::vector<double>> answers(comm_.getSize());
    for (int rank = 0; rank < comm_.getSize(); ++rank) {
      if (rank == here) continue;
      for (const GlobalId element : questions[rank]) append_row(answers[rank], values, element - first, width);
    }
    answers = base::exchange(comm_, answers);
    std::vector<GlobalId> next(comm_.getSize(), 0);  // row of each holder's answer, in the order of questions
    for (const GlobalId element : batch) {
      const int holder = holders_.holder(element);
      if (holder == here) append_row(fetched, values, element - first, width);
      if (holder != here) append_row(fetched, answers[holder], next[holder]++, width);
    }
  });
  return fetched;
}

/// The ranks that ask for the rows of some elements, ascending: their holders know. Collective.
std::vector<RowExchange::Asker> RowExchange::askers_of(const std::vector<GlobalId>& elements) const {
  const auto asked = ask(elements);
  std::vector<Asker> all;
  for (std::size_t rank = 0; rank < questions_.size(); ++rank) {
    for (const GlobalId element : questions_[rank]) all.emplace_back(element, static_cast<int>(rank));
  }
  std::sort(all.begin(), all.end());
  struct Answer {
    GlobalId element, rank;
  };
  std::vector<std::vector<Answer>> answers(comm_.getSize());
  for (std::size_t rank = 0; rank < asked.size(); ++rank) {
    for (const GlobalId element : asked[rank]) {
      auto asker = std::lower_bound(all.begin(), all.end(), Asker(element, 0));
      for (; asker != all.end() && asker->first == element; ++asker) answers[rank].push_back({element, asker->second});
    }
  }
  std::vector<Asker> askers;
  for (const auto& part : base::exchange(comm_, answers)) {
    for (const auto& [element, rank] : part) askers.emplace_back(element, static_cast<int>(rank));
  }
  return askers;  // holders have rows in order, and so the answers are
}

}  // namespace perimorph::output
