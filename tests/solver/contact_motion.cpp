// That a step which says ok leaves no shapes in each other, by the distance of all features from all others
// where it ends.
#include <catch2/catch.hpp>
#include <numbers>

#include "body_scenes.h"
#include "collision/bounds.h"
#include "collision/generate.h"
#include "contact_shapes.h"
#include "scene.h"
#include "step/step.h"

using namespace pbd;
using namespace pbd::test;

namespace {

/// The shape; of a cylinder a prism about it.
Convex about(const Shape& shape, const Frame& at) {
  const auto* cylinder = std::get_if<Cylinder>(&shape);
  if (cylinder == nullptr) return convex(shape, at);
  constexpr int sides = 16;
  const double radius = cylinder->radius / std::cos(std::numbers::pi / sides);
  TriangleMesh prism;
  prism.x.resize(3, 2 * sides);
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    for (const int end : {0, 1})
      prism.x.col(2 * k + end) << radius * std::cos(angle), radius * std::sin(angle),
          (end - 0.5) * cylinder->length;
    const int a = 2 * k, b = 2 * ((k + 1) % sides);
    prism.triangles.push_back({a, b, b + 1});
    prism.triangles.push_back({a, b + 1, a + 1});
    if (k > 1) prism.triangles.push_back({1, a - 1, a + 1});
    if (k > 1) prism.triangles.push_back({0, a, a - 2});
  }
  return convex(ClosedMesh(prism), at);
}

/// No more than the distance of the shapes; exact but for cylinders.
double apart(const Shape& a, const Frame& at_a, const Shape& b, const Frame& at_b) {
  if (std::holds_alternative<HalfSpace>(b)) return apart_along(a, at_a, b, at_b, at_b.rotation.col(2));
  return signed_distance(about(a, at_a), about(b, at_b));
}

/// The largest distance along a direction that a search finds from these directions: no more than the
/// distance of the shapes either, and close to it.
double apart_by_search(const Shape& a, const Frame& at_a, const Shape& b, const Frame& at_b,
                       std::vector<Vec3> directions, Random& random) {
  directions.emplace_back((at_a.origin - at_b.origin).normalized());
  double best = -infinity;
  for (Vec3 along : directions) {
    double here = apart_along(a, at_a, b, at_b, along);
    for (double step = 0.3; step > 1e-9; step *= 0.98) {
      const Vec3 next = (along + step * random.vector()).normalized();
      const double there = apart_along(a, at_a, b, at_b, next);
      if (there > here) along = next, here = there;
    }
    best = std::max(best, here);
  }
  return best;
}

/// Directions to search from; any is a good one for a distance that is no more than the true one.
std::vector<Vec3> normals_of_contacts(const Shape& a, const Frame& at_a, const Shape& b, const Frame& at_b) {
  CollisionScratch scratch;
  std::vector<ContactPoint> found;
  generate(a, at_a, b, at_b, Reach{0.1}, scratch, found);
  std::vector<Vec3> normals;
  for (const ContactPoint& point : found)
    normals.push_back(point.swapped ? Vec3(-touching(point, at_b, at_a).normal)
                                    : touching(point, at_a, at_b).normal);
  return normals;
}

struct Pair {
  Shape a, b;
  Frame at_a, at_b;

  /// So far apart (m) along `from`, as near as the search comes to it.
  bool bring_together(const Vec3& from, double gap, Random& random) {
    double away = 3;
    const auto go = [&](int count, auto&& found) {
      for (int k = 0; k < count; ++k) {
        at_a.origin = at_b.place(away * from);
        away -= found() - gap;
      }
      return found() / gap;
    };
    double start = go(40, [&] { return apart(a, at_a, b, at_b); });
    if (gap < 0) start = go(10, [&] { return distance(random); });  // about cylinders is more than they are
    return start > 0 && start < 10;
  }

  /// No more than the distance of the shapes, m; a search where they overlap and it is not exact.
  double distance(Random& random) const {
    const auto is_cylinder = [](const Shape& shape) { return std::holds_alternative<Cylinder>(shape); };
    const double least = apart(a, at_a, b, at_b);
    if (least >= 0 || std::holds_alternative<HalfSpace>(b) || !(is_cylinder(a) || is_cylinder(b)))
      return least;
    const std::vector<Vec3> normals = normals_of_contacts(a, at_a, b, at_b);
    return std::max(least, apart_by_search(a, at_a, b, at_b, normals, random));
  }
};

/// The share of its energy that a step without restitution gains, over what it may. Along straight gaps
/// impulses take energy. Where a gap bends by the radius R, a body that goes M in h leaves at M^2/(2 R h),
/// pushed by at most 2 m M/h: a gain of 2 M/R of its energy m (M/h)^2/2 at most. 0 where M is not small.
double gained(const Scene& scene, const State& end, double h, double round) {
  const double before = kinetic_energy(scene, scene.initial), after = kinetic_energy(scene, end);
  constexpr double gyration = 0.4;  // m, no radius of gyration here is larger
  double moved = 0;
  for (const State* state : {&scene.initial, &end})
    for (Eigen::Index b = 0; b < state->v.cols(); ++b)
      moved = std::max(moved, h * (state->v.col(b).norm() + gyration * state->spin.col(b).norm()));
  constexpr double small = 0.2;
  if (moved > small * round) return 0;
  return (after - before) / after / (2 * moved / round);
}

struct Outcome {
  int moved = 0, began_inside = 0, missed_steps = 0, diverged = 0, deep = 0;
  double deepest = 0;   // of the radius of what is round
  double invented = 0;  // energy, over what the curvature of gaps lets a step gain

  /// Pairs that go up to `travel` (m) and turn up to `turn` (rad) in a step, a millimetre apart as it begins
  /// or, every third, in each other; not meshes, whose depth is not told.
  void run(const std::string& kind, const std::string& other, double travel, double turn, int count,
           Random& random) {
    constexpr double h = 0.01;
    const bool told = kind != "mesh" && other != "mesh";
    for (int k = 0; k < count; ++k) {
      Pair pair{random_shape(kind, random), random_shape(other, random), {}, {}};
      pair.at_b.rotation = random.rotation();
      const Eigen::AngleAxisd tilt(random.uniform(0, turn), random.vector().normalized());
      pair.at_a.rotation = k % 2 == 0 ? random.rotation()
                                      : Eigen::Matrix3d(pair.at_b.rotation * random.quarter_turns() * tilt);
      Vec3 from = random.vector().normalized();
      if (other == "half space") from = Vec3::UnitZ();
      if (!pair.bring_together(from, told && k % 3 == 0 ? -1e-4 : 1e-3, random)) continue;
      const double before = pair.distance(random);
      began_inside += before < 0;
      const auto spin = [&] { return Vec3(random.uniform(0, turn) / h * random.vector().normalized()); };
      const Vec3 velocity =
          random.uniform(0, travel) / h * (random.vector() - pair.at_b.rotation * from).normalized();
      Scene scene;
      add_body(scene, pair.at_a.origin, 1, Vec3(0.1, 0.12, 0.15), Eigen::Quaterniond(pair.at_a.rotation),
               velocity, spin());
      add_body(scene, pair.at_b.origin, 2, Vec3(0.2, 0.25, 0.3), Eigen::Quaterniond(pair.at_b.rotation),
               Vec3::Zero(), spin());
      Contact contact;
      contact.collider = {{pair.a, 0}, {pair.b, 1}};
      contact.law = {ContactLaw{random.uniform(0, 0.6)}};
      scene.effects = {Gyroscopic{}, contact};
      Method method;
      method.relaxation = "direct";
      method.max_outer = 500;
      Workspace workspace(scene, method);
      State state = scene.initial;
      ++moved;
      if (const Report report = step(workspace, h, state); report.status != Status::ok) {
        ++missed_steps;
        diverged += report.status == Status::diverged;
        continue;
      }
      const auto frame = [&](int body) {
        return Frame{state.x.col(body), state.orientation[static_cast<std::size_t>(body)].toRotationMatrix()};
      };
      const double round = std::min(round_radius(pair.a), round_radius(pair.b));
      invented = larger(invented, gained(scene, state, h, round));
      pair.at_a = frame(0);
      pair.at_b = frame(1);
      const double depth = -pair.distance(random) / round;
      deepest = larger(deepest, depth);
      // As effects/contact_search.h states, and the step's tolerance.
      const double allowed = std::max(1e-6, -before / round) + 1e-6;
      if (!(depth <= allowed)) ++deep;
    }
  }
};

void check_pairs(const std::string& kind, const std::string& other, int count) {
  Random random(5);
  Outcome outcome;
  outcome.run(kind, other, 0.02, 0.02, count / 2, random);
  outcome.run(kind, other, 0.1, 0.05, count / 2, random);
  outcome.run(kind, other, 0.3, 0.3, count / 2, random);
  INFO(kind << " " << other << ": " << outcome.moved << " steps, " << outcome.began_inside
            << " of what began in each other, not ok " << outcome.missed_steps << ", deep " << outcome.deep
            << ", deepest " << outcome.deepest << " of the radius");
  CHECK(outcome.deep == 0);
  CHECK(outcome.diverged == 0);
  CHECK(outcome.invented <= 1);
  CHECK(outcome.moved - outcome.missed_steps > count);  // else little has been seen
  if (kind != "mesh" && other != "mesh") CHECK(outcome.began_inside > count / 4);
}

void check_all_pairs(int count) {
  const auto kind = GENERATE(as<std::string>(), "sphere", "capsule", "box", "hull", "cylinder", "mesh");
  const auto other =
      GENERATE(as<std::string>(), "sphere", "capsule", "box", "hull", "cylinder", "mesh", "half space");
  if (other == "half space" || kind <= other)
    check_pairs(kind, other, count);  // else seen in the other order
}

}  // namespace

TEST_CASE("steps that are ok leave no pair of shapes in each other, up to 0.3 m and 0.3 rad a step") {
  check_all_pairs(20);
}

TEST_CASE("many steps of capsules and closed meshes on cylinders leave none in each other") {
  check_pairs("capsule", "cylinder", 200);
  check_pairs("cylinder", "mesh", 300);
}

TEST_CASE("ten thousand steps of each pair of kinds", "[.full]") {
  check_all_pairs(10000);
}
