#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "file_cursor.hpp"

namespace perimorph::mesh_files {

/// A line such as  *ELEMENT, TYPE=C3D8, ELSET="all of it"
struct AbaqusKeyword {
  std::string name;                               ///< lower case, without blanks: "solidsection"
  std::map<std::string, std::string> parameters;  ///< by name in lower case; values as written, without quotes

  bool has(const std::string& parameter) const { return parameters.count(parameter) > 0; }
  /// "" if it is not given.
  std::string value(const std::string& parameter) const;
};

/// The lines of an input file of Abaqus and of those that it includes, as "Input syntax rules" of Abaqus' manual has
/// them: keyword lines, each with the data lines that follow it, and comments.
class AbaqusLines {
 public:
  explicit AbaqusLines(const std::string& file);

  /// The next keyword; data lines before it are skipped. None at the end of the file.
  std::optional<AbaqusKeyword> next_keyword();

  /// The fields of the current keyword's next data line. None if a keyword or the end of the file follows.
  std::optional<std::vector<std::string>> next_data();

  /// Goes on in another file, and after its end here.
  void include(const std::string& name);

  std::int64_t whole_number(const std::string& field) const;  ///< > 0, of less than ten digits
  double real_number(const std::string& field) const;         ///< finite; 0 for an empty field
  [[noreturn]] void fail(const std::string& what) const { files_.back().cursor->fail(what); }

 private:
  struct File {
    std::string name;
    std::unique_ptr<FileCursor> cursor;
  };

  /// Whether there is a next line, which is then in line_.
  bool find_line();
  std::string continued();
  AbaqusKeyword parse_keyword();

  std::vector<File> files_;  ///< the last one is read
  int n_included_ = 0;
  std::string line_;  ///< the next line, "" if it is not known yet
};

}  // namespace perimorph::mesh_files
