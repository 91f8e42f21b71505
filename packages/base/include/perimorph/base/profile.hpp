#pragma once

#include <array>
#include <chrono>
#include <string>
#include <utility>

namespace perimorph::base {

/// What a run spends its time on.
enum class Phase { read, search, assemble, preconditioner, cg, residual, bonds, adapt, write };
inline constexpr int n_phases = 9;

const char* name(Phase phase);

/// Peak memory of this process so far, [bytes].
double peak_memory();

/// Wall-clock seconds of this rank per phase. While an inner phase lasts, the outer one waits.
class Profile {
 public:
  using Clock = std::chrono::steady_clock;

  /// Adds the time until its end of life to one phase.
  class Scope {
   public:
    Scope(Profile& profile, Phase phase)
        : profile_(profile), phase_(phase), begin_(Clock::now()), outer_(std::exchange(profile.innermost_, this)) {}
    ~Scope() {
      const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
      profile_.add(phase_, seconds - inner_seconds_);
      profile_.innermost_ = outer_;
      if (outer_ != nullptr) outer_->inner_seconds_ += seconds;
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Profile& profile_;
    Phase phase_;
    Clock::time_point begin_;
    Scope* outer_;
    double inner_seconds_ = 0.;
  };

  [[nodiscard]] Scope measure(Phase phase) { return Scope(*this, phase); }
  /// One more call of a phase. @param seconds that it took, >= 0, [s]
  void add(Phase phase, double seconds) {
    seconds_[static_cast<int>(phase)] += seconds;
    ++calls_[static_cast<int>(phase)];
  }

  /// What a phase has taken in all, [s].
  double seconds(Phase phase) const { return seconds_[static_cast<int>(phase)]; }
  /// Since this was made, [s].
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// A table of phases: seconds, share of the elapsed time, calls.
  std::string table() const;

 private:
  std::array<double, n_phases> seconds_{};
  std::array<long, n_phases> calls_{};
  Clock::time_point start_ = Clock::now();
  Scope* innermost_ = nullptr;
};

}  // namespace perimorph::base
