#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "perimorph/base/parallel.hpp"

namespace perimorph::io {

/// Values in rows, of which each rank has some: all rows are those of rank 0, then those of rank 1, and so on.
template <class Value>
struct Rows {
  std::size_t width = 1;      ///< values in a row
  std::vector<Value> values;  ///< of this rank's rows, one after the other

  std::size_t n_rows() const { return values.size() / width; }
};

/// What a checkpoint holds, by name. What is small is on rank 0 (whatever others have is ignored); no rank has all of
/// what is large: the names of rows, and their widths, are the same on all ranks.
struct Checkpoint {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::vector<base::GlobalId>> integers;
  std::map<std::string, std::string> texts;
  std::map<std::string, Rows<double>> number_rows;
  std::map<std::string, Rows<base::GlobalId>> integer_rows;
};

/// When a checkpoint was taken: after an increment, and after so many solves of the next one, if any. Ordered by time.
struct CheckpointId {
  int increment = 0, solves = 0;
  friend bool operator<(const CheckpointId& a, const CheckpointId& b) {
    return std::tie(a.increment, a.solves) < std::tie(b.increment, b.solves);
  }
  friend bool operator==(const CheckpointId& a, const CheckpointId& b) { return !(a < b) && !(b < a); }
};

/// Checkpoints of one folder: HDF5 files "checkpoint-000012.h5", named after their increment, and within the next one
/// "checkpoint-000012_000040.h5". A file is written beside its final name, brought to the disk and then renamed, so
/// that one with this name is whole; a checksum of all its bytes stands at its end. Its bytes are the same for any
/// number of ranks, all of which must see the folder. Local (rank 0), but for write() and read().
class CheckpointFolder {
 public:
  explicit CheckpointFolder(std::string folder) : folder_(std::move(folder)) {}

  const std::string& path() const { return folder_; }

  /// Those of which there is a file, intact or not, ascending.
  std::vector<CheckpointId> list() const;

  /// The name of a checkpoint's file.
  std::string file(CheckpointId id) const;

  /// Writes a checkpoint, each rank its own rows; waits until the disk has it, and removes all but the last two.
  /// Collective. @throws ComputationError naming the file, if it cannot be written; nothing half-written is left.
  void write(const base::Comm& comm, CheckpointId id, const Checkpoint& checkpoint) const;

  /// What a checkpoint holds; each rank has about as many rows. Collective.
  /// @throws UserError naming the file, if it cannot be read or is damaged.
  Checkpoint read(const base::Comm& comm, CheckpointId id) const;

  /// Removes all after this one, and what a run that was killed has left unfinished; waits until the disk knows.
  /// @throws ComputationError if the disk fails.
  void remove_after(CheckpointId id) const;

 private:
  std::string folder_;
};

}  // namespace perimorph::io
