// What a chain that hangs straight stretches to where its links are not solved to the end. At rest each step
// begins with the links that h^2 g opens, c~ = c + h^2 g e_1, and n sweeps from zero impulses leave
//   c = F c~,   F = I - N (N + Sigma)^-1 (I - E^n),   E = I - (N + Sigma) B^-1
// N = J W J^T, Sigma = A/h^2, B the lower triangle of N + Sigma with its diagonal over k: Gauss-Seidel, k =
// 1, or classic PBD's relaxation factor k in (0, 1]. So c = (I - F)^-1 F h^2 g e_1. Of one mass on one hard
// link the effective stiffness is (m/h^2) (1 - (1 - k)^n)/(1 - k)^n: it depends on h and n.
#pragma once

#include "scene.h"

namespace pbdcheck {

/// A chain of equal links over 1 m that hangs straight down, not stretched, at rest.
pbd::Scene hanging_chain(int links, double compliance);

/// m, of all links, by this formula.
double predicted_stretch(const pbd::Scene& chain, double h, int sweeps, double factor);

/// m, sum of m g A over what hangs below each link: the equilibrium.
double physical_stretch(const pbd::Scene& chain);

/// A step of classic PBD (mueller2007position): x~ = x + h v + h^2 g, n sweeps over the links of dx = -k W
/// J^T c/(J W J^T), v = (x - x_l)/h. For hard links and gravity.
void classic_step(const pbd::Scene& scene, double h, int sweeps, double factor, pbd::State& state);

}  // namespace pbdcheck
