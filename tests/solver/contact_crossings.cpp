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

  explicit Landing(Random& random) {
    const double yaw = random.uniform(0.25, 1.3), tilt = random.uniform(0.015, 0.04);
    const Vec3 axis(std::cos(7 * yaw), std::sin(7 * yaw), 0);
    turned = Eigen::AngleAxisd(tilt, axis) * Eigen::AngleAxisd(yaw, Vec3::UnitZ());
    beside = Vec3(random.uniform(0.05, 0.15), random.uniform(-0.1, 0.1), 0);
    velocity = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), -2);
    spin = Vec3(0, 0, random.uniform(-4, 4));
  }
};

}  // namespace

TEST_CASE("a plate that comes to lie on a block is held at corners of where they overlap as the step ends") {
  Random random(3);
  int crossings = 0, missed = 0;
  for (int k = 0; k < 60; ++k) {
    Scene scene;
    const int held = add_world(scene);
    const Landing landing(random);
    Vec3 inertia = plate.squaredNorm() * Vec3::Ones() - plate.cwiseAbs2();
    inertia /= 12;
    const int body =
        add_body(scene, landing.beside, 1, inertia, landing.turned, landing.velocity, landing.spin);
    const Points corners = box_surface(plate).x;
    double lowest = infinity;
    for (Eigen::Index i = 0; i < corners.cols(); ++i)
      lowest = std::min(lowest, (landing.turned * Vec3(corners.col(i))).z());
    scene.initial.x(2, body) = block.z() / 2 - lowest + 1e-4;
    Contact contact;
    contact.collider = {{Box{block}, held}, {Box{plate}, body}};
    contact.law = {ContactLaw{0.3}};
    scene.effects = {Gravity{}, Gyroscopic{}, contact};
    Workspace workspace(scene, contact_method("direct"));
    State state = scene.initial;
    INFO("landing " << k);
    for (int n = 0; n < 2; ++n) {
      if (step(workspace, landing_step, state).status != Status::ok) {
        ++missed;
        break;
      }
      for (const ContactForce& each : workspace.contacts()) {
        if (!(each.force.norm() > 1e-6 * weight(scene))) continue;
        const int of_plate = faces_at(in_frame_of(state, body, each.point), plate),
                  of_block = faces_at(in_frame_of(state, held, each.point), block);
        INFO("step " << n << ", on faces of the plate " << of_plate << ", of the block " << of_block);
        CHECK(of_plate >= 1);
        CHECK(of_block >= 1);
        CHECK(of_plate + of_block >= 4);
        crossings += of_plate == 2 && of_block == 2;
      }
    }
  }
  CHECK(crossings > 60);  // else little has been seen
  CHECK(missed <= 2);     // of 120
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
        for (int i = 0; i < 3; ++i) {
          const Vec3 from = sides.col(i), along = (sides.col((i + 1) % 3) - from).normalized();
          outer += (each.point - from).cross(along).norm() <= on_it;
        }
        INFO("step " << n << ", on sides of the triangle " << outer << ", on faces of the block "
                     << of_block);
        CHECK(of_block >= 1);
        CHECK(outer + of_block >= 3);
        crossings += outer == 1 && of_block == 2;
      }
    }
  }
  CHECK(crossings > 60);  // else little has been seen
  CHECK(missed <= 2);     // of 120
}

TEST_CASE(
    "a damped plate that begins deep in a block, and overhangs it, ends its step where the judge's does") {
  const double friction = GENERATE(0.0, 0.5);
  pbdcheck::BodyScene build({.friction = friction, .compliance = 1e-6, .damping = 0.01});
  build.fixed(Box{Vec3::Ones()}, {});
  const Eigen::Quaterniond turned =
      Eigen::AngleAxisd(0.1, Vec3::UnitZ()) * Eigen::AngleAxisd(-0.04, Vec3::UnitY());
  build.box({0.4, 0.4, 0.2}, 1,
            {.position = {0.4, 0.2, 0.601},
             .orientation = turned,
             .velocity = {0.2, -1.3, -1},
             .spin = {0, 0, 4.5}});
  const Scene scene = build.finish();
  Workspace workspace(scene, contact_method("direct"));
  State state = scene.initial;
  REQUIRE(step(workspace, judged_step_s, state).status == Status::ok);
  const auto end = judged(scene);
  CHECK((state.v.col(1) - end.v.col(1)).norm() <= 1e-7);
  CHECK((state.spin.col(1) - end.spin.col(1)).norm() <= 1e-7);
}
