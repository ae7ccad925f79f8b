#include "judge.h"

#include <IpoptConfig.h>
#include <SuiteSparse_config.h>
#include <gsl/gsl_version.h>

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

std::vector<std::pair<std::string, std::string>> library_versions() {
  const auto dotted = [](int major, int minor, int patch) {
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
  };
  return {
      {"suitesparse", dotted(SUITESPARSE_MAIN_VERSION, SUITESPARSE_SUB_VERSION, SUITESPARSE_SUBSUB_VERSION)},
      {"ipopt", IPOPT_VERSION},
      {"gsl", gsl_version}};
}

}  // namespace pbd::reference
