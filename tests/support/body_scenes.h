// Scenes of jointed rigid bodies, and of nodes held by them.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "mesh.h"
#include "scene.h"

namespace pbd::test {

inline int add_world(Scene& scene) {
  return add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
}

inline void join(PointJoint& joints, int a, int b, const Vec3& own_a, const Vec3& own_b,
                 double compliance = 0) {
  joints.body.push_back({a, b});
  joints.point.push_back({own_a, own_b});
  joints.compliance.push_back(compliance);
}

/// The world, and a body of 1 kg at (x, 0, 0) linked to it from centre to centre.
inline Scene linked_body(double x, double rest_length, double compliance, std::vector<ForceBounds> bounds) {
  Scene scene;
  const int world = add_world(scene), body = add_body(scene, Vec3(x, 0, 0), 1, Vec3::Ones());
  scene.effects.emplace_back(BodyDistance{.body = {{world, body}},
                                          .point = {{Vec3::Zero(), Vec3::Zero()}},
                                          .rest_length = {rest_length},
                                          .compliance = {compliance},
                                          .bounds = std::move(bounds)});
  return scene;
}

/// Rods of 0.5 m along their first axis, each on the last one's end by a ball joint; the first on the world.
/// They hang askew and turn.
inline Scene rod_chain(int rods, double compliance = 0) {
  Scene scene;
  int last = add_world(scene);
  PointJoint balls;
  Vec3 end = Vec3::Zero(), end_of_last = Vec3::Zero();
  for (int i = 0; i < rods; ++i) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.6 + 0.3 * i, Vec3(0.2 * i, 1, 0.3).normalized()));
    const Vec3 half(0.25, 0, 0);
    const int rod = add_body(scene, end + turn * half, 1 + 0.2 * i, Vec3(0.003, 0.02, 0.022), turn,
                             Vec3::Zero(), Vec3(3, -0.5 * i, 0.4));
    join(balls, last, rod, end_of_last, -half, compliance);
    last = rod, end_of_last = half;
    end += turn * (2 * half);
  }
  scene.effects = {Gravity{}, Gyroscopic{}, balls};
  return scene;
}

/// A body on a compliant ball joint, from which a rope of three nodes hangs, hard links, and whose other side
/// holds a soft bar of tetrahedra by attachments.
inline Scene body_with_rope_and_solid() {
  Scene scene;
  const int world = add_world(scene);
  const int body = add_body(scene, Vec3(0, 0, -0.3), 2, Vec3(0.02, 0.03, 0.025),
                            Eigen::Quaterniond::Identity(), Vec3::Zero(), Vec3(0, 1, 0.5));
  PointJoint ball;
  join(ball, world, body, Vec3::Zero(), Vec3(0, 0, 0.3), 1e-5);
  Attachment held;
  const auto attach = [&](int node) {
    held.body.push_back(body);
    held.node.push_back(node);
    held.point.emplace_back(scene.initial.x.col(node) - scene.initial.x.col(1));
    held.compliance.push_back(0);
  };
  Distance rope;
  for (int i = 0; i < 3; ++i) {
    const int node = add_node(scene, Vec3(0.2 + 0.1 * i, 0, -0.3), 0.1);
    if (i == 0) attach(node);
    if (i > 0)
      rope.node.push_back({node - 1, node}), rope.rest_length.push_back(0.1), rope.compliance.push_back(0);
  }
  const int first = scene.nodes();
  add_solid(scene, kuhn_grid({2, 1, 1}, Vec3(0.4, 0.1, 0.1), Vec3(-0.6, 0, -0.3)), 1000, {1e5, 0.3},
            Strain::corotational);
  for (int i = first; i < scene.nodes(); ++i)
    if (scene.initial.x(0, i) > -0.2 - 1e-9) attach(i);
  scene.effects.insert(scene.effects.begin(), {Gravity{}, Gyroscopic{}, ball, rope, held});
  return scene;
}

/// Kinetic energy of bodies that are the scene's first nodes, J.
inline double kinetic_energy(const Scene& scene, const State& state) {
  double sum = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const auto body = static_cast<Eigen::Index>(b);
    if (!std::isfinite(scene.mass[b])) continue;
    sum += scene.mass[b] * state.v.col(body).squaredNorm() / 2 +
           scene.bodies[b].inertia.dot(state.spin.col(body).cwiseAbs2()) / 2;
  }
  return sum;
}

}  // namespace pbd::test
