// Plane mechanisms of multibody benchmarks, in the x-y plane: gravity, if any, along -y.
#pragma once

#include <cmath>
#include <numbers>

#include "body_scenes.h"

namespace pbd::test {

/// Bodies hinged about z at points of the world.
struct PlaneMechanism {
  Scene scene;
  PointJoint points{};
  AxisJoint axes{};
  int world = -1;

  PlaneMechanism() : world(add_world(scene)) {}

  /// A body whose frame is turned by `angle` about z; moment about z.
  int body(double x, double y, double angle, double mass, double moment, const Vec3& velocity = Vec3::Zero(),
           double spin = 0) {
    return add_body(scene, Vec3(x, y, 0), mass, Vec3(moment / 2, moment, moment),
                    Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ())), velocity, Vec3(0, 0, spin));
  }
  /// A point (m) of the world in a body's frame.
  Vec3 own(int body, double x, double y) const {
    const int node = scene.bodies[static_cast<std::size_t>(body)].node;
    return scene.initial.orientation[static_cast<std::size_t>(body)].conjugate() *
           (Vec3(x, y, 0) - scene.initial.x.col(node));
  }
  void hinge(int a, int b, double x, double y) {
    join(points, a, b, own(a, x, y), own(b, x, y));
    axes.body.push_back({a, b});
    axes.axis.push_back({Vec3::UnitZ(), Vec3::UnitZ()});
    axes.compliance.push_back(0);
  }
  Scene finished() {
    scene.effects.insert(scene.effects.end(), {Gyroscopic{}, points, axes});
    return scene;
  }
};

/// IFToMM's A02: a row of four-bar linkages of uniform rods of 1 m and 1 kg, upright, the upper ends moving
/// along x at `speed` (m/s). With one degree of freedom, three rows a loop are redundant.
inline Scene four_bar_chain(int loops, double speed = 1) {
  PlaneMechanism m;
  constexpr double upright = std::numbers::pi / 2, moment = 1.0 / 12;
  int crank = -1;
  for (int i = 0; i <= loops; ++i) {
    const int next = m.body(i, 0.5, upright, 1, moment, Vec3(speed / 2, 0, 0), -speed);
    m.hinge(m.world, next, i, 0);
    if (i > 0) {
      const int bar = m.body(i - 0.5, 1, 0, 1, moment, Vec3(speed, 0, 0));
      m.hinge(crank, bar, i - 1, 1);
      m.hinge(bar, next, i, 1);
    }
    crank = next;
  }
  m.scene.effects = {Gravity{Vec3(0, -9.81, 0)}};
  return m.finished();
}

/// IFToMM's A03, Andrews' squeezer: seven bodies, a spring and a motor of constant torque, from rest. Body 1
/// is the crank, whose end F is its point (0.007 - 0.00092, 0, 0).
inline Scene andrews_squeezer() {
  constexpr double beta = -0.0617138900142764, theta = 0, gamma = 0.455279819163070, phi = 0.222668390165886,
                   delta = 0.487364979543843, omega = -0.222668390165886, epsilon = 1.23054744454982;
  constexpr double d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421, rr = 0.007, ra = 0.00092, sa = 0.01874,
                   sb = 0.01043, sc = 0.018, sd = 0.02, ta = 0.02308, tb = 0.00916, u = 0.04, ua = 0.01228,
                   ub = 0.00449, zf = 0.02, zt = 0.04, fa = 0.01421;
  constexpr double xa = -0.06934, ya = -0.00227, xb = -0.03635, yb = 0.03273, xc = 0.014, yc = 0.072;
  const auto c = [](double angle) { return std::cos(angle); };
  const auto s = [](double angle) { return std::sin(angle); };
  const double fx = rr * c(beta), fy = rr * s(beta);
  const double ex = fx - d * c(beta + theta), ey = fy - d * s(beta + theta);
  const double hx = xa + zt * c(delta), hy = ya + zt * s(delta);
  const double gx = xa + u * s(epsilon), gy = ya - u * c(epsilon);
  PlaneMechanism m;
  const int k1 = m.body(ra * c(beta), ra * s(beta), beta, 0.04325, 2.194e-6);
  const int k2 =
      m.body(fx - da * c(beta + theta), fy - da * s(beta + theta), beta + theta, 0.00365, 4.410e-7);
  const int k3 = m.body(xb + sa * s(gamma) + sb * c(gamma), yb - sa * c(gamma) + sb * s(gamma), gamma,
                        0.02373, 5.255e-6);
  const int k4 =
      m.body(hx + (e - ea) * s(phi + delta), hy - (e - ea) * c(phi + delta), phi + delta, 0.00706, 5.667e-7);
  const int k5 = m.body(xa + ta * c(delta) - tb * s(delta), ya + ta * s(delta) + tb * c(delta), delta,
                        0.07050, 1.169e-5);
  const int k6 = m.body(gx + (zf - fa) * c(omega + epsilon), gy + (zf - fa) * s(omega + epsilon),
                        omega + epsilon, 0.00706, 5.667e-7);
  const int k7 = m.body(xa + ua * s(epsilon) - ub * c(epsilon), ya - ua * c(epsilon) - ub * s(epsilon),
                        epsilon, 0.05498, 1.912e-5);
  m.hinge(m.world, k1, 0, 0);
  m.hinge(k1, k2, fx, fy);
  for (const int other : {k3, k4, k6}) m.hinge(k2, other, ex, ey);
  m.hinge(m.world, k3, xb, yb);
  m.hinge(k4, k5, hx, hy);
  m.hinge(m.world, k5, xa, ya);
  m.hinge(k6, k7, gx, gy);
  m.hinge(m.world, k7, xa, ya);
  const double dx = xb + sc * s(gamma) + sd * c(gamma), dy = yb - sc * c(gamma) + sd * s(gamma);
  m.scene.effects = {
      ExternalTorque{{k1}, {Vec3(0, 0, 0.033)}},
      BodyDistance{{{m.world, k3}}, {{Vec3(xc, yc, 0), m.own(k3, dx, dy)}}, {0.07785}, {1 / 4530.0}}};
  return m.finished();
}

}  // namespace pbd::test
