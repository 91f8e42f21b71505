#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "perimorph/io/disk.hpp"

namespace perimorph::io {

/// A table of what happened, increment by increment, as CSV (history.csv, probes.csv, ...): a header and rows that
/// begin with the number of their increment, ascending, each flushed. Local (rank 0).
class History {
 public:
  /// @throws UserError naming the file, if it cannot be written.
  History(const std::string& file, const std::vector<std::string>& columns);

  /// Goes on with a table that an earlier run has left: what follows after that extent is cut off.
  /// @throws UserError naming the file, if it cannot be read or written, or has other columns.
  static History resume(const std::string& file, const std::vector<std::string>& columns, const FileExtent& extent);

  /// How far it has come.
  const FileExtent& extent() const { return extent_; }

  /// @throws ComputationError naming the file, if it is not as it was written: removed, or changed by somebody else.
  void check() const;

  /// Appends a row. Integral values are written as integers, others with 10 significant digits.
  /// @param row one value a column
  /// @throws ComputationError naming the file, if it cannot be written; Bug if the number of values is wrong.
  void write(const std::vector<double>& row);

  /// The same with texts among the numbers.
  void write_texts(const std::vector<std::string>& row);

  /// A number as it is written.
  static std::string number(double value);

 private:
  History(const std::string& file, std::size_t n_columns, const FileExtent& extent);  // appends

  std::string file_;
  std::size_t n_columns_;
  FileExtent extent_;
  std::ofstream stream_;

  void append(const std::string& text);
};

}  // namespace perimorph::io
