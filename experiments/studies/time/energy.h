// The parts of the experiment `energy`, and what they measure.
#pragma once

#include "harness/experiment.h"
#include "scene.h"

namespace pbdcheck {

/// Kinetic and elastic energy at the start and m g times the scene's extent, J.
double energy_scale(const pbd::Scene& scene);

/// Sum of m |v| over the nodes of finite mass, kg m/s.
double momentum_scale(const pbd::Scene& scene, const pbd::State& state);

/// Sum of m v (kg m/s), and of m x cross v about the origin (kg m^2/s), over the nodes of finite mass.
pbd::Vec3 linear_momentum(const pbd::Scene& scene, const pbd::State& state);
pbd::Vec3 angular_momentum(const pbd::Scene& scene, const pbd::State& state);

/// Free bodies without gravity: links between 7 nodes (m/N), a net with bending, a solid (Pa).
pbd::Scene free_links(double compliance);
pbd::Scene free_net();
pbd::Scene free_beam(int cells, double young);

void energy_series(Context& context);
void energy_drift(Context& context);
void energy_map(Context& context);
void energy_momentum(Context& context);

}  // namespace pbdcheck
