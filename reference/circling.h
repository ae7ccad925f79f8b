// A mass that circles on a link under Newmark's rule of parameter alpha: what a step makes of a disturbance.
//
// In a frame that turns with the link by theta = h w a step, radial and tangential disturbances have constant
// coefficients. With T = ((mu e^{i theta} - 1)/((1 - alpha) + alpha mu e^{i theta}))^2 and S its counterpart
// for -theta, they grow by the roots mu a step of
//   T S + (k + g)/2 (T + S) + k g = 0,   k = (h w_n)^2, g = -Re T(mu = 1),
// w_n = 1/sqrt(A m) the link's frequency at rest, and of (T + S)/2 + g = 0 where the link is hard. g is the
// link's tension (h^2/(m l)). Exact for alpha = 1/2; for larger alpha the circling slows down, by about
// (2 alpha - 1) theta^2 of its speed a step, and the roots are those of its present rate.
//
// As theta -> 0 the hard link's roots other than those of the circling (near 1) are
//   mu = -r (1 +- theta),   r = (1 - alpha)/alpha,
// so alpha = 1/2 multiplies them by 1 + h w: a disturbance grows as exp(w t), however small the step.
#pragma once

namespace pbd::reference {

/// Largest |mu| of the two disturbances that are not the circling's own. `turn` is theta (rad), `stiffness` h
/// w_n, infinite for a hard link.
double circling_growth(double alpha, double turn, double stiffness);

/// The smallest alpha in [1/2, 1] from which on that is at most 1.
double smallest_stable_alpha(double turn, double stiffness);

}  // namespace pbd::reference
