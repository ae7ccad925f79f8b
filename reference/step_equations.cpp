#include "step_equations.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dense.h"
#include "step_rows.h"

namespace pbd::reference {
namespace {

/// What bounds and the law let a force miss: the square of what is open of c + A gamma = 0, J.
double squared_miss(const Vector& missed, const RowMatrix& n, double gamma,
                    const std::array<double, 2>& bounds) {
  if (missed.size() > 1) return missed.dot(solve(Eigen::MatrixXd(n), Vector(missed)));
  const double asked = -missed(0) / n(0, 0);  // not added to gamma, beside which it may be lost
  const double change = std::clamp(asked, bounds[0] - gamma, bounds[1] - gamma);
  return std::isnan(asked) || std::isnan(gamma) ? std::nan("") : change * change * n(0, 0);
}

bool is_singular(const RowMatrix& n) {
  constexpr double definite = 1e-12;
  if (n.size() == 1) return !(n(0, 0) > 0);
  const SymmetricEigen eigen = symmetric_eigen(n);
  return !(eigen.values(0) > definite * eigen.values(n.rows() - 1));
}

}  // namespace

RowMatrix metric_of(const RigidModel& model, const Block& block, double h) {
  RowMatrix n = block.compliance;
  each_moving(model, block, [&](int unknown, int offset) {
    const auto columns = block.jacobian.middleCols<3>(offset);
    const Vec3 weight = h * h * model.inertia.segment<3>(unknown).cwiseInverse();
    n += RowMatrix(columns * weight.asDiagonal() * columns.transpose());
  });
  return n;
}

void check_motion(const StepClaim& claim, Moved what, Findings& findings) {
  const Scene& scene = claim.scene;
  double held = 0, moved = 0, turned = 0, size = 0, speed = 0, spin = 0;
  bool any = what == Moved::all;
  for (int i = 0; i < scene.nodes(); ++i) {
    const auto node = static_cast<Eigen::Index>(i);
    const bool fixed = std::isinf(scene.mass[static_cast<std::size_t>(i)]);
    if (!fixed && what == Moved::fixed) continue;
    any = true;
    const Vec3 from = claim.start.x.col(node), to = claim.end.x.col(node), v = claim.end.v.col(node);
    if (fixed) held = larger(held, (v - claim.start.v.col(node)).norm());
    moved = larger(moved, (to - from - claim.h * v).norm());
    size = larger(size, from.cwiseAbs().maxCoeff() + to.cwiseAbs().maxCoeff());
    speed = larger(speed, v.cwiseAbs().maxCoeff());
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const auto body = static_cast<Eigen::Index>(b);
    const bool fixed = !scene.bodies[b].inertia.allFinite();
    if (!fixed && what == Moved::fixed) continue;
    any = true;
    const Vec3 w = claim.end.spin.col(body);
    if (fixed) held = larger(held, (w - claim.start.spin.col(body)).norm());
    const auto expected = turned_by(claim.start.orientation[b], claim.h * w);
    turned = larger(turned, 2 * (expected.conjugate() * claim.end.orientation[b]).vec().norm());
    spin = larger(spin, w.cwiseAbs().maxCoeff());
  }
  if (!any) return;
  findings.require("motion", "velocities of what is fixed, m/s or rad/s", held, 0);
  findings.require("motion", "positions, m", moved, step_rounding * (size + claim.h * speed));
  findings.require("motion", "orientations, rad", turned, step_rounding * (1 + claim.h * spin));
}

/// Of the values of an angle that goes on, which are 2 pi apart, the nearest to the one where the step
/// begins.
double unwrapped(double value, double begun) {
  constexpr double period = 2 * std::numbers::pi;
  return value + period * std::round((begun - value) / period);
}

bool at_jump(const StepModel& model, const Block& block, double value, double size) {
  return model.angle[static_cast<std::size_t>(block.row)] &&
         !(std::numbers::pi - std::abs(value) > step_rounding * (1 + size * block.jacobian.norm()));
}

void check_constraints(const StepClaim& claim, const StepModel& model, double level, Findings& findings) {
  Vector gamma;
  if (!gather_forces(claim, model.rigid, gamma)) gamma.setConstant(model.rigid.rows(), std::nan(""));
  Vector value = values_at(model.rigid, placement_of(claim.end));
  const Vector begun = values_at(model.rigid, placement_of(claim.start));
  Vector may_jump = value;
  for (Eigen::Index row = 0; row < value.size(); ++row)
    if (model.goes_on[static_cast<std::size_t>(row)]) {
      value[row] = unwrapped(value[row], begun[row]);
      may_jump[row] = begun[row];
    }
  const bool hard_alone = !is_euler_step(claim) || explicit_forces(claim);
  const double size = claim.end.x.cwiseAbs().maxCoeff();
  double squared = 0, most = -1;
  std::size_t worst = 0;
  const auto add = [&](const Block& block) {
    const auto row = static_cast<std::size_t>(block.row);
    const auto& bounds = model.bounds[row];
    const bool bounded = bounds != std::array<double, 2>{-infinity, infinity};
    if (model.damped[row]) return findings.leave_out("constraints: damped ones");
    if (!block.hard && hard_alone) return findings.leave_out("constraints: compliant ones");
    if (bounded && !is_euler_step(claim)) return findings.leave_out("constraints: bounded forces");
    const RowMatrix n = metric_of(model.rigid, block, claim.h);
    if (block.hard && is_singular(n))
      return findings.leave_out("constraints: those whose rows depend on each other");
    if (at_jump(model, block, may_jump[block.row], size))
      return findings.leave_out("constraints: angles at their jump");
    const RowVector own = gamma.segment(block.row, block.rows());
    RowVector missed = value.segment(block.row, block.rows());
    if (!block.hard) missed += block.compliance * own;
    const double miss = squared_miss(missed, n, bounded ? own(0) : 0, bounds);
    squared += miss;
    if (miss <= most) return;
    most = miss;
    worst = row;
  };
  each_block(model.rigid, placement_of(explicit_forces(claim) ? claim.start : claim.end), add);
  if (most >= 0 || std::isnan(most) || std::isnan(squared))
    findings.require("constraints", "most of it of " + model.name[worst], std::sqrt(squared), level);
}

}  // namespace pbd::reference
