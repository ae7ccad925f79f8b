#include "cone_solvers.h"

#include <algorithm>

#include "choices.h"
#include "cone_interior_point.h"
#include "cone_ipopt.h"
#include "error.h"

namespace pbdcheck {

using pbd::reference::FrictionLaw;

const std::vector<ConeSolver>& cone_solvers() {
  static const std::vector<ConeSolver> list{
      {"cone_interior_point", {"coulomb", "cone"}, pbd::reference::cone_interior_point},
      {"cone_ipopt", {"coulomb", "cone"}, pbd::reference::cone_ipopt},
  };
  return list;
}

std::vector<std::string> cone_laws() {
  return {"coulomb", "cone", "box"};
}

const ConeSolver& find_cone_solver(const std::string& name, const std::string& law) {
  require_name("--law", law, cone_laws());
  std::vector<std::string> names;
  for (const auto& solver : cone_solvers()) names.push_back(solver.name);
  require_name("--relaxation", name, names);
  const auto& solver = *std::find_if(cone_solvers().begin(), cone_solvers().end(),
                                     [&](const ConeSolver& each) { return each.name == name; });
  require_name("--law with --relaxation " + name, law, solver.laws);
  return solver;
}

FrictionLaw friction_law(const std::string& name) {
  return name == "cone" ? FrictionLaw::cone : FrictionLaw::coulomb;
}

}  // namespace pbdcheck
