// Do structures stand and fall where they should? What the ground and each joint of columns and pyramids
// carry, slabs on more points than statics can tell apart, bricks that overhang and arches at their limits.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "linear/linear_names.h"
#include "scenes/arch.h"
#include "scenes/contacts.h"
#include "studies/contact/contact_answers.h"
#include "studies/contact/stack.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// N, of the bodies from the one on.
double weight_from(const Scene& scene, std::size_t first) {
  double mass = 0;
  for (std::size_t k = first; k < scene.mass.size(); ++k)
    if (std::isfinite(scene.mass[k])) mass += scene.mass[k];
  return mass * gravity;
}

/// Bodies at rest, collider 0 the ground: forces and overlaps of all steps.
void rest(KnownAnswers& answers, const Method& method, const std::string& name, const Scene& scene,
          bool column) {
  constexpr double size = 0.2;  // m
  const Vec3 up(0, 0, weight_from(scene, 1));
  Worst carried, between, overlap;
  const ContactRun run =
      simulate_contacts(scene, method, contact_h, 20, [&](const State&, const Workspace& workspace) {
        carried.add((force_across(workspace, 1) - up).norm() / up.norm());
        overlap.add(0);
        for (const ContactForce& contact : workspace.contacts()) overlap.add(-contact.gap / size);
        for (int k = 1; column && k < std::ssize(scene.bodies); ++k) {
          const double above = weight_from(scene, static_cast<std::size_t>(k));
          between.add((force_across(workspace, k) - Vec3(0, 0, above)).norm() / above);
        }
      });
  answers.add("weight", name, method, contact_h, carried.value(), 0, carried.value(), run);
  if (column) answers.add("joints", name, method, contact_h, between.value(), 0, between.value(), run);
  answers.add("penetration", name, method, contact_h, overlap.value(), 0, overlap.value(), run);
}

constexpr double slab_friction = 0.5, slab_speed = 0.3, slab_mass = 10;

/// A slab that slides to rest on side x side fixed balls; it is the last body.
Scene slab_on_posts(int side) {
  constexpr double radius = 0.02, pitch = 0.06;
  BodyScene build({.friction = slab_friction});
  const double middle = (side - 1) / 2.0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      build.fixed(Sphere{radius}, {Vec3((i - middle) * pitch, (j - middle) * pitch, -radius)});
  build.box(Vec3(1, 1, 0.02), slab_mass,
            {Vec3(0, 0, 0.01), Eigen::Quaterniond::Identity(), Vec3(slab_speed, 0, 0)});
  return build.finish();
}

void carried_slab(KnownAnswers& answers, const Method& method, int side) {
  const Scene scene = slab_on_posts(side);
  const int body = side * side;
  Worst force;
  const ContactRun run =
      simulate_contacts(scene, method, contact_h, 10, [&](const State&, const Workspace& workspace) {
        force.add(std::abs(force_across(workspace, body).z() / (slab_mass * gravity) - 1));
      });
  const double exact = slide(slab_speed, slab_friction * gravity, contact_h, 10).x,
               moved = run.end.x(0, body);
  const std::string name = fmt::format("slab on {} balls", side * side);
  answers.add("redundant_force", name, method, contact_h, force.value(), 0, force.value(), run);
  answers.add("redundant_motion", name, method, contact_h, moved, exact,
              (run.end.x.col(body) - Vec3(exact, 0, 0.01)).norm(), run);
}

/// The same bodies and colliders, those of one contact alone, in the opposite order.
Scene reversed(const Scene& scene) {
  Scene turned;
  const int count = static_cast<int>(std::ssize(scene.bodies));
  for (int b = count - 1; b >= 0; --b) {
    const auto& [node, inertia] = scene.bodies[static_cast<std::size_t>(b)];
    add_body(turned, scene.initial.x.col(node), scene.mass[static_cast<std::size_t>(node)], inertia,
             scene.initial.orientation[static_cast<std::size_t>(b)], scene.initial.v.col(node),
             scene.initial.spin.col(b));
  }
  turned.effects = scene.effects;
  for (Effect& effect : turned.effects)
    if (auto* contact = std::get_if<Contact>(&effect)) {
      std::reverse(contact->collider.begin(), contact->collider.end());
      for (Collider& collider : contact->collider) collider.body = count - 1 - collider.body;
    }
  return turned;
}

/// Cubes, a slab and a ball that slide and rest on each other, in either order: largest distance of a body.
void permuted_pile(KnownAnswers& answers, const Method& method) {
  const Scene scene = pile();
  const ContactRun run = simulate_contacts(scene, method, contact_h, 10);
  const ContactRun other = simulate_contacts(reversed(scene), method, contact_h, 10);
  const double apart = (run.end.x - other.end.x.rowwise().reverse()).colwise().norm().maxCoeff();
  answers.add("permuted_motion", "pile", method, contact_h, apart, 0, apart,
              run.status > other.status ? run : other);
}

/// N, vertical forces on the colliders in the last of six steps, while a slab of 0.3 m/s still slides (it
/// loses mu g h = 0.049 m/s a step). At rest friction is not unique, and what is left of it slows the
/// solvers.
Eigen::VectorXd vertical_forces(const Scene& scene, const Method& method, ContactRun& run) {
  Eigen::VectorXd up = Eigen::VectorXd::Constant(std::ssize(scene.bodies), std::nan(""));
  run = simulate_contacts(scene, method, contact_h, 6, [&](const State&, const Workspace& workspace) {
    up.setZero();
    for (const ContactForce& contact : workspace.contacts()) {
      up[contact.collider[0]] += contact.force.z();
      up[contact.collider[1]] -= contact.force.z();
    }
  });
  return up;
}

/// Of a slab that slides on 4 x 4 balls which give way, in either order: largest difference of a ball's
/// force, of the mean.
void permuted_posts(KnownAnswers& answers, const Method& method) {
  constexpr int side = 4;
  Scene scene = slab_on_posts(side);
  for (Effect& effect : scene.effects)
    if (auto* contact = std::get_if<Contact>(&effect)) contact->law[0].compliance = 1e-6;  // m/N
  ContactRun run, other;
  const Eigen::VectorXd forces = vertical_forces(scene, method, run);
  const Eigen::VectorXd turned = vertical_forces(reversed(scene), method, other);
  const double mean = slab_mass * gravity / (side * side);
  const double apart = (forces - turned.reverse()).cwiseAbs().maxCoeff() / mean;
  answers.add("permuted_force", "slab on 16 balls that give way", method, contact_h, apart, 0, apart,
              run.status == Status::ok ? other : run);
}

/// Stands: no body moves by more than 1e-4 of the size. Falls: one moves by a tenth of it.
void judge(Table& table, Worst& wrong, const Method& method, const std::string& structure, int count,
           double share, const Scene& scene, double duration, double size) {
  const ContactRun run = simulate_contacts(scene, method, contact_h, std::lround(duration / contact_h));
  const double moved = (run.end.x - scene.initial.x).colwise().norm().maxCoeff() / size;
  const bool usable = run.status != Status::diverged, stands = (share < 1) == (structure == "overhang");
  const bool right = usable && (stands ? moved <= 1e-4 : moved >= 0.1);
  table.row({structure, std::int64_t{count}, share, method.outer, method.relaxation, method.friction,
             contact_h, duration, usable ? moved : std::nan(""), std::string(stands ? "stands" : "falls"),
             std::int64_t{right}, run.sweeps, std::int64_t{run.steps - run.steps_ok}, status_cell(run.status),
             run.reason});
  wrong.add(usable ? (right ? 0.0 : 1.0) : std::nan(""), method.relaxation);
}

}  // namespace

Vec3 force_across(const Workspace& workspace, int first) {
  Vec3 sum = Vec3::Zero();
  for (const ContactForce& contact : workspace.contacts()) {
    if (contact.collider[0] >= first && contact.collider[1] < first) sum += contact.force;
    if (contact.collider[1] >= first && contact.collider[0] < first) sum -= contact.force;
  }
  return sum;
}

Scene overhang(int count, double share) {
  constexpr double length = 0.2, height = 0.05;
  BodyScene build({.friction = 0.7});
  build.fixed(Box{Vec3(1, 1, 0.2)}, {Vec3(-0.5, 0, -0.1)});
  double edge = 0;
  for (int k = count; k >= 1; --k) {
    edge += share * length / (2 * k);
    build.box(Vec3(length, 0.1, height), 2, {Vec3(edge - length / 2, 0, (count - k + 0.5) * height)});
  }
  return build.finish();
}

void stack(Context& context) {
  const std::vector<std::string> accurate{"conjugate_gradients", "direct"};
  const auto relaxations = general_solver_names();
  KnownAnswers answers(
      context, "stack",
      {{"weight", "the ground carries the weight", "relative", 1e-9},
       {"joints", "each joint of a column carries what is above", "relative", 1e-8},
       {"penetration", "nothing sinks in", "of the size", 1e-8},
       {"redundant_force", "however many points carry a slab, they carry its weight", "relative", 1e-9},
       {"redundant_motion", "it moves the same on them", "m", 1e-9},
       {"permuted_motion", "a pile moves the same whatever the order of its bodies and contacts", "m", 1e-9},
       // Velocities are solved to 1e-12 of 0.3 m/s; h of that over 1e-6 m/N is 3e-9 N of 6 N.
       {"permuted_force", "points that give way carry the same whatever their order", "of the mean", 1e-8}});
  context.begin(std::ssize(relaxations) + 2 * std::ssize(accurate));
  for (const auto relaxation : relaxations) {
    const Method method = patient_method(relaxation);
    for (const int count : context.full() ? std::vector{2, 5, 10, 20, 50} : std::vector{2, 5, 10})
      rest(answers, method, fmt::format("column of {}", count), column(count), true);
    for (const double ratio : {1e2, 1e4})
      rest(answers, method, fmt::format("two cubes, masses 1:{:g}", ratio), column(2, ratio), true);
    for (const int base : context.full() ? std::vector{4, 10} : std::vector{4})
      rest(answers, method, fmt::format("pyramid of base {}", base), pyramid(base), false);
    for (const int side : {2, 4, 10}) carried_slab(answers, method, side);
    permuted_pile(answers, method);
    permuted_posts(answers, method);
    context.advance(relaxation);
  }
  answers.close();
  Table table = context.table(
      "thresholds", {"structure", "count", "share", "outer", "relaxation", "friction", "step_s", "duration_s",
                     "moved", "outcome", "right", "sweeps", "missed_steps", "status", "reason"});
  Worst overhangs, arches;
  for (const auto& relaxation : accurate) {
    const Method method = contact_method(relaxation);
    for (const int count : context.full() ? std::vector{2, 3, 5, 10} : std::vector{2, 3, 5})
      for (const double share : {0.999, 1.001})
        judge(table, overhangs, method, "overhang", count, share, overhang(count, share), 3, 0.2);
    context.advance("overhangs, " + relaxation);
    for (const int stones : context.full() ? std::vector{7, 15, 25} : std::vector{7})
      for (const double share : {0.99, 1.01})
        judge(table, arches, method, "arch", stones, share,
              Arch{share * limit_thickness(stones), stones}.scene(), 3, 1);
    context.advance("arches, " + relaxation);
  }
  context.verdict(Basis::theory, "stack.overhang",
                  "bricks stand at 0.999 of the largest overhang and fall at 1.001",
                  "1 if any does not (" + overhangs.owner() + ")", overhangs.value(), 0);
  context.verdict(Basis::theory, "stack.arch", "arches fall at 0.99 of the limit thickness and stand at 1.01",
                  "1 if any does not (" + arches.owner() + ")", arches.value(), 0);
  table.close();
}

}  // namespace pbdcheck
