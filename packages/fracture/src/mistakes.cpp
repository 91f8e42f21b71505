#include "mistakes.hpp"

#include <algorithm>

#include "perimorph/base/errors.hpp"

namespace perimorph::fracture {

namespace {
constexpr std::size_t most_mistakes = 100;
constexpr std::size_t most_characters = 60;
}  // namespace

int line_of(const std::map<std::string, int>& lines, std::string path) {
  for (;;) {
    const auto found = lines.find(path);
    if (found != lines.end()) return found->second;
    const auto slash = path.rfind('/');
    if (slash == std::string::npos) return 1;
    path.erase(slash);
  }
}

void Mistakes::add(int line, const std::string& path, const std::string& what) {
  const std::string where = line == command_line ? "--set" : fmt::format("{}:{}", file_, line);
  found_.emplace_back(line, fmt::format("{}: {}{}{}", where, path, path.empty() ? "" : ": ", what));
  if (found_.size() == most_mistakes) report();
}

void Mistakes::report() {
  if (found_.empty()) return;
  std::stable_sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) {
    return a.first != command_line && (b.first == command_line || a.first < b.first);
  });
  std::string text = fmt::format("{} mistake{} in {}", found_.size(), found_.size() == 1 ? "" : "s", file_);
  if (found_.size() == most_mistakes) {
    text = fmt::format("more than {} mistakes in {}, of which the first are", most_mistakes - 1, file_);
  }
  for (const auto& [line, message] : found_) text += "\n" + message;
  throw base::UserError(text);
}

std::string in_quotes(const std::string& text) {
  std::string shown = text.substr(0, most_characters);
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return fmt::format("\"{}{}\"", shown, text.size() > most_characters ? "..." : "");
}

}  // namespace perimorph::fracture
