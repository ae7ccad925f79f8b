// How near bodies may come to a limit by ways that are known by their lengths alone.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "effects/angle_joint.h"
#include "effects/body_distance.h"
#include "effects/slide_joint.h"
#include "rows/effect_constraint.h"

using namespace pbd;

namespace {

const std::vector<std::array<int, 2>> approaching{{0, 1}};
const std::vector<ForceBounds> open_above_0{{0, infinity}};

/// Two bodies at places of their own.
struct PlacedPair {
  Points x;
  std::vector<Pose> pose;
  double time = 0;

  Configuration at() const { return {x, pose, time}; }
};

template <class E>
double value_at(const E& effect, const PlacedPair& placed) {
  typename Constraint<E>::Value value;
  typename Constraint<E>::Jacobian unused;
  Constraint<E>::evaluate(effect, 0, local_at(effect, 0, {0, 2, 1, 3}, placed.at()), value, unused);
  return value[0];
}

/// The part of the gap that is told for the way between two places, and the part that closes.
template <class E>
std::array<double, 2> parts_closed(const E& effect, const PlacedPair& from, const PlacedPair& to) {
  const double gap = value_at(effect, from);
  SeenBodies seen({0, 1});
  seen.see(from.at());
  const auto own = local_at(effect, 0, {0, 2, 1, 3}, from.at());
  return {Constraint<E>::approach(effect, 0, own, gap).part(seen.wandered(to.at())),
          (gap - value_at(effect, to)) / gap};
}

class RandomPlaces {
 public:
  PlacedPair any() {
    PlacedPair placed{Points::Zero(3, 4), {}};
    for (int b = 0; b < 2; ++b) placed.pose.push_back({direction(), turned(direction()), {}});
    return placed;
  }

  PlacedPair near(const PlacedPair& from, double way, double turn) {
    PlacedPair placed = from;
    for (Pose& pose : placed.pose) {
      pose.x += way * direction();
      pose.rotation = turned(turn * direction()) * pose.rotation;
    }
    placed.time += way;
    return placed;
  }

  Vec3 direction() {
    Vec3 found;
    for (double& each : found) each = normal_(random_);
    return found.normalized();
  }

 private:
  static Eigen::Matrix3d turned(const Vec3& by) { return rotation_by(by).toRotationMatrix(); }

  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

/// No way closes more than is told, of ways that are told not to come to a stop; how many those are.
template <class E, class Make>
int most_told(Make&& make) {
  RandomPlaces places;
  int told = 0;
  for (int k = 0; k < 20000; ++k) {
    const E effect = make(places);
    const PlacedPair from = places.any();
    const double size = std::pow(10.0, -3 * (k % 100) / 100.0);
    if (!(value_at(effect, from) > 0)) continue;
    const PlacedPair to = places.near(from, k % 3 == 0 ? 0 : size, k % 3 == 1 ? 0 : size);
    const auto [part, closed] = parts_closed(effect, from, to);
    if (!(part < 1)) continue;
    ++told;
    CHECK(closed < 1);
    CHECK(value_at(effect, to) > 0);
  }
  return told;
}

}  // namespace

TEST_CASE("a limit is not reached by ways that are told to come a part of the way to it") {
  const auto distance = [](RandomPlaces& places) {
    return BodyDistance{approaching, {{places.direction(), places.direction()}}, {0.3}, {0}, {},
                        open_above_0};
  };
  CHECK(most_told<BodyDistance>(distance) > 5000);
  const auto slide = [](RandomPlaces& places) {
    return SlideJoint{
        approaching, {{places.direction(), places.direction()}}, {places.direction()}, {0.1}, {0.5}, {0}, {},
        open_above_0};
  };
  CHECK(most_told<SlideJoint>(slide) > 2000);
  const auto angle = [](RandomPlaces& places) {
    const Vec3 axis = places.direction();
    return AngleJoint{approaching, {axis},      {{axis.unitOrthogonal(), places.direction()}},
                      {0.4},       {0.5},       {0},
                      {},          open_above_0};
  };
  CHECK(most_told<AngleJoint>(angle) > 2000);
}

TEST_CASE("the part of the way to a limit that is told is sharp for the ways that close it most") {
  PlacedPair from{Points::Zero(3, 4), {2, {Vec3(0, 0, 0), Eigen::Matrix3d::Identity(), {}}}};
  from.pose[1].x.x() = 2;
  PlacedPair to = from;
  SECTION("centres that go towards each other") {
    const BodyDistance links{approaching, {{Vec3(0, 0, 0), Vec3(0, 0, 0)}}, {1}, {0}, {}, open_above_0};
    to.pose[0].x.x() += 0.2;
    to.pose[1].x.x() -= 0.2;
    const auto [part, closed] = parts_closed(links, from, to);
    CHECK(closed == Approx(part).epsilon(1e-12));
    const SlideJoint slide{approaching, {{Vec3(0, 0, 0), Vec3(0, 0, 0)}}, {Vec3::UnitX()}, {1}, {0}, {0}, {},
                           open_above_0};
    const auto [told, slid] = parts_closed(slide, from, to);
    CHECK(slid == Approx(told).epsilon(1e-12));
  }
  SECTION("bodies that turn against each other") {
    // asin(p) is taken for pi/3 p.
    const Vec3 z = Vec3::UnitZ(), x = Vec3::UnitX();
    const AngleJoint stop{approaching, {z}, {{x, x}}, {-0.5}, {0}, {0}, {}, open_above_0};
    to.pose[0].rotation = rotation_by(Vec3(0, 0, 1e-4)).toRotationMatrix();
    to.pose[1].rotation = rotation_by(Vec3(0, 0, -1e-4)).toRotationMatrix();
    const auto [part, closed] = parts_closed(stop, from, to);
    CHECK(part / closed == Approx(std::numbers::pi / 3).epsilon(1e-6));
  }
}
