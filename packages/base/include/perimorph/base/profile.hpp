#pragma once

#include <array>
#include <chrono>
#include <string>

namespace perimorph::base {

/// What a run spends its time on.
enum class Phase { read, search, assemble, preconditioner, cg, residual, bonds, adapt, write };
inline constexpr int n_phases = 9;

const char* name(Phase phase);

/// Peak memory of this process so far, [bytes].
double peak_memory();

/// Wall-clock seconds of this rank per phase. Phases do not nest: time of an inner one is also counted in the outer.
class Profile {
 public:
  using Clock = std::chrono::steady_clock;

  /// Adds the time until its end of life to one phase.
  class Scope {
   public:
    Scope(Profile& profile, Phase phase) : profile_(profile), phase_(phase), begin_(Clock::now()) {}
    ~Scope() { profile_.add(phase_, std::chrono::duration<double>(Clock::now() - begin_).count()); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Profile& profile_;
    Phase phase_;
    Clock::time_point begin_;
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
};

}  // namespace perimorph::base
