#include "units.h"

namespace pbdcheck {

using namespace pbd;

namespace {

struct Units {
  double length, mass;

  void operator()(Gravity& e) const { e.acceleration *= length; }
  void operator()(ExternalForce& e) const {
    for (auto& force : e.force) force *= mass * length;
  }
  void operator()(Anchor& e) const {
    for (auto& target : e.target) target *= length;
    for (auto& compliance : e.compliance) compliance /= mass;
  }
  void operator()(Distance& e) const {
    for (auto& rest : e.rest_length) rest *= length;
    for (auto& compliance : e.compliance) compliance /= mass;
  }
  void operator()(Bending& e) const {
    for (auto& compliance : e.compliance) compliance /= mass * length * length;
  }
  void operator()(TriangleStrain& e) const {
    for (auto& rest : e.rest) rest *= length;
    e.thickness *= length;
    e.material.young *= mass / length;
  }
  void operator()(TetStrain& e) const {
    for (auto& rest : e.rest) rest *= length;
    e.material.young *= mass / length;
  }
};

}  // namespace

Scene in_units(Scene scene, double length, double mass) {
  for (auto& value : scene.mass) value *= mass;
  scene.initial.x *= length;
  scene.initial.v *= length;
  for (auto& effect : scene.effects) std::visit(Units{length, mass}, effect);
  return scene;
}

}  // namespace pbdcheck
