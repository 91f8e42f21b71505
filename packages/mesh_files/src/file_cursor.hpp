#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "mapped_file.hpp"

namespace perimorph::mesh_files {

/// A place in the text of a mesh file, which hands out the numbers and lines that follow it. Every error names the file
/// and the line (the byte in binary data). Of the file only a part around the place is in memory.
class FileCursor {
 public:
  /// @param wanted what the file should be, "a gmsh mesh"
  /// @throws base::UserError if the file cannot be read or is empty.
  FileCursor(const std::string& file, const std::string& wanted);

  /// From here on numbers are binary, in this machine's byte order.
  void set_binary() { binary_ = true; }
  bool binary() const { return binary_; }

  /// Skips white space, and returns whether nothing follows.
  bool at_end();

  /// Nothing follows, not even white space.
  bool at_end_of_text() const { return remaining() == 0; }

  /// The rest of the current line, without white space at its ends.
  std::string line();

  /// The rest of the current line as it is, for columns of fixed width.
  std::string raw_line();

  /// Whether this character follows.
  bool next_is(char character) const { return remaining() > 0 && text_[position_] == character; }

  /// Skips white space and exactly these words.
  /// @throws base::UserError if others follow
  void expect(const std::string& words);

  /// Moves to the start of the next line that begins with these words.
  void skip_to_line(const std::string& words);
  void skip_past_line(const std::string& words);

  /// The next number; an int has 4 bytes in binary data, a long 8.
  int next_int() { return binary_ ? raw<int>() : ascii_int(); }
  std::int64_t next_long() { return binary_ ? raw<std::int64_t>() : ascii_long(); }
  double next_real();

  /// Passes over numbers, in binary data without looking at them.
  /// @param bytes of each in binary data
  void skip_numbers(std::size_t count, std::size_t bytes);

  /// Numbers that are text even in binary files.
  int ascii_int();
  std::int64_t ascii_long();
  double ascii_real();

  /// Moves past the line break that ends a line of text before binary data.
  void skip_line_break();

  /// The number of items that follow, if the rest of the file can hold as many.
  /// @param numbers at least so many numbers per item
  /// @param bytes   at least so many bytes per item in binary data
  std::size_t checked(std::int64_t count, std::size_t numbers, std::size_t bytes) const;

  /// @throws base::UserError with the file and the place
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_truncated() const;

 private:
  static constexpr std::size_t most_kept = std::size_t{1} << 22U;  ///< in memory behind the place [bytes]

  void skip_white_space();
  void move_to(std::size_t position) {
    position_ = position;
    if (position_ - released_ > most_kept) release_what_is_behind();
  }
  void release_what_is_behind();
  std::string_view token();
  std::size_t remaining() const { return text_.size() - position_; }
  std::string place() const;

  template <class T>
  T raw() {
    if (remaining() < sizeof(T)) fail_truncated();
    T value;
    std::memcpy(&value, text_.data() + position_, sizeof(T));
    move_to(position_ + sizeof(T));
    return value;
  }

  std::string file_;
  MappedFile mapped_;
  std::string_view text_;
  std::size_t position_ = 0, released_ = 0;
  bool binary_ = false;
};

/// @throws base::UserError unless the file is a regular one (a pipe could wait forever) and is not empty.
void require_regular_file(const std::string& file, const std::string& wanted);

/// The whole of a text as a number, with or without a sign. Returns whether it is one; those too small are 0.
bool parse_number(std::string_view text, std::int64_t& value);
bool parse_number(std::string_view text, double& value);

/// The printable beginning of a text, for error messages.
std::string excerpt(std::string_view text);

}  // namespace perimorph::mesh_files
