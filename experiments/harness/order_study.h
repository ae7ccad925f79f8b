// At which order steps approach motions in continuous time: errors against the judge `ode` at four times of
// each motion, over steps halved again and again; the observed order is that of the four finest ones.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "harness/experiment.h"
#include "ode.h"
#include "scene.h"

namespace pbdcheck {

struct Motion {
  std::string name;
  pbd::Scene scene;
  double duration;     // s
  int coarsest_steps;  // of the first level; a multiple of 4
  bool hard = false;
  bool judged = true;                  // false: so long that the orders are not yet seen
  int highest_order = 2;               // that the scene's forces allow
  std::string_view shown_elsewhere{};  // an integrator whose steps another motion shows already
  pbd::reference::Trajectory exact{};
  double size = 0;  // m, the largest displacement from the start at a sample
};

/// All integrators (newmark with these alphas) on all motions: tables `errors` and `orders`, and a verdict
/// where the order is known. Positions are those of nodes and, of bodies, of points at the radii of gyration.
void study_orders(Context& context, std::string_view experiment, std::vector<Motion> motions,
                  const std::vector<double>& alphas);

}  // namespace pbdcheck
