#include "judge.h"

#include <IpoptConfig.h>
#include <SuiteSparse_config.h>
#include <gsl/gsl_version.h>

#include <array>

#include "cone_interior_point.h"
#include "cone_ipopt.h"
#include "contact_newton.h"
#include "error.h"
#include "nonlinear.h"
#include "primal_newton.h"

namespace pbd::reference {

std::span<const NamedJudge> judges() {
  static constexpr std::array<NamedJudge, 2> list{{{"primal_newton", primal_newton}, {"ipopt", ipopt}}};
  return list;
}

std::span<const NamedContactJudge> contact_judges() {
  constexpr auto interior_point = [](const Scene& scene, const State& state, double h, Friction friction,
                                     const ContactStart& start) -> Judgement {
    return contact_newton(scene, state, h, friction, cone_interior_point, start);
  };
  constexpr auto by_ipopt = [](const Scene& scene, const State& state, double h, Friction friction,
                               const ContactStart& start) -> Judgement {
    return contact_newton(scene, state, h, friction, cone_ipopt, start);
  };
  static constexpr std::array<NamedContactJudge, 2> list{
      {{"cone_interior_point", interior_point}, {"cone_ipopt", by_ipopt}}};
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
