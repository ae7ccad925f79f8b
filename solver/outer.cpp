#include "outer.h"

namespace pbd {
namespace {

void plain(OuterIteration& iteration) {
  iteration.v() = iteration.rebuilt();
  iteration.relax();
}

void incremental(OuterIteration& iteration) {
  if (iteration.first()) iteration.v() = iteration.rebuilt();
  iteration.relax();
}

void frozen(OuterIteration& iteration) {
  iteration.linearise_at_start();
  iteration.v() = iteration.rebuilt();
  iteration.relax();
}

void proximal(OuterIteration& iteration) {
  iteration.add_inertia();
  iteration.v() = iteration.rebuilt();
  iteration.relax();
  iteration.accelerate();
}

void quasi_newton(OuterIteration& iteration) {
  if (iteration.on_potential()) {
    iteration.descend();
  } else {
    iteration.project();
    iteration.accelerate();
  }
}

void automatic(OuterIteration& iteration) {
  if (iteration.on_potential())
    quasi_newton(iteration);
  else if (iteration.plain_contracts())
    plain(iteration);
  else
    proximal(iteration);
}

}  // namespace

const std::vector<Outer>& outers() {
  static const std::vector<Outer> list{{"auto", true, automatic, OnPotential::where_possible},
                                       {"plain", true, plain},
                                       {"proximal", true, proximal},
                                       {"quasi_newton", true, quasi_newton, OnPotential::always},
                                       {"incremental", false, incremental},
                                       {"frozen", false, frozen}};
  return list;
}

}  // namespace pbd
