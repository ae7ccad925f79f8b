// Forces of faces that lie on each other act at the corners of where they overlap: corners of either face,
// and where their sides cross, as they are where the step ends.
#include "body_scenes.h"
#include "contact_runs.h"
#include "contact_shapes.h"
#include "judged_contact.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double landing_step = 0.02, on_it = 1e-9;  // s; m
const Vec3 plate(0.4, 0.3, 0.05), block(0.3, 0.3, 0.3);

/// How many faces of a box a point in its frame lies on.
int faces_at(const Vec3& point, const Vec3& size) {
  return static_cast<int>(((point.cwiseAbs() - size / 2).array().abs() <= on_it).count());
}

Vec3 in_frame_of(const State& state, Eigen::Index body, const Vec3& point) {
  return state.orientation[static_cast<std::size_t>(body)].conjugate() * (point - state.x.col(body));
}

/// Lands on the block a little askew, sliding and turning, as a frame there: its lowest point is next to it.
struct Landing {
  Eigen::Quaterniond turned;
  Vec3 beside, velocity, spin;

  Landing(Random& random, std::array<double, 2> yaws, std::array<double, 2> tilts, double turns,
          double falls) {
    const double yaw = random.uniform(yaws[0], yaws[1]), tilt = random.uniform(tilts[0], tilts[1]);
    const Vec3 axis(std::cos(7 * yaw), std::sin(7 * yaw), 0);
    turned = Eigen::AngleAxisd(tilt, axis) * Eigen::AngleAxisd(yaw, Vec3::UnitZ());
    beside = Vec3(random.uniform(0.05, 0.15), random.uniform(-0.1, 0.1), 0);
    velocity = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), -falls);
    spin = Vec3(0, 0, random.uniform(-turns, turns));
  }

  /// Askew by up to 0.3 rad.
  explicit Landing(Random& random) : Landing(random, {0.25, 1.3}, {0.015, 0.3}, 4, 4) {}
};

/// That edges are at least as far from parallel as those that the solver lets cross.
bool askew(const Vec3& along) {
  constexpr double parallel = 0.1;
  return std::min(std::abs(along.x()), std::abs(along.y())) >= parallel;
}

/// Height of the lowest corner over the middle, m.
double lowest_of_plate(const Eigen::Quaterniond& turned) {
  return (turned.toRotationMatrix() * box_surface(plate).x).row(2).minCoeff();
}

struct Seen {
  int crossings = 0, missed = 0;
};

/// Two steps of a plate above the block, or on it.
void check_plate(const Landing& landing, double above, Seen& seen) {
  Scene scene;
  const int held = add_world(scene);
  Vec3 inertia = plate.squaredNorm() * Vec3::Ones() - plate.cwiseAbs2();
  inertia /= 12;
  const int body =
      add_body(scene, landing.beside, 1, inertia, landing.turned, landing.velocity, landing.spin);
  scene.initial.x(2, body) = block.z() / 2 - lowest_of_plate(landing.turned) + above;
  Contact contact;
  contact.collider = {{Box{block}, held}, {Box{plate}, body}};
  contact.law = {ContactLaw{0.3}};
  scene.effects = {Gravity{}, Gyroscopic{}, contact};
  Workspace workspace(scene, contact_method("direct"));
  State state = scene.initial;
  for (int n = 0; n < 2; ++n) {
    if (step(workspace, landing_step, state).status != Status::ok) {
      ++seen.missed;
      break;
    }
    const bool crossed = askew(state.orientation[static_cast<std::size_t>(body)] * Vec3::UnitX());
    for (const ContactForce& each : workspace.contacts()) {
      if (!(each.force.norm() > 1e-6 * weight(scene))) continue;
      const int of_plate = faces_at(in_frame_of(state, body, each.point), plate),
                of_block = faces_at(in_frame_of(state, held, each.point), block);
      INFO("step " << n << ", on faces of the plate " << of_plate << ", of the block " << of_block);
      CHECK(of_plate >= 1);
      CHECK(of_block >= 1);
      if (crossed) CHECK(of_plate + of_block >= 4);
      seen.crossings += of_plate == 2 && of_block == 2;
    }
  }
}

}  // namespace

TEST_CASE("a plate that comes to lie on a block is held at corners of where they overlap as the step ends") {
  Random random(3);
  Seen seen;
  for (int k = 0; k < 60; ++k) {
    INFO("landing " << k);
    check_plate(Landing(random), 1e-4, seen);
  }
  CHECK(seen.crossings > 60);  // else little has been seen
  CHECK(seen.missed <= 2);     // of 120
}

TEST_CASE(
    "a plate that turns on a block, its edges nearly along the block's, is held at corners of the overlap") {
  Random random(5);
  Seen seen;
  for (int k = 0; k < 100; ++k) {
    INFO("plate " << k);
    check_plate(Landing(random, {0.01, 0.09}, {0, 0}, 12, 0), 0, seen);
  }
  CHECK(seen.crossings > 60);
  CHECK(seen.missed <= 20);  // of 200
}

TEST_CASE("a triangle that comes to lie on a block that turns is held at corners of where they overlap") {
  Random random(4);
  int crossings = 0, missed = 0;
  for (int k = 0; k < 60; ++k) {
    Scene scene;
    const Landing landing(random);
    const int held = add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity),
                              Eigen::Quaterniond::Identity(), Vec3::Zero(), landing.spin);
    constexpr double thick = 0.01;
    Contact contact;
    contact.thickness = thick;
    std::array<int, 3> node{};
    Points corner(3, 3);
    for (int i = 0; i < 3; ++i) {
      const Eigen::AngleAxisd turn(2 * std::acos(-1.0) / 3 * i, Vec3::UnitZ());
      corner.col(i) = landing.turned * (turn * Vec3(0.25, 0, 0));
    }
    const double lowest = corner.row(2).minCoeff();
    for (int i = 0; i < 3; ++i) {
      const Vec3 x =
          landing.beside + Vec3(corner.col(i)) + Vec3(0, 0, block.z() / 2 + thick / 2 - lowest + 1e-4);
      node[static_cast<std::size_t>(i)] = add_node(scene, x, 0.3, landing.velocity);
    }
    contact.triangle = {node};
    contact.collider = {{Box{block}, held}};
    contact.law = {ContactLaw{0.3}};
    scene.effects = {Gravity{}, contact};
    for (int i = 0; i < 3; ++i) {
      Distance side;
      side.node = {{node[static_cast<std::size_t>(i)], node[static_cast<std::size_t>((i + 1) % 3)]}};
      side.rest_length = {std::sqrt(3.0) * 0.25};
      side.compliance = {0};
      scene.effects.emplace_back(side);
    }
    Workspace workspace(scene, contact_method("direct"));
    State state = scene.initial;
    INFO("landing " << k);
    for (int n = 0; n < 2; ++n) {
      if (step(workspace, landing_step, state).status != Status::ok) {
        ++missed;
        break;
      }
      Eigen::Matrix3d sides;
      for (int i = 0; i < 3; ++i) sides.col(i) = state.x.col(node[static_cast<std::size_t>(i)]);
      for (const ContactForce& each : workspace.contacts()) {
        if (!(each.force.norm() > 1e-6 * weight(scene))) continue;
        const Vec3 away = (each.collider[0] == 0 ? 1 : -1) * each.normal;
        const int of_block = faces_at(in_frame_of(state, held, each.point + thick / 2 * away), block);
        int outer = 0;  // sides of the triangle that it lies on
        bool crossed = true;
        for (int i = 0; i < 3; ++i) {
          const Vec3 from = sides.col(i), along = (sides.col((i + 1) % 3) - from).normalized();
          if (!((each.point - from).cross(along).norm() <= on_it)) continue;
          ++outer;
          crossed = crossed && askew(state.orientation[0].conjugate() * along);
        }
        INFO("step " << n << ", on sides of the triangle " << outer << ", on faces of the block "
                     << of_block);
        CHECK(of_block >= 1);
        if (crossed) CHECK(outer + of_block >= 3);
        crossings += outer == 1 && of_block == 2;
      }
    }
  }
  CHECK(crossings > 60);  // else little has been seen
  CHECK(missed <= 2);     // of 120
}

TEST_CASE("damped plates that begin deep in a block, and overhang it, end their step where the judge's do") {
  Random random(6);
  int compared = 0;
  for (int k = 0; k < 40; ++k) {
    const Landing landing(random, {0.12, 1.3}, {0, 0.3}, 8, 1);
    pbdcheck::BodyScene build({.friction = 0, .compliance = 1e-6, .damping = 0.01});
    build.fixed(Box{block}, {});
    const Vec3 place = landing.beside + Vec3(0, 0, block.z() / 2 - 5e-3 - lowest_of_plate(landing.turned));
    build.box(plate, 1,
              {.position = place,
               .orientation = landing.turned,
               .velocity = landing.velocity,
               .spin = landing.spin});
    const Scene scene = build.finish();
    Workspace workspace(scene, contact_method("direct"));
    State state = scene.initial;
    INFO("plate " << k);
    if (step(workspace, judged_step_s, state).status != Status::ok) continue;
    const auto end = reference::contact_newton(scene, scene.initial, judged_step_s, Friction::coulomb,
                                               reference::cone_interior_point, {});
    if (end.outcome != reference::Outcome::ok) continue;
    ++compared;
    CHECK((state.v.col(1) - end.v.col(1)).norm() <= 1e-7);
  }
  CHECK(compared > 30);  // of 40: else little has been seen
}
