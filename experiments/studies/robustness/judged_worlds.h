// Steps of generated worlds beside a judge that solves them anew.
#pragma once

#include "harness/experiment.h"

namespace pbdcheck {

/// The table `judged` of the first `count` worlds that the judge takes (implicit Euler, the laws coulomb and
/// cone, shapes and joints that it knows), and a verdict: of each world one of the first four steps, where
/// that says ok.
///
/// For rows that are linear and all act, residuals r of M (v - v_free) = J^T p and s of J v + b + Sigma p = 0
/// leave
///   |v - v*|_M <= |r| + (s^T N^-1 s)^(1/2) <= (1 + lambda^(-1/2)) residual
/// where N = J W J^T + Sigma, and lambda is the least eigenvalue of N beside the blocks N_ii that measure s.
/// What is nonlinear, and Coulomb's law, which may have several solutions, may leave more.
void judge_worlds(Context& context, std::int64_t count);

}  // namespace pbdcheck
