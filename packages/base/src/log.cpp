#include "perimorph/base/log.hpp"

#include <spdlog/details/log_msg_buffer.h>
#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>
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

/// Keeps messages until there is a file for them.
class DeferredFile : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 public:
  void open(const std::string& name, bool append) {
    file_ = std::make_unique<spdlog::sinks::basic_file_sink_st>(name, !append);
    file_->set_formatter(std::make_unique<Printable>());
    for (const auto& message : early_) file_->log(message);
    file_->flush();
    early_.clear();
  }

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    if (file_) {
      file_->log(message);
    } else {
      early_.emplace_back(message);
    }
  }
  void flush_() override {
    if (file_) file_->flush();
  }

 private:
  std::unique_ptr<spdlog::sinks::basic_file_sink_st> file_;
  std::vector<spdlog::details::log_msg_buffer> early_;
};

}  // namespace

Log silent_log() {
  return std::make_shared<spdlog::logger>("perimorph", std::make_shared<spdlog::sinks::null_sink_st>());
}

Log make_log(const Comm& comm, bool quiet) {
  if (comm.getRank() != 0) return silent_log();
  auto terminal = std::make_shared<spdlog::sinks::stdout_sink_st>();
  terminal->set_level(quiet ? spdlog::level::warn : spdlog::level::info);
  const std::vector<spdlog::sink_ptr> sinks = {terminal, std::make_shared<DeferredFile>()};
  auto log = std::make_shared<spdlog::logger>("perimorph", sinks.begin(), sinks.end());
  log->set_formatter(std::make_unique<Printable>());
  log->flush_on(spdlog::level::info);
  return log;
}

void open_file(const Log& log, const std::string& file, bool append) {
  const auto sink = std::dynamic_pointer_cast<DeferredFile>(log->sinks().back());
  PERIMORPH_ASSERT(sink, "{}: this log has no file", file);
  try {
    sink->open(file, append);
  } catch (const spdlog::spdlog_ex& error) {
    throw UserError(fmt::format("{}: the log cannot be written: {}", file, error.what()));
  }
}

}  // namespace perimorph::base
