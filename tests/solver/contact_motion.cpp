// That a step which says ok leaves no shapes in each other, by the distance of all features from all others
// where it ends.
#include <catch2/catch.hpp>
#include <numbers>

#include "collision/bounds.h"
#include "contact_shapes.h"
#include "scene.h"
#include "step/step.h"

using namespace pbd;
using namespace pbd::test;

namespace {

enum class Prism { inside, outside };

/// The shape; of a cylinder a prism inside or outside it.
Convex held(const Shape& shape, const Frame& at, Prism of) {
  const auto* cylinder = std::get_if<Cylinder>(&shape);
  if (cylinder == nullptr) return convex(shape, at);
  constexpr int sides = 16;
  const double grown = of == Prism::outside ? 1 / std::cos(std::numbers::pi / sides) : 1;
  TriangleMesh prism;
  prism.x.resize(3, 2 * sides);
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    for (const int end : {0, 1})
      prism.x.col(2 * k + end) << grown * cylinder->radius * std::cos(angle),
          grown * cylinder->radius * std::sin(angle), (end - 0.5) * cylinder->length;
    const int a = 2 * k, b = 2 * ((k + 1) % sides);
    prism.triangles.push_back({a, b, b + 1});
    prism.triangles.push_back({a, b + 1, a + 1});
    if (k > 1) prism.triangles.push_back({1, a - 1, a + 1});
    if (k > 1) prism.triangles.push_back({0, a, a - 2});
  }
  return convex(ClosedMesh(prism), at);
}

/// Signed distance, of a cylinder that of its prism.
double apart(const Shape& a, const Frame& at_a, const Shape& b, const Frame& at_b, Prism of) {
  if (std::holds_alternative<HalfSpace>(b)) return apart_along(a, at_a, b, at_b, at_b.rotation.col(2));
  return signed_distance(held(a, at_a, of), held(b, at_b, of));
}

struct Pair {
  Shape a, b;
  Frame at_a, at_b;

  /// A millimetre apart along `from`, as near as the search comes to it.
  bool bring_together(const Vec3& from) {
    constexpr double gap = 1e-3;
    double away = 3;
    for (int k = 0; k < 40; ++k) {
      at_a.origin = at_b.place(away * from);
      away -= apart(a, at_a, b, at_b, Prism::outside) - gap;
    }
    const double start = apart(a, at_a, b, at_b, Prism::outside);
    return start > 0 && start < 10 * gap;
  }
};

struct Outcome {
  int moved = 0, missed_steps = 0, deep = 0;
  double deepest = 0;  // of the radius of what is round

  /// Pairs that go up to `travel` (m) and turn up to `turn` (rad) in a step, from nearly touching.
  void run(const std::string& kind, const std::string& other, double travel, double turn, int count,
           Random& random) {
    constexpr double h = 0.01;
    for (int k = 0; k < count; ++k) {
      Pair pair{random_shape(kind, random), random_shape(other, random), {}, {}};
      pair.at_b.rotation = random.rotation();
      const Eigen::AngleAxisd tilt(random.uniform(0, turn), random.vector().normalized());
      pair.at_a.rotation = k % 2 == 0 ? random.rotation()
                                      : Eigen::Matrix3d(pair.at_b.rotation * random.quarter_turns() * tilt);
      Vec3 from = random.vector().normalized();
      if (other == "half space") from = Vec3::UnitZ();
      if (!pair.bring_together(from)) continue;
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
      Workspace workspace(scene, method);
      State state = scene.initial;
      ++moved;
      if (step(workspace, h, state).status != Status::ok) {
        ++missed_steps;
        continue;
      }
      const auto frame = [&](int body) {
        return Frame{state.x.col(body), state.orientation[static_cast<std::size_t>(body)].toRotationMatrix()};
      };
      const double round = std::min(round_radius(pair.a), round_radius(pair.b));
      const double depth = -apart(pair.a, frame(0), pair.b, frame(1), Prism::inside) / round;
      deepest = larger(deepest, depth);
      // What effects/contact_search.h states, and the step's tolerance.
      if (!(depth <= 1e-4 + 1e-6)) ++deep;
    }
  }
};

void check_pairs(int count) {
  const auto kind = GENERATE(as<std::string>(), "sphere", "capsule", "box", "hull", "cylinder", "mesh");
  const auto other =
      GENERATE(as<std::string>(), "sphere", "capsule", "box", "hull", "cylinder", "mesh", "half space");
  if (other != "half space" && kind > other) return;  // seen in the other order
  Random random(5);
  Outcome outcome;
  outcome.run(kind, other, 0.1, 0.05, count / 2, random);
  outcome.run(kind, other, 0.3, 0.3, count / 2, random);
  INFO(kind << " " << other << ": " << outcome.moved << " steps, not ok " << outcome.missed_steps << ", deep "
            << outcome.deep << ", deepest " << outcome.deepest << " of the radius");
  CHECK(outcome.deep == 0);
  CHECK(outcome.moved - outcome.missed_steps > 3 * count / 4);
}

}  // namespace

TEST_CASE("steps that are ok leave no pair in each other, however it moved") {
  check_pairs(40);
}

TEST_CASE("ten thousand steps of each pair of kinds", "[.full]") {
  check_pairs(10000);
}
