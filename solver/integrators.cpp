#include "integrators.h"

namespace pbd {
namespace {

void implicit_euler(const State& state, const Points& acceleration, double h, StepMap& map) {
  map.x0 = state.x;
  map.v_free = state.v + h * acceleration;
  map.d = h;
  map.s = h;
}

}  // namespace

const std::vector<Integrator>& integrators() {
  static const std::vector<Integrator> list{{"implicit_euler", 1, implicit_euler}};
  return list;
}

}  // namespace pbd
