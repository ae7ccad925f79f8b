#include "studies/robustness/same_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/step_checks.h"
#include "studies/robustness/same_scene.h"
#include "studies/robustness/units.h"

namespace pbdcheck {

using namespace pbd;

namespace {

// Two answers agree to this share of the step's scale: each meets 1e-8 of it, and a Delassus matrix of the
// condition number 1e8 in the metric of its diagonal makes sqrt(1e8) times as much of that.
constexpr double agree = 1e-4;
constexpr double rounded_speed = 1e-6;  // of the speeds: what moves on as it is has no scale
constexpr double tight = 1e-11;         // tolerance by which conditioning is told from another solution

/// |v|_M of velocities and spins, sqrt(J).
double mass_norm_of(const Scene& scene, const Points& v, const Points& spin) {
  double sum = 0;
  for (int node = 0; node < scene.nodes(); ++node)
    if (const double mass = scene.mass[static_cast<std::size_t>(node)]; std::isfinite(mass))
      sum += mass * v.col(node).squaredNorm();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (const Vec3& inertia = scene.bodies[b].inertia; inertia.allFinite())
      sum += inertia.dot(spin.col(static_cast<Eigen::Index>(b)).cwiseAbs2());
  return std::sqrt(sum);
}

double apart(const Variant& variant, const FirstStep& own, const FirstStep& other) {
  const State to = variant.to(own.end);
  const double speed = mass_norm_of(variant.scene, other.end.v, other.end.spin);
  const double difference = mass_norm_of(variant.scene, to.v - other.end.v, to.spin - other.end.spin);
  if (difference == 0) return 0;  // of no scale where nothing moves
  return difference / std::max(other.report.scale, rounded_speed * speed);
}

Method tightened(Method method) {
  method.tolerance = tight;
  method.max_outer = 1000;
  method.max_sweeps = 10000;
  return method;
}

}  // namespace

std::vector<Variant> variants_of(const World& world, Random& random) {
  const Scene& scene = world.scene;
  std::vector<Variant> all;
  const Isometry turned{random.turn().toRotationMatrix(), random.vector(10)};
  const Isometry mirrored{Vec3(-1, 1, 1).asDiagonal(), Vec3::Zero()};
  for (const auto& [name, by] : {std::pair{"turned", turned}, std::pair{"mirrored", mirrored}})
    if (world.method.friction != "box")
      all.push_back(
          {name, moved(scene, by), world.method, [by = by](const State& state) { return moved(state, by); }});
  static constexpr double length = 1000, mass = 1e-3;
  all.push_back({"other units", in_units(scene, length, mass), world.method, [](State state) {
                   state.x *= length;
                   state.v *= length;
                   return state;
                 }});
  const Order order = any_order(scene, random);
  all.push_back({"other order", reordered(scene, order), world.method,
                 [order](const State& state) { return reordered(state, order); }});
  const auto unmoved = [](const State& state) { return state; };
  Method method = world.method;
  method.relaxation = world.method.relaxation == "direct" ? "conjugate_gradients" : "direct";
  all.push_back({"other linear solver", scene, method, unmoved});
  method = world.method;
  method.outer = world.method.outer == "proximal" ? "auto" : "proximal";
  all.push_back({"other outer iteration", scene, method, unmoved});
  return all;
}

FirstStep first_step(const Scene& scene, const Method& method, double h) {
  Workspace workspace(scene, method);
  FirstStep first{scene.initial, {}, {}};
  first.report = step(workspace, h, first.end);
  if (first.report.status == Status::ok)
    first.refuted = reference::StepCheck(scene)
                        .judge(claim_of(scene, workspace, scene.initial, first.end, h, first.report))
                        .refuted;
  return first;
}

Comparison compare(const World& world, const FirstStep& own, const Variant& variant) {
  FirstStep other = first_step(variant.scene, variant.method, world.h);
  Comparison found{.variant = variant.name, .refuted = std::move(other.refuted)};
  if (own.report.status != Status::ok || other.report.status != Status::ok) return found;
  found.agreement = Agreement::same;
  found.apart = apart(variant, own, other);
  for (const State* end : {&own.end, &std::as_const(other.end)})
    if (end->spin.cols() > 0)
      found.turn = std::max(found.turn, world.h * end->spin.colwise().norm().maxCoeff());
  if (found.apart <= agree) return found;
  found.agreement = Agreement::undecided;
  const FirstStep own_tight = first_step(world.scene, tightened(world.method), world.h),
                  other_tight = first_step(variant.scene, tightened(variant.method), world.h);
  if (own_tight.report.status != Status::ok || other_tight.report.status != Status::ok) return found;
  found.agreement =
      apart(variant, own_tight, other_tight) <= agree ? Agreement::conditioning : Agreement::other_solution;
  return found;
}

}  // namespace pbdcheck
