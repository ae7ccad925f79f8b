// How high does a steadily sliding box hover by the convex law? Boxes on a plane whose tangent is the
// friction, so that nothing speeds them up or slows them, over steps halved again and again.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "linear/linear_names.h"
#include "scenes/contacts.h"
#include "studies/contact/contact_answers.h"
#include "studies/experiments.h"

namespace pbdcheck {
using namespace pbd;

void convex_gap(Context& context) {
  constexpr double angle = 0.4, speed = 1, duration = 1;
  const auto relaxations = general_solver_names();
  const double friction = std::tan(angle);
  const Vec3 normal(std::sin(angle), 0, std::cos(angle));
  std::vector<double> steps;
  for (int k = 0; k < (context.full() ? 7 : 4); ++k) steps.push_back(1.0 / 60 / (1 << k));
  context.begin(std::ssize(relaxations));
  Table table = context.table("gaps", {"relaxation", "friction", "step_s", "speed_m_per_s", "gap_m",
                                       "expected_m", "error", "sweeps", "missed_steps", "status", "reason"});
  Worst hover, closed;
  for (const auto relaxation : relaxations) {
    for (const auto law : friction_names)
      for (const double h : steps) {
        Worst largest;  // m, where the box slides without hovering
        const Scene scene = sliding_box(angle, friction, speed);
        const auto gap_of = [&](const State& now) { return normal.dot(now.x.col(1)) - 0.05; };
        const auto count = std::lround(duration / h);
        const ContactRun run = simulate_contacts(
            scene, contact_method(relaxation, law), h, count,
            [&](const State& now, const Workspace&) { largest.add(std::abs(gap_of(now))); });
        const bool convex = law == "cone", usable = run.status != Status::diverged;
        const double v = run.end.v.col(1).norm(), expected = convex ? h * friction * v : 0;
        const double gap = !usable ? std::nan("") : convex ? gap_of(run.end) : largest.value();
        const double error = convex ? std::abs(gap / expected - 1) : gap;
        table.row({std::string(relaxation), std::string(law), h, v, gap, expected, error, run.sweeps,
                   std::int64_t{run.steps - run.steps_ok}, status_cell(run.status), run.reason});
        (convex ? hover : closed).add(error, relaxation);
      }
    context.advance(relaxation);
  }
  // Velocities of 1 m/s are solved to 1e-12, and the gap is h mu times one; a hundredfold for what rounds.
  context.verdict(Basis::theory, "convex_gap.cone", "by the convex law a box hovers at h mu v",
                  "largest relative error (" + hover.owner() + ")", hover.value(), 1e-10);
  context.verdict(Basis::theory, "convex_gap.others", "by the other laws it does not",
                  "largest gap, m (" + closed.owner() + ")", closed.value(), 1e-10);
  table.close();
}

}  // namespace pbdcheck
