// Momentum of free bodies. Internal forces keep the linear one, whatever is left unsolved. The angular one is
// kept by forces along J at x where x is that of the force: with the sum of x_i cross f_i(x) = 0, a step
// changes L by
//   symplectic_euler, midpoint   0
//   implicit_euler               h sum m v' x v
//   newmark                      h^2 sum m ((v_a - alpha v) x q_a - alpha v_a x q'), v_a = (1-alpha) v +
//   alpha v',
//                                q_a likewise; alpha = 1/2: L + h^2/4 sum m v x q is kept
//   bdf2                         4 G = sum m (x x v + (2x - x_l-1) x (2v - v_l-1)) by - sum m d2x x d2v, d2
//   the second
//                                differences (the identity of G-stability, dahlquist1978stability)
// where v', q' are those of the step's end.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "assembly.h"
#include "harness/integrator_rules.h"
#include "harness/measure.h"
#include "linear/linear_names.h"
#include "studies/time/energy.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr int steps = 1000;
constexpr double h = 0.01;

Vec3 cross_sum(const Scene& scene, const Points& a, const Points& b) {
  Vec3 sum = Vec3::Zero();
  for (int node = 0; node < scene.nodes(); ++node)
    sum += scene.mass[static_cast<std::size_t>(node)] * Vec3(a.col(node)).cross(Vec3(b.col(node)));
  return sum;
}

using Change = std::function<Vec3(const State& before, const State& after)>;  // of the angular momentum

Change newmark_change(const Scene& scene, double alpha) {
  return
      [&scene, alpha, model = reference::make_model(scene)](const State& before, const State& after) -> Vec3 {
        const auto acceleration = [&](const Points& x) -> Points {
          const reference::Vector force = -reference::energy_gradient(model, x);
          return reference::scatter(model, Points::Zero(3, scene.nodes()), force.cwiseQuotient(model.mass));
        };
        const Points q = acceleration(before.x), q_end = acceleration(after.x);
        const Points v_a = (1 - alpha) * before.v + alpha * after.v, q_a = (1 - alpha) * q + alpha * q_end;
        return h * h * (cross_sum(scene, v_a - alpha * before.v, q_a) - alpha * cross_sum(scene, v_a, q_end));
      };
}

Change euler_change(const Scene& scene) {
  return [&scene](const State& before, const State& after) -> Vec3 {
    return h * cross_sum(scene, after.v, before.v);
  };
}

/// The first steps are implicit Euler's (solver/step/integrators.h).
Change bdf2_change(const Scene& scene, bool hard) {
  return [&scene, starts = hard ? 3 : 1, first = euler_change(scene), last = State{}, g = Vec3(0, 0, 0),
          momentum = Vec3(0, 0, 0)](const State& before, const State& after) mutable -> Vec3 {
    const auto quadruple = [&](const State& old, const State& now) -> Vec3 {
      return cross_sum(scene, now.x, now.v) + cross_sum(scene, 2 * now.x - old.x, 2 * now.v - old.v);
    };
    const Vec3 previous = momentum;
    if (starts > 0) {
      --starts;
      momentum = cross_sum(scene, before.x, before.v) + first(before, after);
      g = quadruple(before, after);
      last = before;
      return momentum - cross_sum(scene, before.x, before.v);
    }
    g -= cross_sum(scene, after.x - 2 * before.x + last.x, after.v - 2 * before.v + last.v);
    momentum =
        (g + 2 * (cross_sum(scene, after.x, before.v) + cross_sum(scene, before.x, after.v)) - previous) / 5;
    last = before;
    return momentum - previous;
  };
}

/// What a solved step does, empty where no expression is stated.
Change angular_change(const Scene& scene, bool hard, const Method& method) {
  const auto& name = method.integrator;
  if (name == "symplectic_euler" || name == "midpoint")
    return [](const State&, const State&) -> Vec3 { return Vec3::Zero(); };
  if (name == "implicit_euler") return euler_change(scene);
  if (name == "bdf2") return bdf2_change(scene, hard);
  if (name == "newmark" && !hard) return newmark_change(scene, method.alpha);
  return {};
}

struct Body {
  std::string name;
  Scene scene;
  bool hard = false;
};

struct FreeCourse {
  const Body* body;
  Rule rule;
  bool solved;                                                 // or stopped early
  bool keeps = false;                                          // the angular momentum, by theory
  bool expressed = false;                                      // what it does to it
  double linear = 0, angular = 0, unexplained = std::nan("");  // largest, relative
  Simulation run{};
};

void follow_free(FreeCourse& course) {
  const Scene& scene = course.body->scene;
  const Vec3 linear = linear_momentum(scene, scene.initial), angular = angular_momentum(scene, scene.initial);
  double spin = 0;
  for (int node = 0; node < scene.nodes(); ++node)
    spin += scene.mass[static_cast<std::size_t>(node)] * scene.initial.v.col(node).norm() *
            scene.initial.x.col(node).norm();
  double largest = momentum_scale(scene, scene.initial);  // so far: what rounding is relative to
  const Change change =
      course.solved ? angular_change(scene, course.body->hard, course.rule.method) : Change{};
  course.expressed = static_cast<bool>(change);
  const auto& name = course.rule.method.integrator;
  course.keeps = name == "symplectic_euler" || name == "midpoint";
  Vec3 expected = angular;
  Worst linear_error, angular_error, unexplained;
  course.run =
      simulate_steps(scene, course.rule.method, h, steps, [&](const State& before, const State& after) {
        const Vec3 now = angular_momentum(scene, after);
        largest = std::max(largest, momentum_scale(scene, after));
        linear_error.add((linear_momentum(scene, after) - linear).norm() / largest);
        angular_error.add((now - angular).norm() / spin);
        if (change) {
          expected += change(before, after);
          unexplained.add((now - expected).norm() / spin);
        }
        return "";
      });
  course.linear = linear_error.value();
  course.angular = angular_error.value();
  course.unexplained = unexplained.value();
}

std::vector<FreeCourse> make_courses(const std::vector<Body>& bodies) {
  std::vector<FreeCourse> all;
  for (const Body& body : bodies)
    for (Rule rule : integrator_rules({0.5, 0.55})) {
      if (body.hard && rule.marginal) continue;  // blows up
      rule.method.tolerance = 1e-13;
      all.push_back({&body, rule, true});
      rule.method.tolerance = 1e-12;
      rule.method.outer = "plain";
      rule.method.max_outer = 1;
      rule.method.max_sweeps = 3;
      for (const auto name : general_solver_names()) {
        rule.method.relaxation = name;
        all.push_back({&body, rule, false});
      }
    }
  return all;
}

void write_course(Table& table, const FreeCourse& course) {
  std::vector<Cell> row{course.body->name};
  for (auto& cell : method_cells(course.rule)) row.push_back(std::move(cell));
  row.insert(row.end(), {std::int64_t{course.rule.method.max_outer}, h, std::int64_t{course.run.steps},
                         std::int64_t{course.run.steps_ok}, course.linear, course.angular, course.unexplained,
                         status_cell(course.run.status), course.run.reason});
  table.row(row);
}

}  // namespace

void energy_momentum(Context& context) {
  const std::vector<Body> bodies{{"links", free_links(1e-2)},
                                 {"hard links", free_links(0), true},
                                 {"net", free_net()},
                                 {"solid", free_beam(2, 1e5)}};
  auto courses = make_courses(bodies);
  context.parallel(std::ssize(courses),
                   [&](std::int64_t index) { follow_free(courses[static_cast<std::size_t>(index)]); });
  Table table = context.table(
      "momentum", {"scene", "integrator", "alpha", "outer", "relaxation", "max_outer", "step_s", "steps",
                   "steps_ok", "linear_error", "angular_error", "angular_unexplained", "status", "reason"});
  Worst linear, kept, explained;
  for (const FreeCourse& course : courses) {
    write_course(table, course);
    linear.add(course.linear);
    if (!course.solved) continue;
    const bool ok = course.run.status == Status::ok;
    if (course.keeps) kept.add(ok ? course.angular : std::nan(""));
    if (course.expressed) explained.add(ok ? course.unexplained : std::nan(""));
  }
  table.close();
  context.verdict(Basis::theory, "energy.linear_momentum",
                  "linear momentum of free bodies is kept over 1000 steps by every integrator and "
                  "relaxation, solved or not",
                  "largest change over the largest sum of m |v|", linear.value(), 1e-12);
  context.verdict(Basis::theory, "energy.angular_momentum",
                  "midpoint and symplectic Euler keep the angular momentum over 1000 solved steps",
                  "largest change, relative", kept.value(), 1e-10);
  context.verdict(Basis::theory, "energy.angular_momentum.loss",
                  "implicit Euler, newmark and bdf2 change the angular momentum by the derived amounts over "
                  "1000 solved steps",
                  "largest difference, relative", explained.value(), 1e-10);
  context.advance("momentum");
}

}  // namespace pbdcheck
