// How far impulses and velocities are from what their laws ask for: each constraint's residual is what a step
// of block Jacobi would change, in the norm of N_ii.
#pragma once

#include "rows/rows.h"

namespace pbd {

/// sqrt(sum_i) of the squared residuals of all rows at v, sqrt(J).
double natural_residual(const Rows& rows, const Points& v);

}  // namespace pbd
