// A statement of an experiment that was measured against a bound, and what came of it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace pbdcheck {

/// What a verdict rests on, and so what it means if it fails. A goal is a number that somebody chose: to miss
/// it is told, and is no failure.
enum class Basis {
  code,        // code that shares nothing with the solver finds the same
  theory,      // the number, and how far the solver may be from it, are derived
  paper,       // the paper claims it
  robustness,  // the solver ends well: no throw, no false claim, no state that blows up
  goal
};

inline constexpr std::array<std::string_view, 5> basis_names{"code", "theory", "paper", "robustness", "goal"};

/// `not_decided`: some repeats are within the bound and some are not. `missed`: a goal.
enum class Ruling { holds, fails, missed, not_decided };

inline constexpr std::array<std::string_view, 4> ruling_names{"holds", "fails", "missed", "not_decided"};

/// A size that was measured, >= 0: once, or as the median of repeats from `low` to `high`.
struct Measured {
  double value = 0, low = 0, high = 0;

  Measured(double once) : value(once), low(once), high(once) {}  // NOLINT(google-explicit-constructor)
  /// NaN of no repeats, or once one is NaN.
  explicit Measured(std::vector<double> repeats);
};

struct Verdict {
  Basis basis = Basis::code;
  std::string id{}, statement{}, quantity{};
  Measured measured = 0;
  double bound = 0;

  /// Holds if every repeat is from 0 to the bound; NaN never is, and no negative number.
  Ruling ruling() const;
  bool failed() const { return ruling() == Ruling::fails; }
  /// Why it does not hold, "" if it does.
  std::string reason() const;
};

}  // namespace pbdcheck
