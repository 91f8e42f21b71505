#pragma once

#include <map>
#include <string>
#include <vector>

#include "perimorph/base/algebra.hpp"

namespace perimorph::io {

/// What a checkpoint holds, by name. Lives on rank 0.
struct Checkpoint {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::vector<base::GlobalId>> integers;
  std::map<std::string, std::string> texts;
};

/// Checkpoints of one folder: HDF5 files "checkpoint-000012.h5", named after their increment. A file is written beside
/// its final name, brought to the disk and then renamed, so that one with this name is whole. Local (rank 0).
class CheckpointFolder {
 public:
  explicit CheckpointFolder(std::string folder) : folder_(std::move(folder)) {}

  /// Increments of which there is a file, intact or not, ascending.
  std::vector<int> increments() const;

  /// The name of an increment's file.
  std::string file(int increment) const;

  /// Writes a checkpoint and removes all but the last two.
  /// @throws ComputationError naming the file, if it cannot be written; nothing half-written is left.
  void write(int increment, const Checkpoint& checkpoint) const;

  /// @throws UserError naming the file, if it cannot be read or is damaged.
  Checkpoint read(int increment) const;

  /// Removes the files of all increments after this one.
  void remove_after(int increment) const;

 private:
  std::string folder_;
};

}  // namespace perimorph::io
