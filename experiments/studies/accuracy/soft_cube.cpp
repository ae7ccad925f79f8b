#include "studies/accuracy/soft_cube.h"

#include <algorithm>
#include <cmath>

#include "harness/contact_sums.h"
#include "harness/step_checks.h"
#include "harness/step_judge.h"

namespace pbdcheck {

using namespace pbd;

namespace {

constexpr double side = soft_cube_side, density = 1000;  // m, kg/m^3
constexpr double h = 0.5;                                // s
/// Of the nodes that touch, m: what a judge allows shapes to overlap is a share of how round they are.
constexpr double radius = 1e-3;

/// Of a place of the mesh, above its lower face.
bool at_height(const Vec3& x, double height) {
  return std::abs(x.z() - radius - height) < 1e-9 * side;
}

double mean_sag(const SoftCube& cube, const Points& moved) {
  double sum = 0;
  int count = 0;
  for (int i = 0; i < cube.mesh.x.cols(); ++i)
    if (at_height(cube.mesh.x.col(i), side)) sum -= moved(2, i), ++count;
  return sum / count;
}

double mean_bulge(const SoftCube& cube, const Points& moved) {
  double sum = 0;
  int count = 0;
  for (int i = 0; i < cube.mesh.x.cols(); ++i) {
    const Vec3 x = cube.mesh.x.col(i);
    if (!at_height(x, side / 2)) continue;
    for (const int axis : {0, 1})
      if (const double out = 2 * x[axis] / side; std::abs(out) > 1 - 1e-9)
        sum += out * moved(axis, i), ++count;
  }
  return 2 * sum / count / side;
}

}  // namespace

double plate_weight() {
  return plate_strain * soft_cube_young * side * side;
}

double cube_weight() {
  return density * side * side * side * gravity;
}

SoftCube soft_cube(const CubeCase& each, double kappa) {
  const TetMesh mesh =
      kuhn_grid({each.n, each.n, each.n}, Vec3::Constant(side), Vec3(-side / 2, -side / 2, radius));
  BodyScene build({.friction = each.friction});
  build.ground();
  constexpr double thick = 0.05;
  if (each.plate)
    build.box(Vec3(2 * side, 2 * side, thick), plate_weight() / gravity,
              {Vec3(0, 0, side + 2 * radius + thick / 2)});
  const int first = each.plate ? 2 : 1;
  Contact& contact = build.contact();
  for (int i = 0; i < mesh.x.cols(); ++i)
    if (at_height(mesh.x.col(i), 0) || (each.plate && at_height(mesh.x.col(i), side)))
      contact.node.push_back(first + i);
  contact.radius.assign(contact.node.size(), radius);
  contact.node_material.assign(contact.node.size(), 0);
  Scene scene = build.finish();
  if (each.plate) scene.bodies[1].inertia.setConstant(infinity);  // one that tilts slides off
  add_solid(scene, mesh, density, {soft_cube_young, each.poisson}, Strain::corotational);
  if (each.model == Model::springs) scene.effects.back() = edge_springs(mesh, kappa * soft_cube_young, first);
  return {mesh, std::move(scene), first};
}

Resting rest(const SoftCube& cube, const Method& method, bool judge) {
  // Of a mode's way a step leaves 1/sqrt(1 + (w h)^2). The slowest one, the plate on the cube, has w^2 > E
  // A/(L (W/g + m)), about 2e2: 1/10 or less is left, and 1e-12 of it all.
  constexpr int steps = 12;
  Resting found;
  Workspace workspace(cube.scene, method);
  State state = cube.scene.initial;
  double off = 0;
  const double lightest = *std::min_element(cube.scene.mass.begin() + cube.first, cube.scene.mass.end());
  for (; found.steps < steps && found.status != Status::diverged; ++found.steps) {
    throw_if_interrupted();
    const State before = state;
    const Report report = step(workspace, h, state);
    found.sweeps += report.sweeps;
    if (report.status > found.status) found.status = report.status, found.reason = report.reason;
    if (!judge) continue;
    const auto judged =
        judge_claim("cone_interior_point", claim_of(cube.scene, workspace, before, state, h, report));
    if (std::isnan(judged.nearest.metres)) continue;
    ++found.judged_steps;
    off += judged.nearest.metres;
    found.allowed += h * method.tolerance * report.scale / std::sqrt(lightest);
  }
  const Points moved = state.x.rightCols(cube.mesh.x.cols()) - cube.mesh.x;
  found.sag = mean_sag(cube, moved);
  found.bulge = mean_bulge(cube, moved);
  found.ground = -contact_force(*contact_of(cube.scene), workspace.contacts(), 0, -1).force.z();
  for (const EffectCost& cost : workspace.costs()) found.rows += cost.rows;
  found.off_judge = found.judged_steps > 0 ? off / found.sag : std::nan("");
  found.allowed /= found.sag;
  return found;
}

}  // namespace pbdcheck
