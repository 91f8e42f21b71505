#include "perimorph/io/checkpoint.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <sstream>

#include "checksum.hpp"
#include "descriptor.hpp"
#include "hdf5_layout.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/io/disk.hpp"

namespace perimorph::io {

using base::GlobalId;

namespace {

constexpr std::size_t n_kept = 2;
constexpr const char* unfinished = ".part";

/// A file that is removed unless it gets its final name. On rank 0; on others there is nothing to remove.
class UnfinishedFile {
 public:
  UnfinishedFile(const base::Comm& comm, std::string path) : path_(std::move(path)), is_here_(comm.getRank() == 0) {}
  ~UnfinishedFile() {
    if (is_here_) std::remove(path_.c_str());
  }
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  const std::string& path() const { return path_; }
  void rename_to(const std::string& name) {
    if (std::rename(path_.c_str(), name.c_str()) != 0) throw std::system_error(errno, std::generic_category());
    is_here_ = false;
  }

 private:
  std::string path_;
  bool is_here_;
};

/// Bytes of a file that this rank writes or has read.
struct Piece {
  GlobalId offset, size;  ///< [bytes]
  const char* bytes;
};

/// What a rank knows of a part of a file.
struct Part {
  GlobalId offset, size;  ///< [bytes]
  Checksum checksum;
};

using Kind = DataSet::Kind;

template <class Values>
DataSet described(const std::string& name, Kind kind, const Values& values) {
  return {name, kind, false, static_cast<GlobalId>(values.size()), 1, 0};
}

/// How many rows the rank has of each data set that is in rows.
std::vector<GlobalId> row_counts(const Checkpoint& checkpoint) {
  std::vector<GlobalId> counts;
  for (const auto& entry : checkpoint.number_rows) counts.push_back(static_cast<GlobalId>(entry.second.n_rows()));
  for (const auto& entry : checkpoint.integer_rows) counts.push_back(static_cast<GlobalId>(entry.second.n_rows()));
  return counts;
}

/// All data sets of a checkpoint, those in rows at last. On rank 0.
/// @param n_rows of all ranks, as row_counts()
std::vector<DataSet> data_sets(const Checkpoint& checkpoint, const std::vector<GlobalId>& n_rows) {
  std::vector<DataSet> sets;
  for (const auto& [name, values] : checkpoint.numbers) sets.push_back(described(name, Kind::numbers, values));
  for (const auto& [name, values] : checkpoint.integers) sets.push_back(described(name, Kind::integers, values));
  for (const auto& [name, text] : checkpoint.texts) sets.push_back(described(name, Kind::text, text));
  auto n = n_rows.begin();
  const auto add_rows = [&](const auto& all, Kind kind) {
    for (const auto& [name, rows] : all) {
      sets.push_back({name, kind, true, *n++, static_cast<GlobalId>(rows.width), 0});
    }
  };
  add_rows(checkpoint.number_rows, Kind::numbers);
  add_rows(checkpoint.integer_rows, Kind::integers);
  return sets;
}

/// The data sets in rows, which rank 0 knows, on all ranks. Collective.
std::vector<DataSet> share_rows(const base::Comm& comm, const std::vector<DataSet>& sets) {
  std::vector<GlobalId> numbers;
  std::string names;
  for (const auto& set : sets) {
    if (!set.is_in_rows) continue;
    numbers.insert(numbers.end(), {static_cast<GlobalId>(set.kind), set.n_rows, set.width, set.offset});
    names += set.name + '\0';
  }
  numbers = base::gather_on_all(comm, numbers);
  std::istringstream all_names(base::broadcast(comm, names));
  std::vector<DataSet> shared(numbers.size() / 4);
  for (std::size_t i = 0; i < shared.size(); ++i) {
    const auto* n = numbers.data() + 4 * i;
    shared[i] = {"", static_cast<Kind>(n[0]), true, n[1], n[2], n[3]};
    std::getline(all_names, shared[i].name, '\0');
  }
  return shared;
}

template <class Values>
Piece piece(GlobalId offset, const Values& values) {
  const auto size = static_cast<GlobalId>(values.size()) * static_cast<GlobalId>(sizeof(values[0]));
  return {offset, size, reinterpret_cast<const char*>(values.data())};
}

/// What rank 0 writes: all but rows.
std::vector<Piece> small_pieces(const Checkpoint& checkpoint, const Structure& structure) {
  std::vector<Piece> pieces;
  for (const auto& stretch : structure.stretches) pieces.push_back(piece(stretch.offset, stretch.content));
  for (const auto& set : structure.sets) {
    if (set.is_in_rows) continue;
    if (set.kind == Kind::numbers) pieces.push_back(piece(set.offset, checkpoint.numbers.at(set.name)));
    if (set.kind == Kind::integers) pieces.push_back(piece(set.offset, checkpoint.integers.at(set.name)));
    if (set.kind == Kind::text) pieces.push_back(piece(set.offset, checkpoint.texts.at(set.name)));
  }
  return pieces;
}

/// What each rank writes: its rows.
/// @param first this rank's first row of each data set
std::vector<Piece> pieces_of_rows(const Checkpoint& checkpoint, const std::vector<DataSet>& sets,
                                  const std::vector<GlobalId>& first) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto& set = sets[i];
    const GlobalId offset = set.offset + first[i] * set.row_bytes();
    const bool are_numbers = set.kind == Kind::numbers;
    pieces.push_back(are_numbers ? piece(offset, checkpoint.number_rows.at(set.name).values)
                                 : piece(offset, checkpoint.integer_rows.at(set.name).values));
  }
  return pieces;
}

Part part_of(const Piece& piece) {
  return {piece.offset, piece.size, checksum_of({piece.bytes, static_cast<std::size_t>(piece.size)})};
}

/// The checksum of a file, of which these are all the parts.
Checksum joined_checksum(std::vector<Part> parts, GlobalId size) {
  parts.erase(std::remove_if(parts.begin(), parts.end(), [](const Part& part) { return part.size == 0; }), parts.end());
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.offset < b.offset; });
  Checksum checksum = 0;
  GlobalId end = 0;
  for (const auto& part : parts) {
    PERIMORPH_ASSERT(part.offset == end, "a part begins at byte {}, the one before ends at {}", part.offset, end);
    checksum = joined(checksum, part.checksum, part.size);
    end += part.size;
  }
  PERIMORPH_ASSERT(end == size, "{} bytes of {}", end, size);
  return checksum;
}

/// Of a part of a file, without holding it.
Part part_of(const Descriptor& file, GlobalId from, GlobalId to) {
  Part part{from, to - from, 0};
  std::string block(static_cast<std::size_t>(std::min<GlobalId>(1 << 20, to - from)), '\0');
  while (from < to) {
    const auto n = std::min(block.size(), static_cast<std::size_t>(to - from));
    file.read(block.data(), n, from);
    part.checksum = checksum_of({block.data(), n}, part.checksum);
    from += static_cast<GlobalId>(n);
  }
  return part;
}

template <class Values>
Values values_in(const Descriptor& file, GlobalId offset, GlobalId n) {
  Values values(static_cast<std::size_t>(n), {});
  file.read(reinterpret_cast<char*>(values.data()), values.size() * sizeof(values[0]), offset);
  return values;
}

/// This rank's share of the rows.
template <class Value>
Rows<Value> rows_in(const Descriptor& file, const DataSet& set, const base::Comm& comm) {
  const GlobalId from = base::first_of_share(comm, set.n_rows, comm.getRank());
  const GlobalId to = base::first_of_share(comm, set.n_rows, comm.getRank() + 1);
  return {static_cast<std::size_t>(set.width),
          values_in<std::vector<Value>>(file, set.offset + from * set.row_bytes(), (to - from) * set.width)};
}

/// What is not in rows, on rank 0.
Checkpoint small_sets_in(const Descriptor& file, const std::vector<DataSet>& sets) {
  Checkpoint checkpoint;
  for (const auto& [name, kind, is_in_rows, n, width, offset] : sets) {
    if (is_in_rows) continue;
    if (kind == Kind::numbers) checkpoint.numbers[name] = values_in<std::vector<double>>(file, offset, n);
    if (kind == Kind::integers) checkpoint.integers[name] = values_in<std::vector<GlobalId>>(file, offset, n);
    if (kind == Kind::text) checkpoint.texts[name] = values_in<std::string>(file, offset, n);
  }
  return checkpoint;
}

/// Throws Bug unless the file ends with the checksum of all bytes before: HDF5 has none of its own structures.
void check_sum(const Descriptor& file, const std::vector<Part>& parts, GlobalId size) {
  Checksum there = 0;
  file.read(reinterpret_cast<char*>(&there), sizeof there, size);
  if (there != joined_checksum(parts, size)) throw base::Bug("a wrong checksum");
}

/// This rank's first rows of each data set, and all ranks' numbers of rows. Collective.
std::pair<std::vector<GlobalId>, std::vector<GlobalId>> number_rows(const base::Comm& comm,
                                                                    const Checkpoint& checkpoint) {
  const auto counts = row_counts(checkpoint);
  const auto all = base::gather_on_all(comm, counts);
  PERIMORPH_ASSERT(all.size() == counts.size() * static_cast<std::size_t>(comm.getSize()),
                   "{} data sets in rows here, {} on all {} ranks", counts.size(), all.size(), comm.getSize());
  std::vector<GlobalId> first(counts.size(), 0), n_rows(counts.size(), 0);
  for (int rank = 0; rank < comm.getSize(); ++rank) {
    if (rank == comm.getRank()) first = n_rows;
    for (std::size_t i = 0; i < counts.size(); ++i) n_rows[i] += all[rank * counts.size() + i];
  }
  return {first, n_rows};
}

}  // namespace

std::vector<CheckpointId> CheckpointFolder::list() const {
  std::vector<CheckpointId> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename();
    CheckpointId id;
    const int n_numbers = std::sscanf(name.c_str(), "checkpoint-%d_%d", &id.increment, &id.solves);
    if (n_numbers >= 1 && name == std::filesystem::path(file(id)).filename()) found.push_back(id);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string CheckpointFolder::file(CheckpointId id) const {
  std::string name = fmt::format("checkpoint-{:06d}", id.increment);
  if (id.solves > 0) name += fmt::format("_{:06d}", id.solves);
  return (std::filesystem::path(folder_) / (name + ".h5")).string();
}

// Rank 0 makes the file, as long as it will be; then each rank writes what it has, by plain calls of the system: what
// fails is known, and all ranks agree on it. The checksum is joined from those of what the ranks have written.
void CheckpointFolder::write(const base::Comm& comm, CheckpointId id, const Checkpoint& checkpoint) const {
  const std::string name = file(id);
  const bool is_root = comm.getRank() == 0;
  const auto together = [&](const std::function<void()>& work) {
    base::on_all_ranks(comm, [&] {
      try {
        work();
      } catch (const std::system_error& error) {
        throw base::ComputationError(
            fmt::format("{}: the checkpoint cannot be written: {}", name, error.code().message()));
      }
    });
  };
  const auto [first, n_rows] = number_rows(comm, checkpoint);
  UnfinishedFile beside(comm, name + unfinished);
  Structure structure;
  together([&, &n_rows = n_rows] {
    if (!is_root) return;
    structure = lay_out(data_sets(checkpoint, n_rows));
    Descriptor(beside.path(), O_WRONLY | O_CREAT | O_TRUNC).set_size(structure.size + GlobalId{sizeof(Checksum)});
  });
  const auto rows = share_rows(comm, structure.sets);
  std::vector<Part> parts;
  together([&, &first = first] {
    auto pieces = is_root ? small_pieces(checkpoint, structure) : std::vector<Piece>();
    for (const auto& piece : pieces_of_rows(checkpoint, rows, first)) pieces.push_back(piece);
    Descriptor to(beside.path(), O_WRONLY);
    for (const auto& piece : pieces) {
      to.write(piece.bytes, static_cast<std::size_t>(piece.size), piece.offset);
      parts.push_back(part_of(piece));
    }
    to.bring_to_disk_and_close();
  });
  parts = base::gather_on_root(comm, parts);
  together([&] {
    if (!is_root) return;
    const Checksum checksum = joined_checksum(parts, structure.size);
    Descriptor to(beside.path(), O_WRONLY);
    to.write(reinterpret_cast<const char*>(&checksum), sizeof checksum, structure.size);
    to.bring_to_disk_and_close();
    beside.rename_to(name);
    bring_to_disk(folder_);
    const auto all = list();
    for (std::size_t i = 0; i + n_kept < all.size(); ++i) std::remove(file(all[i]).c_str());
  });
}

// Each rank reads its share of the bytes for the checksum, and then its share of all rows.
Checkpoint CheckpointFolder::read(const base::Comm& comm, CheckpointId id) const {
  const std::string name = file(id);
  const bool is_root = comm.getRank() == 0;
  const auto together = [&](const std::function<void()>& work) {
    base::on_all_ranks(comm, [&] {
      const auto refusal = base::UserError(fmt::format("{}: the checkpoint cannot be read, or is damaged", name));
      try {
        work();
      } catch (const std::system_error&) {
        throw refusal;
      } catch (const base::Bug&) {
        throw refusal;
      }
    });
  };
  std::optional<Descriptor> from;
  GlobalId size = 0;
  together([&] {
    from.emplace(name, O_RDONLY);
    if (is_root) size = std::max(from->size() - GlobalId{sizeof(Checksum)}, GlobalId{0});
  });
  size = base::max(comm, size);
  std::vector<Part> parts(1);
  together([&] {
    const auto begin = [&](int rank) { return base::first_of_share(comm, size, rank); };
    parts[0] = part_of(*from, begin(comm.getRank()), begin(comm.getRank() + 1));
  });
  parts = base::gather_on_root(comm, parts);
  std::vector<DataSet> sets;
  together([&] {
    if (!is_root) return;
    check_sum(*from, parts, size);
    sets = data_sets_of(name);
  });
  const auto rows = share_rows(comm, sets);
  Checkpoint checkpoint;
  together([&] {
    checkpoint = small_sets_in(*from, sets);
    for (const auto& set : rows) {
      if (set.kind == Kind::numbers) checkpoint.number_rows[set.name] = rows_in<double>(*from, set, comm);
      if (set.kind == Kind::integers) checkpoint.integer_rows[set.name] = rows_in<GlobalId>(*from, set, comm);
    }
  });
  return checkpoint;
}

void CheckpointFolder::remove_after(CheckpointId id) const {
  for (const auto& other : list()) {  // the newest at last, so that none counts again that had been superseded
    if (id < other) std::remove(file(other).c_str());
  }
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename();
    const bool is_unfinished = name.rfind("checkpoint-", 0) == 0 && entry.path().extension() == unfinished;
    if (is_unfinished) std::filesystem::remove(entry.path(), ignored);
  }
  bring_to_disk(folder_);
}

}  // namespace perimorph::io
