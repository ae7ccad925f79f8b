#include "studies/robustness/world_building.h"

namespace pbdcheck {

using namespace pbd;

void Building::add_joints() {
  for (int count = 1 + random_.below(2); count > 0; --count) {
    const int b = moving(), a = random_.below(b);
    const Vec3 x = random_.uniform(0, 1) < 0.5 ? Vec3(scene_.initial.x.col(b)) : random_.vector(0.5);
    add_joint({a, b}, x, random_.direction());
  }
}

/// Met as the bodies stand, at x and along u in the world.
void Building::add_joint(const std::array<int, 2>& body, const Vec3& x, const Vec3& u) {
  const std::array<Vec3, 2> point{own_point(body[0], x), own_point(body[1], x)};
  const std::array<Vec3, 2> axis{own_axis(body[0], u), own_axis(body[1], u)};
  const Vec3 across = u.unitOrthogonal();
  const double length = compliance(-8, -3), angle = compliance(-6, -1);
  const PointJoint ball{{body}, {point}, {length}, damping()};
  const AxisJoint parallel{{body}, {axis}, {angle}, damping()};
  const Eigen::Quaterniond rest = scene_.initial.orientation[static_cast<std::size_t>(body[0])].conjugate() *
                                  scene_.initial.orientation[static_cast<std::size_t>(body[1])];
  const RotationJoint turning{{body}, {rest.normalized()}, {angle}, damping()};
  switch (random_.below(6)) {
    case 0:
      return add(ball);
    case 1:
      add(ball);
      add(parallel);
      return add_drive(body, axis[0], {own_axis(body[0], across), own_axis(body[1], across)});
    case 2:
      add(turning);
      return add_slider(body, point, axis[0], length);
    case 3:
      add(ball);
      return add(PerpendicularJoint{{body}, {{axis[0], own_axis(body[1], across)}}, {angle}, damping()});
    case 4:
      add(ball);
      return add(turning);
    default: {
      const Vec3 end = x + random_.uniform(0.1, 0.5) * u;
      return add(BodyDistance{{body},
                              {{point[0], own_point(body[1], end)}},
                              {(end - x).norm()},
                              {length},
                              damping(),
                              limits(random_.decades(0, 4))});
    }
  }
}

void Building::add_drive(const std::array<int, 2>& body, const Vec3& axis,
                         const std::array<Vec3, 2>& reference) {
  if (random_.happens(0.5)) return;
  const auto bounds = limits(random_.decades(0, 3));
  const bool motor = !bounds.empty() && std::isfinite(bounds[0][1]);
  add(AngleJoint{{body},
                 {axis},
                 {reference},
                 {motor ? 0 : random_.uniform(-0.3, 0)},
                 {motor ? random_.uniform(-3, 3) : 0},
                 {bounds.empty() ? random_.decades(-3, 0) : 0},
                 damping(),
                 bounds});
}

void Building::add_slider(const std::array<int, 2>& body, const std::array<Vec3, 2>& point, const Vec3& axis,
                          double given) {
  add(LineJoint{{body}, {point}, {axis}, {given}, damping()});
  if (random_.happens(0.5)) return;
  const auto bounds = limits(random_.decades(0, 4));
  add(SlideJoint{{body},
                 {point},
                 {axis},
                 {bounds.empty() ? 0.05 : -0.05},
                 {0},
                 {bounds.empty() ? random_.decades(-6, -3) : 0},
                 damping(),
                 bounds});
}

/// None, a stop, or a motor's.
std::vector<ForceBounds> Building::limits(double force) {
  if (random_.happens(0.4)) return {};
  if (random_.happens(0.5)) return {{0, infinity}};
  return {{-force, force}};
}

}  // namespace pbdcheck
