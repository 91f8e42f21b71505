#pragma once

#include <map>
#include <string>
#include <vector>

namespace perimorph::input {

/// The line number that stands for the command line.
inline constexpr int command_line = 0;

/// Where "/Section/Name" was given: of the parameter or section, or else of the innermost section around it that the
/// file has.
int line_of(const std::map<std::string, int>& lines, std::string path);

/// Everything wrong with one case file, reported together.
class Mistakes {
 public:
  explicit Mistakes(std::string file) : file_(std::move(file)) {}

  /// @throws UserError at once if there are so many that reading on helps nobody.
  void add(int line, const std::string& path, const std::string& what);

  /// @throws UserError that lists them in the order of lines, the command line's last, if there are any.
  void report();

  bool empty() const { return found_.empty(); }

  /// Whether none is at the path or below it.
  bool none_in(const std::string& path) const;

 private:
  struct Mistake {
    int line;
    std::string path, message;
  };

  std::string file_;
  std::vector<Mistake> found_;
};

/// A piece of the file for a message: in quotes, without control characters, not too long.
std::string in_quotes(const std::string& text);

}  // namespace perimorph::input
