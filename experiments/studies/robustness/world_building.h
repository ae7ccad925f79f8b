// A generated world under construction; joints, and cloth, solids and ropes, in files of their own.
#pragma once

#include "scene.h"
#include "studies/robustness/random.h"

namespace pbdcheck {

/// Body 0 is fixed, with ground or without.
class Building {
 public:
  explicit Building(std::uint64_t begin) : random_(begin) {}

  pbd::Scene finish();

 private:
  static constexpr int materials = 2;

  Random random_;
  pbd::Scene scene_;
  pbd::Contact contact_;

  double compliance(double low, double high) { return random_.happens(0.5) ? 0 : random_.decades(low, high); }
  /// Of one constraint; mostly none.
  std::vector<double> damping() {
    if (!random_.happens(0.2)) return {};
    return {random_.decades(-4, -1)};
  }
  int moving() { return 1 + random_.below(static_cast<int>(scene_.bodies.size()) - 1); }
  int material() { return random_.below(materials); }

  pbd::Vec3 own_point(int body, const pbd::Vec3& x) const {
    return scene_.initial.orientation[static_cast<std::size_t>(body)].conjugate() *
           (x - scene_.initial.x.col(scene_.bodies[static_cast<std::size_t>(body)].node));
  }
  pbd::Vec3 own_axis(int body, const pbd::Vec3& u) const {
    return scene_.initial.orientation[static_cast<std::size_t>(body)].conjugate() * u;
  }

  template <class E>
  void add(const E& effect) {
    scene_.effects.emplace_back(effect);
  }

  void add_laws();
  void add_ground();
  void add_bodies();
  void add_shaped(const pbd::Vec3& at, const Eigen::Quaterniond& turn, double speed);
  void add_forces();

  // world_joints.cpp
  void add_joints();
  void add_joint(const std::array<int, 2>& body, const pbd::Vec3& x, const pbd::Vec3& u);
  void add_drive(const std::array<int, 2>& body, const pbd::Vec3& axis,
                 const std::array<pbd::Vec3, 2>& reference);
  void add_slider(const std::array<int, 2>& body, const std::array<pbd::Vec3, 2>& point,
                  const pbd::Vec3& axis, double given);
  std::vector<pbd::ForceBounds> limits(double force);

  // world_nodes.cpp
  void add_nodes();
  void add_cloth(const pbd::TriangleMesh& mesh, std::vector<std::array<int, 3>>& triangles);
  void add_rope(const pbd::Vec3& from);
  void hold(int node);
  void touch(int first, const std::vector<std::array<int, 3>>& triangles);
};

}  // namespace pbdcheck
