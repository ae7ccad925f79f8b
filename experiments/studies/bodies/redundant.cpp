// Does a mechanism move as before when joints hold what others hold already? A chain of two four-bars with
// none to three redundant hinges more: its motion, and what the joints of one place carry together.
#include <algorithm>
#include <cmath>

#include "harness/measure.h"
#include "scenes/mechanisms.h"
#include "step/step.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr int loops = 2;
constexpr std::size_t points = 2;  // the PointJoint's place among the effects

struct RedundantRun {
  std::vector<Points> x;
  std::vector<Vec3> net;  // N s in the plane, of each place and step: what leg and coupler exchange
  double split = 0;       // largest difference of two impulses of one place, of their sum
  std::int64_t sweeps = 0, row_updates = 0;
  int missed = 0, steps = 0;
  Status status = Status::ok;
  std::string reason;

  bool solved(int all) const { return steps == all && missed == 0; }
};

RedundantRun run(int extra, const Method& method, double h, int steps) {
  const Scene scene = four_bars(loops, extra);
  const auto& joints = std::get<PointJoint>(scene.effects[points]);
  RedundantRun found;
  Workspace workspace(scene, method);
  State state = scene.initial;
  while (found.steps < steps) {
    const Report report = step(workspace, h, state);
    found.sweeps += report.sweeps;
    found.row_updates += report.row_updates;
    found.missed += report.status != Status::ok;
    if (report.status > found.status) found.status = report.status, found.reason = report.reason;
    if (report.status == Status::diverged) break;
    ++found.steps;
    found.x.push_back(state.x);
    const auto impulses = workspace.impulses(points);
    const auto in_plane = [&](std::size_t joint) {
      return Vec3(impulses[3 * joint], impulses[3 * joint + 1], 0);
    };
    for (std::size_t i = 0; i < joints.body.size(); ++i) {
      const bool again = std::find(joints.body.begin(), joints.body.begin() + static_cast<std::ptrdiff_t>(i),
                                   joints.body[i]) != joints.body.begin() + static_cast<std::ptrdiff_t>(i);
      if (again) continue;
      Vec3 sum = Vec3::Zero();
      double apart = 0;
      for (std::size_t j = i; j < joints.body.size(); ++j) {
        if (joints.body[j] != joints.body[i]) continue;
        sum += in_plane(j);
        for (std::size_t k = i; k < j; ++k)
          if (joints.body[k] == joints.body[i]) apart = std::max(apart, (in_plane(j) - in_plane(k)).norm());
      }
      found.net.push_back(sum);
      if (apart > 0) found.split = std::max(found.split, apart / sum.norm());
    }
  }
  return found;
}

}  // namespace

void redundant(Context& context) {
  const int steps = context.full() ? 1000 : 50;
  const double h = 0.004;
  const std::vector<std::string> relaxations{"direct", "conjugate_gradients", "nesterov_jacobi",
                                             "gauss_seidel"};
  context.begin(std::ssize(relaxations));
  Table table = context.table(
      "motion", {"relaxation", "redundant_joints", "step_s", "position_difference_m", "net_force_difference",
                 "split", "sweeps", "row_updates", "missed_steps", "status", "reason"});
  Worst motion, force;
  for (const auto& relaxation : relaxations) {
    Method method;
    method.relaxation = relaxation;
    method.tolerance = 1e-12;
    method.max_sweeps = 500;
    const RedundantRun plain = run(0, method, h, steps);
    double size = 0;
    for (const Vec3& net : plain.net) size = std::max(size, net.norm());
    for (int extra = 0; extra <= 3; ++extra) {
      const RedundantRun other = extra == 0 ? plain : run(extra, method, h, steps);
      Worst moved, pushed;
      for (std::size_t k = 0; k < std::min(plain.x.size(), other.x.size()); ++k)
        moved.add((plain.x[k] - other.x[k]).cwiseAbs().maxCoeff());
      for (std::size_t k = 0; k < std::min(plain.net.size(), other.net.size()); ++k)
        pushed.add((plain.net[k] - other.net[k]).norm() / size);
      table.row({relaxation, std::int64_t{extra}, h, moved.value(), pushed.value(), other.split, other.sweeps,
                 other.row_updates, std::int64_t{other.missed},
                 std::string(status_names[static_cast<std::size_t>(other.status)]), other.reason});
      if (extra == 0) continue;
      const bool solved = plain.solved(steps) && other.solved(steps);
      motion.add(solved ? moved.value() : std::nan(""));
      force.add(solved ? pushed.value() : std::nan(""));
    }
    context.advance(relaxation);
  }
  table.close();
  context.verdict(Basis::theory, "redundant.motion", "redundant joints change no motion",
                  "largest difference, m", motion.value(), 1e-9);
  context.verdict(Basis::theory, "redundant.force", "redundant joints change no net force",
                  "largest difference over the largest force", force.value(), 1e-9);
}

}  // namespace pbdcheck
