#include "harness/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pbdcheck {

Measured::Measured(std::vector<double> repeats) : Measured(std::nan("")) {
  if (repeats.empty() || std::any_of(repeats.begin(), repeats.end(), [](double r) { return std::isnan(r); }))
    return;
  std::sort(repeats.begin(), repeats.end());
  low = repeats.front();
  high = repeats.back();
  value = (repeats[(repeats.size() - 1) / 2] + repeats[repeats.size() / 2]) / 2;
}

Ruling Verdict::ruling() const {
  const auto within = [&](double size) { return size >= 0 && size <= bound; };
  if (within(measured.low) && within(measured.high)) return Ruling::holds;
  if (within(measured.low) && !std::isnan(measured.high)) return Ruling::not_decided;
  return basis == Basis::goal ? Ruling::missed : Ruling::fails;
}

std::string Verdict::reason() const {
  switch (ruling()) {
    case Ruling::holds:
      return "";
    case Ruling::not_decided:
      return fmt::format("spread: repeats from {:.6g} to {:.6g}, bound {:.6g}", measured.low, measured.high,
                         bound);
    default:
      if (!std::isfinite(measured.value)) return "no number was measured";
      if (measured.low < 0) return "a size is not negative";
      return fmt::format("{:.6g} > {:.6g}", measured.value, bound) +
             (measured.low == measured.high
                  ? ""
                  : fmt::format(", spread from {:.6g} to {:.6g}", measured.low, measured.high));
  }
}

}  // namespace pbdcheck
