#pragma once

#include <string>

namespace perimorph::io {

/// While one of these lives, no other run writes to its folder. It is the system's lock on the file "run.lock", in
/// which the run names itself: it ends with the process, however that ends. Local.
class FolderLock {
 public:
  /// The first rank's keeps other runs out; those of the others join it, so that it lasts as long as any of them lives.
  enum class Rank { first, other };

  /// Waits a moment for a run that is just ending. To be called on the first rank before the others.
  /// @throws UserError naming the other run if there is one, or if the folder cannot be written to.
  FolderLock(const std::string& folder, Rank rank);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// @throws ComputationError if the file is no longer in the folder: somebody has emptied it.
  void check() const;

 private:
  std::string folder_, file_;
  Rank rank_;
  int descriptor_ = -1;

  bool try_to_take();
  bool is_in_folder() const;
  void close_file();
};

}  // namespace perimorph::io
