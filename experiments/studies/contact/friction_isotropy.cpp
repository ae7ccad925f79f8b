// Is friction the same in every direction? Boxes that slide on a floor at 36 headings: what slows them, and
// whether they keep their heading.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "rows/laws.h"
#include "scenes/contacts.h"
#include "studies/contact/contact_answers.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double friction = 0.3, speed = 2;
constexpr int isotropy_steps = 5;

/// By the box law each axis is slowed on its own until it stops.
Eigen::Vector2d expected_velocity(std::string_view law, const Eigen::Vector2d& start) {
  const double lost = isotropy_steps * contact_h * friction * gravity;
  if (law != "box") return (1 - lost / start.norm()) * start;
  return start.unaryExpr([&](double v) { return std::copysign(std::max(0.0, std::abs(v) - lost), v); });
}

}  // namespace

void friction_isotropy(Context& context) {
  const std::vector<std::string> relaxations{"conjugate_gradients", "direct"};
  context.begin(std::ssize(relaxations) * std::ssize(friction_names));
  Table table = context.table(
      "headings", {"relaxation", "friction", "step_s", "heading_deg", "deceleration_share", "expected_share",
                   "share_error", "heading_change_rad", "heading_error_rad", "status", "reason"});
  Worst round, straight, square, diagonal;
  for (const auto& relaxation : relaxations) {
    for (const auto law : friction_names) {
      for (int k = 0; k < 36; ++k) {
        const double heading = k * std::numbers::pi / 18 + (law == "box" ? std::numbers::pi / 36 : 0);
        const Eigen::Vector2d along(std::cos(heading), std::sin(heading));
        Scene scene = sliding_box(0, friction, speed, heading);
        if (law == "cone") {  // it hovers at h mu v already
          scene.initial.x(2, 1) += contact_h * friction * speed;
          scene.initial.v(2, 1) = -contact_h * friction * friction * gravity;
        }
        const ContactRun run =
            simulate_contacts(scene, contact_method(relaxation, law), contact_h, isotropy_steps);
        const bool usable = run.status != Status::diverged;
        const Eigen::Vector2d end = run.end.v.col(1).head<2>(), exact = expected_velocity(law, speed * along);
        const auto turned = [&](const Eigen::Vector2d& v) {
          return std::atan2(along.x() * v.y() - along.y() * v.x(), along.dot(v));
        };
        const auto slowed = [&](const Eigen::Vector2d& v) {
          return (speed - along.dot(v)) / (isotropy_steps * contact_h * friction * gravity);
        };
        const double share_error = usable ? std::abs(slowed(end) - slowed(exact)) : std::nan("");
        const double heading_error = usable ? std::abs(turned(end) - turned(exact)) : std::nan("");
        table.row({relaxation, std::string(law), contact_h, heading * 180 / std::numbers::pi, slowed(end),
                   slowed(exact), share_error, turned(end), heading_error, status_cell(run.status),
                   run.reason});
        (law == "box" ? square : round).add(share_error, relaxation);
        (law == "box" ? square : straight).add(heading_error, relaxation);
        if (law == "box" && k % 9 == 4)
          diagonal.add(usable ? std::abs(slowed(end) - std::numbers::sqrt2) : std::nan(""), relaxation);
      }
      context.advance(relaxation + " " + std::string(law));
    }
  }
  const auto verdict = [&](const char* id, const char* statement, const std::string& quantity,
                           const Worst& worst) {
    context.verdict(Basis::theory, std::string("friction_isotropy.") + id, statement,
                    quantity + " (" + worst.owner() + ")", worst.value(), 1e-6);
  };
  const std::string share = "largest error as part of mu g";
  verdict("deceleration", "coulomb, disc and cone slow a box by mu g at every heading", share, round);
  verdict("heading", "coulomb, disc and cone keep every heading", "largest change, rad", straight);
  verdict("box", "box slows each axis by mu g, along the heading by |cos| + |sin|", share + ", or rad",
          square);
  verdict("diagonal", "box slows by sqrt(2) mu g at 45 degrees", share, diagonal);
  table.close();
}

}  // namespace pbdcheck
