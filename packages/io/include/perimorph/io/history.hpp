#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace perimorph::io {

/// history.csv: a header and one row per accepted increment, each flushed. Local (rank 0).
class History {
 public:
  /// @throws UserError naming the file, if it cannot be written.
  History(const std::string& file, const std::vector<std::string>& columns);

  /// Goes on with a history that an earlier run has left: rows after that increment are cut off.
  /// @throws UserError naming the file, if it cannot be read or written, has other columns or ends before the
  /// increment.
  static History resume(const std::string& file, const std::vector<std::string>& columns, int increment);

  /// Integral values are written as integers, others with 10 significant digits.
  /// @throws ComputationError naming the file, if it cannot be written; Bug if the number of values is wrong.
  void write(const std::vector<double>& row);

 private:
  History(std::string file, std::size_t n_columns);  // appends

  std::string file_;
  std::size_t n_columns_;
  std::ofstream stream_;
};

}  // namespace perimorph::io
