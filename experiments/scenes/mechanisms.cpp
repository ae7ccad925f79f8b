#include "scenes/mechanisms.h"

#include <cmath>
#include <numbers>

namespace pbdcheck {

using namespace pbd;

namespace {

constexpr double g = 9.81;
const Vec3 out_of_plane = Vec3::UnitZ();

int add_ground(Scene& scene) {
  return add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
}

Vec3 in_plane(double x, double y) {
  return {x, y, 0};
}

Eigen::Quaterniond turned(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, out_of_plane));
}

/// Hinges about z at places of the world, all one PointJoint and one AxisJoint.
class Hinges {
 public:
  explicit Hinges(const Scene& scene) : scene_(scene) {}

  void add(int a, int b, const Vec3& place) {
    points_.body.push_back({a, b});
    points_.point.push_back({own(a, place), own(b, place)});
    points_.compliance.push_back(0);
    axes_.body.push_back({a, b});
    axes_.axis.push_back({own_direction(a), own_direction(b)});
    axes_.compliance.push_back(0);
  }

  void put(Scene& scene) {
    scene.effects.emplace_back(points_);
    scene.effects.emplace_back(axes_);
  }

  Vec3 own(int body, const Vec3& place) const {
    const auto b = static_cast<std::size_t>(body);
    return scene_.initial.orientation[b].conjugate() * (place - scene_.initial.x.col(scene_.bodies[b].node));
  }

 private:
  Vec3 own_direction(int body) const {
    return scene_.initial.orientation[static_cast<std::size_t>(body)].conjugate() * out_of_plane;
  }

  const Scene& scene_;
  PointJoint points_;
  AxisJoint axes_;
};

/// A uniform rod of 1 kg from `from` to `to` in the plane z = 0, as thick as a tenth of its length about its
/// axis (a planar motion does not ask).
int add_rod(Scene& scene, const Vec3& from, const Vec3& to, double mass, const Vec3& velocity, double rate) {
  const Vec3 along = to - from;
  const double across = mass * along.squaredNorm() / 12;
  return add_body(scene, (from + to) / 2, mass, Vec3(across / 10, across, across),
                  turned(std::atan2(along.y(), along.x())), velocity, rate * out_of_plane);
}

}  // namespace

Scene free_body(const Vec3& inertia, const Vec3& spin, bool implicit) {
  Scene scene;
  add_body(scene, Vec3::Zero(), 1, inertia, Eigen::Quaterniond::Identity(), Vec3::Zero(), spin);
  scene.effects.emplace_back(Gyroscopic{implicit});
  return scene;
}

Scene heavy_top(double tilt, double spin, double precession, double compliance) {
  constexpr double mass = 1, length = 0.1, across = 0.0125 - mass * length * length, along = 0.005;
  Scene scene;
  const int ground = add_ground(scene);
  const Eigen::Quaterniond orientation(Eigen::AngleAxisd(tilt, Vec3::UnitX()));
  const Vec3 centre = orientation * Vec3(0, 0, length);
  const Vec3 w = orientation.conjugate() * Vec3(0, 0, precession);  // and what turns about the axis besides
  const Vec3 own(w.x(), w.y(), spin);
  const int top = add_body(scene, centre, mass, Vec3(across, across, along), orientation,
                           (orientation * own).cross(centre), own);
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Gyroscopic{});
  scene.effects.emplace_back(
      PointJoint{{{ground, top}}, {{Vec3::Zero(), Vec3(0, 0, -length)}}, {compliance}});
  return scene;
}

Scene point_pendulum() {
  Scene scene;
  const int ground = add_ground(scene);
  const int bob = add_body(scene, Vec3(-1, 0, 0), 1, Vec3::Constant(0.1));
  scene.effects.emplace_back(Gravity{Vec3(0, -g, 0)});
  scene.effects.emplace_back(BodyDistance{{{ground, bob}}, {{Vec3::Zero(), Vec3::Zero()}}, {1}, {0}});
  return scene;
}

Scene four_bars(int loops, int extra) {
  Scene scene;
  const int ground = add_ground(scene);
  std::vector<int> legs, couplers;
  for (int i = 0; i <= loops; ++i)
    legs.push_back(add_rod(scene, in_plane(i, 0), in_plane(i, 1), 1, Vec3(0.5, 0, 0), -1));
  for (int i = 0; i < loops; ++i)
    couplers.push_back(add_rod(scene, in_plane(i, 1), in_plane(i + 1, 1), 1, Vec3(1, 0, 0), 0));
  scene.effects.emplace_back(Gravity{Vec3(0, -g, 0)});
  scene.effects.emplace_back(Gyroscopic{});
  Hinges hinges(scene);
  for (int i = 0; i <= loops; ++i) hinges.add(ground, legs[static_cast<std::size_t>(i)], in_plane(i, 0));
  for (int i = 0; i < loops; ++i) {
    const auto k = static_cast<std::size_t>(i);
    hinges.add(legs[k], couplers[k], in_plane(i, 1));
    hinges.add(couplers[k], legs[k + 1], in_plane(i + 1, 1));
  }
  for (int i = 0; i < extra; ++i) {
    const auto k = static_cast<std::size_t>(i % loops);
    const int layer = 1 + i / loops;
    hinges.add(legs[k], couplers[k], in_plane(static_cast<double>(k), 1) + 0.1 * layer * out_of_plane);
  }
  hinges.put(scene);
  return scene;
}

Scene andrews_squeezer() {
  // Names and numbers of the source: angles at the start, points, lengths (m), masses (kg), moments (kg m^2).
  constexpr double beta = -0.0617138900142764, theta = 0, gamma = 0.455279819163070, phi = 0.222668390165886,
                   delta = 0.487364979543843, omega = -0.222668390165886, epsilon = 1.23054744454982;
  constexpr double xa = -0.06934, ya = -0.00227, xb = -0.03635, yb = 0.03273, xc = 0.014, yc = 0.072;
  constexpr double d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421, rr = 0.007, ra = 0.00092, sa = 0.01874,
                   sb = 0.01043, sc = 0.018, sd = 0.02, ta = 0.02308, tb = 0.00916, u = 0.04, ua = 0.01228,
                   ub = 0.00449, zf = 0.02, zt = 0.04, fa = 0.01421;
  constexpr double spring = 4530, rest_length = 0.07785, torque = 0.033;
  const auto c = [](double angle) { return std::cos(angle); };
  const auto s = [](double angle) { return std::sin(angle); };

  Scene scene;
  const int ground = add_ground(scene);
  const auto body = [&](double x, double y, double angle, double mass, double inertia) {
    return add_body(scene, in_plane(x, y), mass, Vec3::Constant(inertia), turned(angle));
  };
  const int k1 = body(ra * c(beta), ra * s(beta), beta, 0.04325, 2.194e-6);
  const int k2 = body(rr * c(beta) - da * c(beta + theta), rr * s(beta) - da * s(beta + theta), beta + theta,
                      0.00365, 4.410e-7);
  const int k3 =
      body(xb + sa * s(gamma) + sb * c(gamma), yb - sa * c(gamma) + sb * s(gamma), gamma, 0.02373, 5.255e-6);
  const int k4 = body(xa + zt * c(delta) + (e - ea) * s(phi + delta),
                      ya + zt * s(delta) - (e - ea) * c(phi + delta), phi + delta, 0.00706, 5.667e-7);
  const int k5 =
      body(xa + ta * c(delta) - tb * s(delta), ya + ta * s(delta) + tb * c(delta), delta, 0.0705, 1.169e-5);
  const int k6 =
      body(xa + u * s(epsilon) + (zf - fa) * c(omega + epsilon),
           ya - u * c(epsilon) + (zf - fa) * s(omega + epsilon), omega + epsilon, 0.00706, 5.667e-7);
  const int k7 = body(xa + ua * s(epsilon) - ub * c(epsilon), ya - ua * c(epsilon) - ub * s(epsilon), epsilon,
                      0.05498, 1.912e-5);

  const Vec3 crank = in_plane(rr * c(beta), rr * s(beta));
  const Vec3 middle = crank - d * in_plane(c(beta + theta), s(beta + theta));
  const Vec3 a = in_plane(xa, ya), b = in_plane(xb, yb);
  scene.effects.emplace_back(Gyroscopic{});
  Hinges hinges(scene);
  hinges.add(ground, k1, Vec3::Zero());
  hinges.add(k1, k2, crank);
  hinges.add(k2, k3, middle);
  hinges.add(k2, k4, middle);
  hinges.add(k2, k6, middle);
  hinges.add(ground, k3, b);
  hinges.add(k4, k5, a + zt * in_plane(c(delta), s(delta)));
  hinges.add(k6, k7, a + u * in_plane(s(epsilon), -c(epsilon)));
  hinges.add(ground, k5, a);
  hinges.add(ground, k7, a);
  const Vec3 end = b + in_plane(sc * s(gamma) + sd * c(gamma), -sc * c(gamma) + sd * s(gamma));
  const BodyDistance pull{.body = {{ground, k3}},
                          .point = {{in_plane(xc, yc), hinges.own(k3, end)}},
                          .rest_length = {rest_length},
                          .compliance = {1 / spring}};
  hinges.put(scene);
  scene.effects.emplace_back(pull);
  scene.effects.emplace_back(ExternalTorque{{k1}, {torque * out_of_plane}});
  return scene;
}

Scene slider_crank(double rate) {
  constexpr double crank = 0.2, rod = 0.5;
  Scene scene;
  const int ground = add_ground(scene);
  const int first = add_rod(scene, Vec3::Zero(), in_plane(crank, 0), 1, in_plane(0, rate * crank / 2), rate);
  const double turn = -rate * crank / rod;  // of the rod, whose far end moves along x alone
  const int second =
      add_rod(scene, in_plane(crank, 0), in_plane(crank + rod, 0), 1, in_plane(0, rate * crank / 2), turn);
  const int slider = add_body(scene, in_plane(crank + rod, 0), 1, Vec3::Constant(0.01));
  scene.effects.emplace_back(Gyroscopic{});
  Hinges hinges(scene);
  hinges.add(ground, first, Vec3::Zero());
  hinges.add(first, second, in_plane(crank, 0));
  hinges.add(second, slider, in_plane(crank + rod, 0));
  hinges.put(scene);
  scene.effects.emplace_back(
      LineJoint{{{ground, slider}}, {{Vec3::Zero(), Vec3::Zero()}}, {Vec3::UnitX()}, {0}});
  scene.effects.emplace_back(RotationJoint{{{ground, slider}}, {Eigen::Quaterniond::Identity()}, {0}});
  scene.effects.emplace_back(
      AngleJoint{{{ground, first}}, {out_of_plane}, {{Vec3::UnitX(), Vec3::UnitX()}}, {0}, {rate}, {0}});
  return scene;
}

Scene rod_chain(int count, double ratio) {
  const double length = 1.0 / count;
  Scene scene;
  add_ground(scene);
  PointJoint joints;
  for (int i = 0; i < count; ++i) {
    const int rod = add_rod(scene, in_plane(i * length, 0), in_plane((i + 1) * length, 0),
                            (i + 1 < count ? 1.0 : ratio) / count, Vec3::Zero(), 0);
    joints.body.push_back({rod - 1, rod});
    joints.point.push_back({i == 0 ? Vec3(Vec3::Zero()) : in_plane(length / 2, 0), in_plane(-length / 2, 0)});
    joints.compliance.push_back(0);
  }
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Gyroscopic{});
  scene.effects.emplace_back(std::move(joints));
  return scene;
}

}  // namespace pbdcheck
