#include <cmath>

#include "closed_form_contact.h"
#include "known_answers_rows.h"
#include "numerics.h"

namespace pbd::reference::known {
namespace {

/// Compression and time of contact of 1 kg on 1000 N/m, by ODE from the touch to the lift.
Landing landing_by_ode() {
  const auto slope = [](double, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
    out << y(1), g - 1000 * y(0);
  };
  const auto at = [&](double t, int i) {
    return solve_ode(slope, Eigen::Vector2d(0, std::sqrt(2 * g * 0.1)), {t}).states.back()(i);
  };
  const double deepest = find_root([&](double t) { return at(t, 1); }, 0.03, 0.08);
  return {at(deepest, 0), find_root([&](double t) { return at(t, 0); }, 0.1, 0.13)};
}

/// Torque of a uniform pressure under a disc over mu m g r, by quadrature.
double disc_lever() {
  return integrate([](double r) { return 2 * r * r; }, 0, 1);
}

void springs(Rows& rows) {
  const Landing landing = spring_landing(1000, 1, g, 0.1), by_ode = landing_by_ode();
  const std::string of = "1 kg dropped 0.1 m on a massless spring of 1000 N/m: ";
  rows.push_back(
      {"spring_landing", of + "compression", "m", landing.compression, "0.055177787", by_ode.compression});
  rows.push_back({"spring_landing", of + "time of contact", "s", landing.time, "0.113130519", by_ode.time});
  const std::string swing = "1 kg on 100 N/m with friction 0.1, let go at 0.1 m: ";
  rows.push_back({"friction_swing", swing + "loss a half swing", "m", friction_swing_loss(100, 1, 0.1, g),
                  "0.01962", std::nullopt});
  rows.push_back({"friction_swing", swing + "place of rest", "m", friction_swing_rest(100, 1, 0.1, g, 0.1),
                  "-0.0019", 0.1 - 5 * 0.01962 - 2 * (0.1 - 5 * 0.01962)});
}

void slips(Rows& rows) {
  struct Case {
    const char* name;
    double share;
    const char *time, *way;
  };
  for (const Case& c :
       {Case{"sphere", 0.4, "0.145623999", "0.124820570"},
        Case{"cylinder", 0.5, "0.169894665", "0.141578888"}, Case{"hoop", 1, "0.254841998", "0.191131498"}}) {
    const SlipToRoll found = slip_to_roll(c.share, 1, 0.2, g);
    const std::string of = std::string(c.name) + " at 1 m/s, friction 0.2: ";
    // Where v - mu g t is the speed of the surface, mu g t/share.
    const double meets = find_root([&](double t) { return 1 - 0.2 * g * t * (1 + 1 / c.share); }, 0, 1);
    rows.push_back({"slip_to_roll", of + "time of slip", "s", found.time, c.time, meets});
    rows.push_back({"slip_to_roll", of + "way of slip", "m", found.way, c.way,
                    integrate([](double t) { return 1 - 0.2 * g * t; }, 0, meets)});
  }
  const std::string spins = " that spins at 10 rad/s, friction 0.2: time to rest";
  rows.push_back({"spin_down", "disc of 0.1 m" + spins, "s", spin_down_disc(0.5, 10, 0.1, 0.2, g),
                  "0.382262997", 0.5 * 10 * 0.1 / (disc_lever() * 0.2 * g)});
  rows.push_back({"spin_down", "ring of 0.1 m" + spins, "s", spin_down_rim(1, 10, 0.1, 0.2, g), "0.509683996",
                  std::nullopt});
}

void statics(Rows& rows) {
  for (const auto& [n, stated] : {std::pair{2, "0.75"},
                                  {3, "0.916666667"},
                                  {4, "1.04166667"},
                                  {5, "1.14166667"},
                                  {10, "1.46448413"},
                                  {20, "1.79886983"}})
    rows.push_back({"overhang", number(n) + " bricks: overhang over the length", "1", brick_overhang(n, 1),
                    stated, std::nullopt});
  for (const auto& [degrees, stated] :
       {std::pair{60.0, "0.288675135"}, {65.0, "0.233153829"}, {75.0, "0.133974596"}})
    rows.push_back({"ladder", "ladder at " + number(degrees) + " deg: least friction of the floor", "1",
                    ladder_friction(radians(degrees)), stated, std::nullopt});
  rows.push_back({"painleve", "rod at 63.4349488 deg: friction without accelerations", "1",
                  painleve_friction(std::atan(2)), "1.33333333", 4.0 / 3});
  for (const auto& [mu, turns, stated] : {std::tuple{0.1, 0.5, "1.36910777"},
                                          {0.2, 0.5, "1.87445609"},
                                          {0.2, 1.0, "3.51358562"},
                                          {0.3, 0.25, "1.60197765"},
                                          {0.3, 0.5, "2.56633240"},
                                          {0.3, 1.0, "6.58606196"},
                                          {0.5, 0.5, "4.81047738"},
                                          {0.5, 1.0, "23.1406926"}}) {
    const auto slope = [m = mu](double, const Eigen::VectorXd& y, Eigen::VectorXd& out) { out << m * y(0); };
    const double angle = 2 * pi * turns;
    rows.push_back({"capstan",
                    "rope over a drum, friction " + number(mu) + ", " + number(turns) + " turns: ratio", "1",
                    capstan_ratio(mu, angle), stated,
                    solve_ode(slope, Eigen::VectorXd::Ones(1), {angle}).states.back()(0)});
  }
  rows.push_back({"rolling_disc", "disc of 0.05 m rolling at 10 deg: rate", "rad/s",
                  rolling_disc_rate(0.05, radians(10), g), "67.2271007", std::nullopt});
}

}  // namespace

void contacts(Rows& rows) {
  springs(rows);
  slips(rows);
  statics(rows);
}

}  // namespace pbd::reference::known
