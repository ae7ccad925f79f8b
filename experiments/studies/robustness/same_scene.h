// The same scene in other words: turned, shifted, mirrored, its parts in another order. Its motion is the
// same, too.
#pragma once

#include "scene.h"
#include "studies/robustness/random.h"

namespace pbdcheck {

/// x -> shift + turn x with a rotation, or a reflection, `turn`. A reflected body's frame is a reflected one,
/// too: its own vectors have the other sign along x.
struct Isometry {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  pbd::Vec3 shift = pbd::Vec3::Zero();  // m
};

pbd::State moved(const pbd::State& state, const Isometry& by);
pbd::Scene moved(pbd::Scene scene, const Isometry& by);

/// Where the parts of a scene stand: part `node[i]` of the first one is part i of the second.
struct Order {
  std::vector<int> node, body, effect;
};
Order any_order(const pbd::Scene& scene, Random& random);

pbd::State reordered(const pbd::State& state, const Order& order);
/// Colliders and contact's nodes come in the opposite order.
pbd::Scene reordered(const pbd::Scene& scene, const Order& order);

}  // namespace pbdcheck
