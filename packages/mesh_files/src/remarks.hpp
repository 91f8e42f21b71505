#pragma once

#include <string>
#include <utility>
#include <vector>

#include "perimorph/base/errors.hpp"

namespace perimorph::mesh_files {

/// What the user is told of one file: each error and note begins with its name.
class Remarks {
 public:
  explicit Remarks(std::string file) : file_(std::move(file)) {}

  /// @throws UserError always
  template <class... Arguments>
  [[noreturn]] void fail(fmt::format_string<Arguments...> what, Arguments&&... arguments) const {
    throw base::UserError(file_ + ": " + fmt::format(what, std::forward<Arguments>(arguments)...));
  }

  template <class... Arguments>
  void note(fmt::format_string<Arguments...> what, Arguments&&... arguments) {
    notes_.push_back(file_ + ": " + fmt::format(what, std::forward<Arguments>(arguments)...));
  }

  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::string file_;
  std::vector<std::string> notes_;
};

}  // namespace perimorph::mesh_files
