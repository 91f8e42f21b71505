#include "perimorph/input/mistakes.hpp"

#include <algorithm>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"

namespace perimorph::input {

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
  found_.push_back({line, path, fmt::format("{}: {}{}{}", where, path, path.empty() ? "" : ": ", what)});
  if (found_.size() == most_mistakes) report();
}

void Mistakes::report() {
  if (found_.empty()) return;
  std::stable_sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) {
    return a.line != command_line && (b.line == command_line || a.line < b.line);
  });
  std::string text = fmt::format("{} in {}", base::counted(found_.size(), "mistake"), file_);
  if (found_.size() == most_mistakes) {
    text = fmt::format("more than {} mistakes in {}, of which the first are", most_mistakes - 1, file_);
  }
  for (const auto& mistake : found_) text += "\n" + mistake.message;
  throw base::UserError(text);
}

bool Mistakes::none_in(const std::string& path) const {
  return std::none_of(found_.begin(), found_.end(),
                      [&](const Mistake& mistake) { return (mistake.path + "/").rfind(path + "/", 0) == 0; });
}

std::string in_quotes(const std::string& text) {
  std::string shown = text.substr(0, most_characters);
  for (char& c : shown) {
    if (base::is_control(c)) c = '?';
  }
  return fmt::format("\"{}{}\"", shown, text.size() > most_characters ? "..." : "");
}

}  // namespace perimorph::input
