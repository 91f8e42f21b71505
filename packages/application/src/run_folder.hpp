#pragma once

#include <optional>
#include <string>

#include "perimorph/base/log.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/io/folder_lock.hpp"

namespace perimorph::application {

/// The folder that a run writes to, which no other run does meanwhile. Until it is taken over, all that is there stays
/// as it is, so that a run that is refused changes nothing.
class RunFolder {
 public:
  /// Makes the folder and locks it. Collective. All arguments must outlive this.
  /// @throws UserError if it cannot be made, holds the case or the mesh under a name of the results, or if another run
  /// is writing there.
  RunFolder(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& path,
            const base::Log& log);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::string& path() const { return path_; }

  /// On rank 0; null on others.
  const io::FolderLock* lock() const { return comm_->getRank() == 0 ? &*lock_ : nullptr; }

  /// Where the mesh of a geometry is made, on rank 0.
  const std::string& for_mesh() const { return for_mesh_; }

  /// From now on the log has a file there. Collective. @throws UserError if that cannot be written.
  void open_log(bool append);

  /// The mesh, resolved.xml and the log, which follows an earlier one or not, are put there. Collective.
  /// @throws UserError if they cannot be written.
  void take_over(bool append_to_log);

 private:
  Teuchos::RCP<const base::Comm> comm_;
  const cases::Case& input_;
  std::string path_, for_mesh_;
  base::Log log_;
  bool has_log_ = false;
  std::optional<io::FolderLock> lock_;

  void make() const;
  void move_mesh() const;
  void write_resolved() const;
};

}  // namespace perimorph::application
