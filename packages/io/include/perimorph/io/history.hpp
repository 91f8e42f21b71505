#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace perimorph::io {

/// A table of what happened, increment by increment, as CSV (history.csv, probes.csv, ...): a header and rows that
/// begin with the number of their increment, ascending, each flushed. Local (rank 0).
class History {
 public:
  /// @throws UserError naming the file, if it cannot be written.
  History(const std::string& file, const std::vector<std::string>& columns);

  /// Whether each increment has rows, or only some have.
  enum class Rows { in_each_increment, in_some };

  /// Goes on with a history that an earlier run has left: rows after that increment are cut off.
  /// @throws UserError naming the file, if it cannot be read or written, has other columns or ends before the
  /// increment.
  static History resume(const std::string& file, const std::vector<std::string>& columns, int increment,
                        Rows rows = Rows::in_each_increment);

  /// Integral values are written as integers, others with 10 significant digits.
  /// @throws ComputationError naming the file, if it cannot be written; Bug if the number of values is wrong.
  void write(const std::vector<double>& row);

  /// The same with texts among the numbers.
  void write_texts(const std::vector<std::string>& row);

  /// A number as it is written.
  static std::string number(double value);

 private:
  History(std::string file, std::size_t n_columns);  // appends

  std::string file_;
  std::size_t n_columns_;
  std::ofstream stream_;
};

}  // namespace perimorph::io
