#include "judge.h"

#include <array>

#include "error.h"
#include "nonlinear.h"
#include "primal_newton.h"

namespace pbd::reference {

std::span<const NamedJudge> judges() {
  static constexpr std::array<NamedJudge, 2> list{{{"primal_newton", primal_newton}, {"ipopt", ipopt}}};
  return list;
}

Judge find_judge(std::string_view name) {
  std::string allowed;
  for (const NamedJudge& known : judges()) {
    if (known.name == name) return known.judge;
    allowed += (allowed.empty() ? "" : ", ") + std::string(known.name);
  }
  throw SetupError("reference", name, allowed);
}

}  // namespace pbd::reference
