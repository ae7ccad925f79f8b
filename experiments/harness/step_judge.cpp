#include "harness/step_judge.h"

#include <fmt/format.h>

#include <cmath>

#include "harness/judges.h"
#include "harness/measure.h"

namespace pbdcheck {
namespace {

/// |v - v*|_M, sqrt(J): of what moves, rotations by their principal moments.
double velocity_distance(const pbd::Scene& scene, const pbd::State& one, const pbd::State& other) {
  double squared = 0;
  for (int i = 0; i < scene.nodes(); ++i)
    if (const double mass = scene.mass[static_cast<std::size_t>(i)]; std::isfinite(mass))
      squared += mass * (one.v.col(i) - other.v.col(i)).squaredNorm();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const pbd::Vec3& inertia = scene.bodies[b].inertia;
    const auto body = static_cast<Eigen::Index>(b);
    if (inertia.allFinite())
      squared += inertia.dot((one.spin.col(body) - other.spin.col(body)).cwiseAbs2());
  }
  return std::sqrt(squared);
}

}  // namespace

StepJudge::StepJudge(const std::filesystem::path& directory, std::string reference, std::int64_t every)
    : reference_(std::move(reference)),
      every_(every),
      table_(directory / "judged.csv",
             {"step", "time_s", "step_s", "solver_status", "tolerance", "error", "error_m", "error_of_scale",
              "reference", "status", "reason", "reference_residual", "reference_iterations", "wall_s"},
             &totals_) {}

void StepJudge::add(std::int64_t step, const pbd::Scene& scene, const pbd::Method& method,
                    const pbd::State& begun, const pbd::State& ended, double h, const pbd::Report& report) {
  const Judged judged = judge_step(reference_, scene, begun, h, pbd::friction_by_name(method.friction));
  double error = std::nan(""), error_m = error, of_scale = error;
  const bool solved = judged.status == "ok";
  ++judged_;
  if (!solved) {
    ++unsolved_;
  } else {
    const pbd::Points reached = places(scene, ended.x, ended.orientation),
                      begin = places(scene, begun.x, begun.orientation);
    error = relative_error(reached, judged.x, begin);
    error_m = relative_error(reached, judged.x, judged.x);
    const double distance = velocity_distance(scene, ended, judged.end);
    of_scale = distance == 0 ? 0 : distance / report.scale;
    if (report.status == pbd::Status::ok) {
      worst_error_m_ = pbd::larger(worst_error_m_, error_m);
      if (!(of_scale <= worst_error_of_scale_)) worst_step_ = step;
      worst_error_of_scale_ = pbd::larger(worst_error_of_scale_, of_scale);
    }
  }
  table_.row({step, begun.time, h, std::string(pbd::status_names[static_cast<std::size_t>(report.status)]),
              method.tolerance, error, error_m, of_scale, reference_, judged.status, judged.reason,
              judged.residual, std::int64_t{judged.iterations}, judged.seconds});
}

std::string StepJudge::text() const {
  const std::string unsolved =
      unsolved_ > 0 ? fmt::format(", which did not solve {} of them", unsolved_) : "";
  if (judged_ == unsolved_) return fmt::format("judged: {} steps by {}{}", judged_, reference_, unsolved);
  return fmt::format("judged: {} steps by {}{}; solved ones are off by {:.3g} m and, of the scale that the "
                     "tolerance refers to, {:.3g} (step {}) at most",
                     judged_, reference_, unsolved, worst_error_m_, worst_error_of_scale_, worst_step_);
}

}  // namespace pbdcheck
