#include "method.h"

#include <cmath>
#include <sstream>

#include "error.h"

namespace pbd {
namespace {

void require(bool holds, std::string_view name, double value, std::string_view allowed) {
  if (holds) return;
  std::ostringstream text;
  text << value;
  throw SetupError(name, text.str(), allowed);
}

}  // namespace

void validate(const Method& method) {
  require(method.direction_blend >= 0 && method.direction_blend <= 1, "direction_blend",
          method.direction_blend, "0 to 1");
  require(method.stabilisation >= 0 && method.stabilisation <= 1, "stabilisation", method.stabilisation,
          "0 to 1");
  require(method.rho >= 0 && method.rho <= 1, "rho", method.rho, "0 to 1");
  require(method.alpha >= 0.5 && method.alpha <= 1, "alpha", method.alpha, "0.5 to 1");
  constexpr int most_threads = 256;
  require(method.threads >= 1 && method.threads <= most_threads, "threads", method.threads, "1 to 256");
  if (method.beta.has_value() != method.gamma.has_value())
    throw SetupError(method.beta ? "beta" : "gamma", "one of beta and gamma", "both, or neither");
  if (!method.beta) return;
  require(*method.beta > 0 && std::isfinite(*method.beta), "beta", *method.beta, "a finite number > 0");
  require(*method.gamma >= 0.5 && std::isfinite(*method.gamma), "gamma", *method.gamma,
          "a finite number >= 0.5");
}

}  // namespace pbd
