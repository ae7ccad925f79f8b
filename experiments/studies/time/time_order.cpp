// At which order does each integrator approach the motion in continuous time?
#include "harness/order_study.h"
#include "scenes/standard.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// Bob on a link along x of rest length 1 m, stretched by 0.1 m: 1 Hz.
Scene order_spring() {
  const double w = 2 * 3.14159265358979323846;
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1.1, 0, 0), 1);
  scene.effects.emplace_back(Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {1 / (w * w)}});
  return scene;
}

Scene compliant_links(int count, double compliance) {
  Scene scene = chain(count);
  for (double& each : std::get<Distance>(scene.effects[1]).compliance) each = compliance;
  return scene;
}

Scene tetrahedra() {
  return clamped_solid(kuhn_grid({4, 1, 1}, Vec3(1, 0.25, 0.25)), {1e5, 0.3}, Strain::green);
}

std::vector<Motion> order_motions() {
  return {{"spring", order_spring(), 1, 200},
          {"compliant links", compliant_links(3, 0.05), 0.5, 200},
          {"compliant double pendulum", compliant_links(2, 0.01), 0.5, 200},
          {"tetrahedra", tetrahedra(), 0.5, 200},
          {"hard pendulum", pendulum(1.5, 0), 1, 200, true},
          {"hard double pendulum", compliant_links(2, 0), 0.5, 200, true},
          {"hard pendulum over 10 s", pendulum(1.5, 0), 10, 400, true, false}};
}

}  // namespace

void time_order(Context& context) {
  auto scenes = order_motions();
  context.begin(std::ssize(scenes));
  study_orders(context, "time_order", std::move(scenes), {0.5, 0.55});
}

}  // namespace pbdcheck
