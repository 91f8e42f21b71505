#include "perimorph/base/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"

namespace perimorph::base {

namespace {

/// The message alone, a line each. What a case or a mesh says in it must not steer the terminal.
class Printable : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) override {
    const std::string text = printable(std::string(message.payload.data(), message.payload.size())) + '\n';
    line.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<spdlog::formatter> clone() const override { return std::make_unique<Printable>(); }
};

}  // namespace

Log silent_log() {
  return std::make_shared<spdlog::logger>("perimorph", std::make_shared<spdlog::sinks::null_sink_st>());
}

Log make_log(const Comm& comm, bool quiet, const std::string& file, bool append) {
  if (comm.getRank() != 0) return silent_log();
  auto terminal = std::make_shared<spdlog::sinks::stdout_sink_st>();
  terminal->set_level(quiet ? spdlog::level::warn : spdlog::level::info);
  std::vector<spdlog::sink_ptr> sinks = {terminal};
  if (!file.empty()) {
    try {
      sinks.push_back(std::make_shared<spdlog::sinks::basic_file_sink_st>(file, !append));
    } catch (const spdlog::spdlog_ex& error) {
      throw UserError(fmt::format("{}: the log cannot be written: {}", file, error.what()));
    }
  }
  auto log = std::make_shared<spdlog::logger>("perimorph", sinks.begin(), sinks.end());
  log->set_formatter(std::make_unique<Printable>());
  log->flush_on(spdlog::level::info);
  return log;
}

}  // namespace perimorph::base
