#include "perimorph/io/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <thread>

#include "perimorph/base/errors.hpp"

namespace perimorph::io {

namespace {

using namespace std::chrono_literals;
constexpr auto patience = 3s;  // ranks that lose their first one need some time to go

std::string description_of_this_process() {
  std::array<char, 256> host{}, begin{};
  gethostname(host.data(), host.size() - 1);
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::strftime(begin.data(), begin.size(), "%Y-%m-%d %H:%M:%S", &local);
  return fmt::format("process {} on {}, since {}\n", getpid(), host.data(), begin.data());
}

std::string first_line_of(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line.empty() ? "another process" : line;
}

/// Some file systems of networks have no locks: there every run is let in.
bool is_taken_by_another(int error) { return error == EWOULDBLOCK || error == EINTR; }

}  // namespace

FolderLock::FolderLock(const std::string& folder, Rank rank)
    : folder_(folder), file_((std::filesystem::path(folder) / "run.lock").string()), rank_(rank) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!try_to_take()) {
    if (std::chrono::steady_clock::now() > end) {
      throw base::UserError(
          fmt::format("{}: another run is writing there: {}; wait for its end, or name another folder with --output",
                      folder_, first_line_of(file_)));
    }
    std::this_thread::sleep_for(20ms);
  }
}

FolderLock::~FolderLock() {
  if (rank_ == Rank::first && is_in_folder()) unlink(file_.c_str());
  close_file();
}

/// A file that was removed between opening and locking it locks nothing.
bool FolderLock::try_to_take() {
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    throw base::UserError(
        fmt::format("{}: it cannot be written: {}; name another folder with --output", file_, std::strerror(errno)));
  }
  const int whose = rank_ == Rank::first ? LOCK_EX : LOCK_SH;
  const bool is_locked = flock(descriptor_, whose | LOCK_NB) == 0 || !is_taken_by_another(errno);
  if (!is_locked || !is_in_folder()) {
    close_file();
    return false;
  }
  if (rank_ == Rank::first) {
    const std::string text = description_of_this_process();
    if (ftruncate(descriptor_, 0) == 0 && ::write(descriptor_, text.data(), text.size()) < 0) {
      errno = 0;  // a full disk: the lock holds without a name
    }
    flock(descriptor_, LOCK_SH | LOCK_NB);  // others can join
  }
  return true;
}

bool FolderLock::is_in_folder() const {
  struct stat ours {
  }, there{};
  return fstat(descriptor_, &ours) == 0 && stat(file_.c_str(), &there) == 0 && ours.st_ino == there.st_ino &&
         ours.st_dev == there.st_dev;
}

void FolderLock::close_file() {
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
}

void FolderLock::check() const {
  if (is_in_folder()) return;
  throw base::ComputationError(
      fmt::format("{}: run.lock is gone: somebody has emptied the folder while the run was writing there", folder_));
}

}  // namespace perimorph::io
