// Rigid bodies step by step, every step ok.
#pragma once

#include <catch2/catch.hpp>

#include "step/step.h"

namespace pbd::test {

inline Method body_method(std::string_view integrator) {
  Method method;
  method.integrator = integrator;
  method.relaxation = "direct";
  method.tolerance = 1e-13;
  return method;
}

inline State run_bodies(const Scene& scene, const Method& method, double h, int steps) {
  Workspace workspace(scene, method);
  State state = scene.initial;
  for (int k = 0; k < steps; ++k) {
    const Report report = step(workspace, h, state);
    INFO("step " << k << ": " << report.reason << ", residual " << report.residual() << " after "
                 << report.outer_iterations << " iterations, contraction " << report.contraction);
    CHECK(report.status == Status::ok);
  }
  return state;
}

}  // namespace pbd::test
