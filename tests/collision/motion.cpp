#include <catch2/catch.hpp>

#include "contact_shapes.h"

using namespace pbd;
using namespace pbd::test;

namespace {

Frame moved(const Frame& at, const Vec3& velocity, const Vec3& spin, double time) {
  const double angle = spin.norm() * time;
  return {at.origin + time * velocity,
          Eigen::AngleAxisd(angle, spin.normalized()).toRotationMatrix() * at.rotation};
}

Vec3 velocity_at(const Frame& at, const Vec3& velocity, const Vec3& spin, const Vec3& point) {
  return velocity + spin.cross(point - at.origin);
}

/// Checks the rate of the gap as both move somehow.
void check_rate(const ContactPoint& contact, const Frame& a, const Frame& b, Random& random) {
  constexpr double h = 1e-6;
  const Vec3 v_a = random.vector(), w_a = random.vector(), v_b = random.vector(), w_b = random.vector();
  const Touching t = touching(contact, a, b);
  const double after = touching(contact, moved(a, v_a, w_a, h), moved(b, v_b, w_b, h)).gap;
  const double before = touching(contact, moved(a, v_a, w_a, -h), moved(b, v_b, w_b, -h)).gap;
  const double rate = t.normal.dot(velocity_at(a, v_a, w_a, t.point_a) - velocity_at(b, v_b, w_b, t.point_b));
  CHECK((after - before) / (2 * h) == Approx(rate).margin(1e-6));
  CHECK(t.normal.norm() == Approx(1).epsilon(1e-14));
  CHECK(t.normal.dot(t.point_a - t.point_b) == Approx(t.gap).margin(1e-12));
}

}  // namespace

TEST_CASE("a gap changes by n . (v_a - v_b) at the touching points") {
  using Kind = ContactPoint::Kind;
  const auto kind = GENERATE(Kind::face, Kind::point, Kind::line, Kind::edges);
  const bool rim = GENERATE(false, true);
  if (rim && kind != Kind::face) return;
  Random random(17);
  for (int number = 0; number < 1000; ++number) {
    ContactPoint contact;
    contact.kind = kind;
    contact.point_a = random.vector();
    contact.point_b = random.vector();
    contact.direction_a = random.vector().normalized();
    contact.direction_b = random.vector().normalized();
    contact.radius_a = random.uniform(0, 0.5);
    contact.radius_b = random.uniform(0, 0.5);
    contact.rim_a = rim ? random.uniform(0.1, 0.5) : 0;
    contact.side = number % 2 == 0 ? 1 : -1;
    const Frame a{3 * random.vector(), random.rotation()}, b{3 * random.vector(), random.rotation()};
    const Touching t = touching(contact, a, b);
    // Where lines are nearly parallel, or a disc nearly flat, the gap's curvature is large.
    const Vec3 e_b = b.rotation * contact.direction_b;
    if ((kind == Kind::edges || rim) && (a.rotation * contact.direction_a).cross(e_b).norm() < 0.3) continue;
    if (t.gap + contact.radius_a + contact.radius_b < 0.3 && kind != Kind::face && kind != Kind::edges)
      continue;
    check_rate(contact, a, b, random);
  }
}

TEST_CASE("so does that of a cylinder's rim beside points, edges and rims") {
  const auto other = GENERATE(as<std::string>(), "sphere", "capsule", "box", "hull", "cylinder", "mesh");
  Random random(23);
  int rims = 0;
  for (int number = 0; number < 3000; ++number) {
    const Shape a = random_shape("cylinder", random), b = random_shape(other, random);
    const Frame at_a{2 * random.vector(), random.rotation()},
        at_b{at_a.place(random.uniform(0.5, 2) * random.vector().normalized()), random.rotation()};
    for (const ContactPoint& contact : contacts(a, at_a, b, at_b, 0.3)) {
      const bool beside =
          contact.kind == ContactPoint::Kind::rim || contact.kind == ContactPoint::Kind::point;
      const Frame &carrier = contact.swapped ? at_b : at_a, &across = contact.swapped ? at_a : at_b;
      if (!beside || !(touching(contact, carrier, across).gap > 0.01)) continue;
      ++rims;
      check_rate(contact, carrier, across, random);
    }
  }
  CHECK(rims > 200);
}

// A capsule along the tangent of a rim, between its cap and its side: as it turns about their normal, the
// tangents' product passes through zero and turns round.
TEST_CASE("a rim's gap goes on where a line turns through its tangent") {
  constexpr double radius = 0.15, gap = 5e-3;
  const Shape coin = Cylinder{0.2, 0.2}, capsule = Capsule{radius, 0.3};
  const Vec3 outward = Vec3(1, 0, 1).normalized(), on_rim(0.2, 0, 0.1);
  const bool first = GENERATE(true, false);
  const auto turned = [&](double angle) {
    const Eigen::Matrix3d along_y = Eigen::AngleAxisd(std::acos(0.0), Vec3::UnitX()).toRotationMatrix();
    return Frame{on_rim + (radius + gap) * outward, Eigen::AngleAxisd(angle, outward) * along_y};
  };
  constexpr double most = 0.03;  // rad
  const auto found = first ? contacts(coin, {}, capsule, turned(-most), 0.02)
                           : contacts(capsule, turned(-most), coin, {}, 0.02);
  int rims = 0;
  for (const ContactPoint& contact : found) {
    if (contact.kind != ContactPoint::Kind::rim) continue;
    ++rims;
    for (int k = -30; k <= 30; ++k) {
      const Frame at = turned(most * k / 30);
      const Touching t = first ? touch(contact, {}, at) : touch(contact, at, {});
      CHECK(t.gap == Approx(gap).epsilon(1e-9));
      CHECK(std::abs(t.normal.dot(outward)) == Approx(1).epsilon(1e-6));
    }
  }
  CHECK(rims == 1);
}
