// One implicit Euler step by vertex block descent (chen2024vbd).
//
// From y, sweeps over the nodes, in the scene's order, each at once in force: a Newton step of phi
// (implicit_step.h) by that node's place alone,
//
//   x_i -= H_i^-1 dphi/dx_i,   H_i = m_i/h^2 + d2U/dx_i^2
//
// with the true second derivatives and no line search, as its authors' code has it; a node whose H_i is
// singular stays. It is block Gauss-Seidel on phi. Near a minimum each sweep lowers phi, and sweeps come to
// the step's solution, the slower the stiffer the scene and the finer its mesh; from afar nothing holds them
// to that.
#pragma once

#include "rivals/rival.h"

namespace pbd::rivals {

/// Throws SetupError as `newton` does.
std::unique_ptr<Rival> vbd(const Scene& scene, double h);

}  // namespace pbd::rivals
