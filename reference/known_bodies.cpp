#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cmath>

#include "closed_form_bodies.h"
#include "known_answers_rows.h"
#include "numerics.h"

namespace pbd::reference::known {
namespace {

/// Euler's equations of a torque-free body, from `spin`.
Vec3 spin_by_ode(const Vec3& inertia, const Vec3& spin, double time) {
  const auto slope = [&](double, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
    const Vec3 w = y, momentum = inertia.cwiseProduct(w);
    out = momentum.cross(w).cwiseQuotient(inertia);
  };
  return solve_ode(slope, spin, {time}).states.back();
}

/// Rate at which the third axis of that body circles the angular momentum, by its orientation: half a turn is
/// over where the axis crosses the plane of the momentum and its first direction again, near `time`.
double axis_rate_by_ode(const Vec3& inertia, const Vec3& spin, double time) {
  const auto slope = [&](double, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
    const Vec3 w = y.head<3>(), momentum = inertia.cwiseProduct(w);
    const Eigen::Quaterniond q(y(3), y(4), y(5), y(6)), rate = q * Eigen::Quaterniond(0, w(0), w(1), w(2));
    out << momentum.cross(w).cwiseQuotient(inertia), rate.w() / 2, rate.vec() / 2;
  };
  Eigen::VectorXd start(7);
  start << spin, 1, 0, 0, 0;
  const Vec3 normal = inertia.cwiseProduct(spin).cross(Vec3::UnitZ());
  const auto beside = [&](double t) {
    const Eigen::VectorXd y = solve_ode(slope, start, {t}).states.back();
    return normal.dot(Eigen::Quaterniond(y(3), y(4), y(5), y(6)) * Vec3::UnitZ());
  };
  return pi / find_root(beside, 0.8 * time, 1.2 * time);
}

void free_bodies(Rows& rows) {
  const Vec3 inertia(1, 2, 3), ones = Vec3::Ones();
  const std::string of = "torque-free body of moments (1, 2, 3) kg m^2";
  // w1 and w2 are as cn and sn: from the zero of one to that of the other is a quarter.
  const auto component = [&](const Vec3& start, int i) {
    return [&inertia, start, i](double t) { return spin_by_ode(inertia, start, t)[i]; };
  };
  const double first = find_root(component(ones, 0), 0.5, 1.5), zero = find_root(component(ones, 1), 2, 3);
  rows.push_back({"free_body", of + " from (1, 1, 1) rad/s: period", "s", free_body_period(inertia, ones),
                  "6.42270308", 4 * (zero - first)});
  struct At {
    double time;
    std::array<const char*, 3> stated;
  };
  for (const At& at : {At{1, {"-0.12664292", "1.40853171", "0.81976387"}},
                       At{10, {"-0.60347042", "-1.27899314", "0.88772679"}}}) {
    const Vec3 w = free_body_spin(inertia, ones, at.time), integrated = spin_by_ode(inertia, ones, at.time);
    for (int i = 0; i < 3; ++i)
      rows.push_back({"free_body",
                      of + " from (1, 1, 1) rad/s: w" + number(i + 1) + " after " + number(at.time) + " s",
                      "rad/s", w[i], at.stated[i], integrated[i]});
  }
  // From w3 = 0 to w2 = 0 is a quarter.
  for (const auto& [start, stated] : {std::pair{1e-2, "41.5092195"}, {1e-3, "57.4628489"}}) {
    const Vec3 spin(start, 1, 0);
    const double period = free_body_period(inertia, spin);
    rows.push_back(
        {"unstable_axis",
         of + " about the middle axis, off by " + (start < 5e-3 ? "1e-3" : "1e-2") + " rad/s: period", "s",
         period, stated, 4 * find_root(component(spin, 1), 0.24 * period, 0.26 * period)});
  }
  rows.push_back({"unstable_axis",
                  of + " about the middle axis, off by 1e-6 rad/s: period",
                  "s",
                  free_body_period(inertia, {1e-6, 1, 0}),
                  "105.321194",
                  {}});
  const Vec3 spin(0.5, 0, 10), symmetric(1, 1, 2);
  // w turns from its first to its second axis in a quarter.
  const double quarter = find_root([&](double t) { return spin_by_ode(symmetric, spin, t)[0]; }, 0.1, 0.2);
  rows.push_back({"symmetric_body", "body of moments (1, 1, 2) kg m^2 from (0.5, 0, 10) rad/s: its period",
                  "s", 2 * pi / body_precession(1, 2, spin), "0.628318531", 4 * quarter});
  rows.push_back({"symmetric_body", "its rate of precession in space", "rad/s", space_precession(1, 2, spin),
                  "20.0062490", axis_rate_by_ode(symmetric, spin, pi / 20)});
}

/// dL/dt - torque of a top that precesses steadily, across its axis: L in the plane of axis and vertical.
double unbalanced_torque(const HeavyTop& top, double tilt, double spin, double precession) {
  const Vec3 axis(std::sin(tilt), 0, std::cos(tilt)), vertical = Vec3::UnitZ();
  const Vec3 turning = precession * (vertical - axis.dot(vertical) * axis);
  const Vec3 momentum = top.across * turning + top.along * spin * axis;
  return (precession * vertical.cross(momentum) - top.weight_moment * axis.cross(-vertical))[1];
}

void tops(Rows& rows) {
  const HeavyTop top{0.0125, 0.005, g * 0.1};
  const std::string of = "heavy top: disc of 1 kg, radius 0.1 m, 0.1 m from its fixed point: ";
  rows.push_back(
      {"heavy_top", of + "least spin at which it sleeps", "rad/s", sleeping_spin(top), "44.2944692", {}});
  for (const auto& [spin, slow, fast] :
       {std::tuple{100.0, "2.05327801", "44.1347435"}, {200.0, "0.991645186", "91.3843979"}}) {
    const Precession found = steady_precession(top, pi / 6, spin);
    const auto unbalanced = [&top, s = spin](double w) { return unbalanced_torque(top, pi / 6, s, w); };
    const double between = std::sqrt(found.slow * found.fast);
    const std::string at = " precession at 30 deg, spin " + number(spin) + " rad/s";
    rows.push_back({"heavy_top", joined({of, "slow", at}), "rad/s", found.slow, slow,
                    find_root(unbalanced, found.slow / 2, between)});
    rows.push_back({"heavy_top", joined({of, "fast", at}), "rad/s", found.fast, fast,
                    find_root(unbalanced, between, 2 * found.fast)});
  }
}

void rods(Rows& rows) {
  const auto work = [](double angle) { return 2 * g / 2 * std::sin(angle) / (1.0 / 3); };
  rows.push_back({"falling_rod", "uniform rod of 1 m, hinged, let fall upright: rate at the horizontal",
                  "rad/s", falling_rod_rate(1, g), "5.42494240", std::sqrt(integrate(work, 0, pi / 2))});
}

/// IFToMM's multibody benchmark A02: two four-bar linkages in a row, 5 uniform rods of 1 m and 1 kg. All
/// cranks stay parallel: it moves as a pendulum of inertia I = 3/3 + 2 and weight moment (3/2 + 2) g.
void four_bars(Rows& rows) {
  const double inertia = 3, moment = 3.5, length = inertia / moment;
  const auto slope = [&](double, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
    out << y(1), -g / length * std::cos(y(0));
  };
  const std::string of = "two four-bar linkages of rods of 1 m, first joint";
  struct At {
    double time;
    const char *x, *y, *vx, *vy;
  };
  for (const At& at : {At{1, "-0.1950203019", "-0.9807992057", "-6.6766780369", "1.3275783252"},
                       At{5, "-0.8113104610", "-0.5846155453", nullptr, nullptr},
                       At{10, "0.3284581115", "0.944518538", "1.4230514702", "-0.4948688455"}}) {
    // The angle from the lowest point grows clockwise here: x = -sin, y = -cos.
    const Direction crank = circling_pendulum(length, g, 1, at.time);
    const Eigen::VectorXd y = solve_ode(slope, Eigen::Vector2d(pi / 2, -1), {at.time}).states.back();
    const std::string after = " after " + number(at.time) + " s";
    rows.push_back({"four_bar", joined({of, ": x", after}), "m", -crank.sine, at.x, std::cos(y(0))});
    rows.push_back({"four_bar", joined({of, ": y", after}), "m", -crank.cosine, at.y, std::sin(y(0))});
    if (!at.vx) continue;
    rows.push_back({"four_bar", joined({of, ": speed along x", after}), "m/s", -crank.rate * crank.cosine,
                    at.vx, -y(1) * std::sin(y(0))});
    rows.push_back({"four_bar", joined({of, ": speed along y", after}), "m/s", crank.rate * crank.sine, at.vy,
                    y(1) * std::cos(y(0))});
  }
}

}  // namespace

void bodies(Rows& rows) {
  free_bodies(rows);
  tops(rows);
  rods(rows);
  four_bars(rows);
}

}  // namespace pbd::reference::known
