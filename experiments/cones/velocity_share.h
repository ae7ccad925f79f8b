// How far apart two solutions of a contact problem of the convex law may be.
#pragma once

#include "cone_problem.h"

namespace pbdcheck {

/// |du|^2 over what two solutions may differ by whose natural residuals are `residuals` together: at most 1.
/// Of the convex law u is unique: with dr, du = W dr the differences and e the sum of the natural maps,
///   |du|^2 <= w dr.du <= w |e| (|dr| + |du|),  w the largest eigenvalue of W;
/// e is known up to the rounding of W r + q.
double velocity_share(const pbd::reference::ConeProblem& problem, const pbd::reference::ConeSolution& a,
                      const pbd::reference::ConeSolution& b, double residuals);

}  // namespace pbdcheck
