// Geometries are programs, in the language of "Gmsh scripting language" in gmsh's manual. They are read here as gmsh's
// lexical analyser reads them, and no further.

#include "geometry_script.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "file_cursor.hpp"
#include "perimorph/base/errors.hpp"
#include "text_fields.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr std::size_t longest_string = 1000;  // gmsh goes on reading commands inside longer ones

struct Token {
  enum class Kind { word, string, symbol } kind;
  std::string text;
  int line;

  bool is(const char* expected) const { return kind != Kind::string && text == expected; }
};

bool begins_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

class Tokens {
 public:
  explicit Tokens(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    text_.assign(std::istreambuf_iterator<char>(stream), {});
    while (position_ < text_.size()) next();
  }

  const std::vector<Token>& all() const { return tokens_; }
  const std::string& text() const { return text_; }

 private:
  void next() {
    const char c = text_[position_];
    if (text_.compare(position_, 2, "//") == 0) {
      skip_past("\n");
    } else if (text_.compare(position_, 2, "/*") == 0) {
      position_ += 2;
      skip_past("*/");
    } else if (c == '"' || c == '\'') {
      const std::size_t end = std::min(text_.find(c, position_ + 1), text_.size());
      add(Token::Kind::string, text_.substr(position_ + 1, end - position_ - 1), end + 1 - position_);
    } else if (begins_word(c)) {
      std::size_t end = position_;
      while (end < text_.size() && is_in_word(text_[end])) ++end;
      add(Token::Kind::word, text_.substr(position_, end - position_), end - position_);
    } else if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      advance(1);
    } else {
      add(Token::Kind::symbol, std::string(1, c), 1);
    }
  }

  void add(Token::Kind kind, std::string text, std::size_t length) {
    tokens_.push_back({kind, std::move(text), line_});
    advance(length);
  }

  void advance(std::size_t length) {
    for (; length > 0 && position_ < text_.size(); --length) line_ += text_[position_++] == '\n' ? 1 : 0;
  }

  void skip_past(const std::string& end) {
    advance(std::min(text_.find(end, position_), text_.size()) + end.size() - position_);
  }

  std::string text_;
  std::size_t position_ = 0;
  int line_ = 1;
  std::vector<Token> tokens_;
};

/// Endings of files that gmsh takes for geometry or meshes whatever they hold; it runs others as programs.
bool is_data(const std::string& file) {
  static const std::set<std::string> endings = {".stp", ".step", ".igs", ".iges", ".brep",
                                                ".stl", ".unv",  ".vtk", ".med"};
  return endings.count(lower(std::filesystem::path(file).extension())) > 0;
}

class Search {
 public:
  /// What the first command of that kind does, with its place, or "".
  std::string in(const std::string& file) {
    if (!seen_.insert(std::filesystem::path(file).lexically_normal()).second) return "";
    const Tokens tokens(file);
    for (std::size_t i = 0; i < tokens.all().size(); ++i) {
      const Token& token = tokens.all()[i];
      if (token.kind == Token::Kind::symbol && token.text[0] == '\0') return place(file, token, "holds a zero byte");
      if (token.kind == Token::Kind::string && token.text.size() > longest_string) {
        return place(file, token, fmt::format("has a string of more than {} characters", longest_string));
      }
      if (token.kind != Token::Kind::word) continue;
      if (std::string found = at(file, tokens.all(), i); !found.empty()) return found;
    }
    return "";
  }

 private:
  static std::string place(const std::string& file, const Token& token, const std::string& what) {
    return fmt::format("{}:{}: {}", file, token.line, what);
  }

  std::string at(const std::string& file, const std::vector<Token>& tokens, std::size_t i) {
    static const Token end = {Token::Kind::symbol, ";", 0};
    static const std::set<std::string> runs = {"SystemCall", "NonBlockingSystemCall", "System", "OnelabRun",
                                               "OnelabAction"};
    static const std::set<std::string> writes = {"Print", "Save", "CreateDir"};
    static const std::set<std::string> reads = {"Include", "Merge", "MergeWithBoundingBox"};
    const auto after = [&](std::size_t n) -> const Token& { return i + n < tokens.size() ? tokens[i + n] : end; };
    const std::string& word = tokens[i].text;
    static const std::string not_after_command = ".=;:[,)<>+-*/!?&|~]}";
    const bool is_command =
        after(1).kind != Token::Kind::symbol || not_after_command.find(after(1).text) == std::string::npos;
    if (word == "ExternalProcess" || word.rfind("Executable", 0) == 0 || (runs.count(word) > 0 && is_command)) {
      return place(file, tokens[i], word + " runs a command");
    }
    if ((word == "Macro" || word == "Function") && after(1).is("(")) {
      return place(file, tokens[i], word + "(...) runs text as commands");
    }
    if ((writes.count(word) > 0 && is_command) || (word == "Printf" && is_redirected(tokens, i + 1)) ||
        (word == "General" && after(1).is(".") && is_written(after(2).text))) {
      return place(file, tokens[i], word + " writes a file");
    }
    if (reads.count(word) == 0 || !is_command) return "";
    if (after(1).kind != Token::Kind::string || !after(2).is(";")) {
      return place(file, tokens[i], word + " reads a file whose name is computed");
    }
    const auto other = std::filesystem::path(file).parent_path() / after(1).text;
    std::error_code ignored;
    return is_data(other) || !std::filesystem::is_regular_file(other, ignored) ? "" : in(other);
  }

  /// Whether "(...)" is followed by ">".
  static bool is_redirected(const std::vector<Token>& tokens, std::size_t i) {
    int depth = 0;
    for (; i < tokens.size() && !tokens[i].is(";"); ++i) {
      depth += tokens[i].is("(") ? 1 : tokens[i].is(")") ? -1 : 0;
      if (depth == 0 && tokens[i].is(">")) return true;
    }
    return false;
  }

  /// Whether one of gmsh's general options makes it write files, or start a program.
  static bool is_written(const std::string& option) {
    const std::string end = "FileName";
    const bool is_name =
        option.size() >= end.size() && option.compare(option.size() - end.size(), end.size(), end) == 0;
    return is_name || option.rfind("Save", 0) == 0 || option == "TextEditor" || option == "WebBrowser";
  }

  std::set<std::string> seen_;
};

}  // namespace

std::string command_beyond_meshing(const std::string& geometry) {
  Search search;
  std::string found = search.in(geometry);
  const std::string options = geometry + ".opt";  // gmsh reads it after the geometry, unasked
  std::error_code ignored;
  const bool has_options = std::filesystem::is_regular_file(options, ignored);
  return found.empty() && has_options ? search.in(options) : found;
}

std::vector<std::string> undone_commands(const std::string& geometry) {
  const Tokens tokens(geometry);
  const auto& all = tokens.all();
  std::vector<std::string> found;
  for (std::size_t i = 0; i + 2 < all.size(); ++i) {
    if (all[i].is("Plugin") && all[i + 1].is("(") && all[i + 2].is("Crack")) found = {"Plugin(Crack)"};
  }
  for (const Token& token : all) {
    if (token.kind != Token::Kind::word || !token.is("RecombineMesh")) continue;
    found.emplace_back("RecombineMesh");
    break;
  }
  return found;
}

bool ignores_last_command(const std::string& geometry) {
  const Tokens tokens(geometry);
  if (tokens.text().empty() || tokens.text().back() == '\n') return false;
  const auto last_line = 1 + std::count(tokens.text().begin(), tokens.text().end(), '\n');
  const auto ends_command = [&](const Token& token) { return token.line == last_line && token.is(";"); };
  return std::count_if(tokens.all().begin(), tokens.all().end(), ends_command) > 1;
}

}  // namespace perimorph::mesh_files
