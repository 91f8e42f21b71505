#pragma once

// Linear systems in a folder that several programs solve, and how they say what it took them. perimorph_systems writes
// the folder, in Matrix Market's format:
//   matrix.mtx       stiffness of the intact body, lower triangle
//   change-<k>.mtx   what is added to it when bonds break for the k-th time, in entries that it has: 1 makes a crack,
//                    the others advance it
//   load.mtx         the right-hand side of all of them
//   coordinates.mtx  of the nodes, x and y; node n has the unknowns 2 n and 2 n + 1
// Each program sets up and solves for the intact body and for the cracked one. From there on it starts from its last
// solution, with whatever it can keep. Nothing of ours is needed to compile this file.

#include <charconv>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace perimorph::tests {

constexpr int n_advances = 3;       ///< of the crack
constexpr double tolerance = 1e-8;  ///< residual over load, 2-norms

struct Entry {
  int row, column;
  double value;
};

/// A symmetric matrix, by the entries of its lower triangle.
struct SymmetricMatrix {
  int n;
  std::vector<Entry> entries;
};

/// Numbers by column.
struct Table {
  int n_rows, n_columns;
  std::vector<double> values;
};

inline std::string change_file(const std::string& folder, int k) {
  return folder + "/change-" + std::to_string(k) + ".mtx";
}

/// Reads a file of Matrix Market number by number.
class MarketReader {
 public:
  explicit MarketReader(const std::string& file) : file_(file) {
    std::ifstream stream(file, std::ios::binary);
    text_.assign(std::istreambuf_iterator<char>(stream), {});
    here_ = text_.data();
    skip_line();
    while (here_ != end() && *here_ == '%') skip_line();
  }

  template <class Number>
  Number next() {
    while (here_ != end() && (*here_ == ' ' || *here_ == '\n')) ++here_;
    Number number{};
    const auto [rest, error] = std::from_chars(here_, end(), number);
    if (error != std::errc{}) throw std::runtime_error(file_ + ": a number is missing");
    here_ = rest;
    return number;
  }

 private:
  std::string file_, text_;
  const char* here_;

  const char* end() const { return text_.data() + text_.size(); }
  void skip_line() {
    while (here_ != end() && *here_++ != '\n') {
    }
  }
};

inline SymmetricMatrix read_matrix(const std::string& file) {
  MarketReader reader(file);
  SymmetricMatrix matrix{reader.next<int>(), {}};
  reader.next<int>();
  matrix.entries.resize(reader.next<std::size_t>());
  for (auto& entry : matrix.entries) {
    entry.row = reader.next<int>() - 1;
    entry.column = reader.next<int>() - 1;
    entry.value = reader.next<double>();
  }
  return matrix;
}

inline Table read_table(const std::string& file) {
  MarketReader reader(file);
  Table table{reader.next<int>(), reader.next<int>(), {}};
  table.values.resize(static_cast<std::size_t>(table.n_rows) * table.n_columns);
  for (auto& value : table.values) value = reader.next<double>();
  return table;
}

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

/// What one solution took, as a line of JSON on standard output.
struct Cost {
  double set_up;    ///< or what is renewed of it, [s]
  double solve;     ///< [s]
  int iterations;   ///< 0 for a direct solver
  double residual;  ///< |b - A x| / |b| with the matrix of the files
  double work;      ///< b . x, by which all can be compared
};
inline void report(const std::string& state, const Cost& cost) {
  std::printf(R"({"state": "%s", "set_up": %.6f, "solve": %.6f, "iterations": %d, "residual": %.3e, "work": %.12e})"
              "\n",
              state.c_str(), cost.set_up, cost.solve, cost.iterations, cost.residual, cost.work);
  std::fflush(stdout);
}

}  // namespace perimorph::tests
