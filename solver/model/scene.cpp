#include "scene.h"

namespace pbd {

EffectList::EffectList() = default;
EffectList::EffectList(std::initializer_list<Effect> effects) : vector(effects) {}
EffectList::EffectList(const EffectList&) = default;
EffectList::EffectList(EffectList&&) noexcept = default;
EffectList& EffectList::operator=(const EffectList&) = default;
EffectList& EffectList::operator=(EffectList&&) noexcept = default;
EffectList::~EffectList() = default;

bool damped(const Effect& effect) {
  return std::visit([](const auto& stated) { return damped(stated); }, effect);
}

int add_node(Scene& scene, const Vec3& position, double mass, const Vec3& velocity) {
  const int index = scene.nodes();
  scene.mass.push_back(mass);
  scene.initial.x.conservativeResize(3, index + 1);
  scene.initial.v.conservativeResize(3, index + 1);
  scene.initial.x.col(index) = position;
  scene.initial.v.col(index) = velocity;
  return index;
}

int add_body(Scene& scene, const Vec3& position, double mass, const Vec3& inertia,
             const Eigen::Quaterniond& orientation, const Vec3& velocity, const Vec3& spin) {
  scene.bodies.push_back({add_node(scene, position, mass, velocity), inertia});
  scene.initial.orientation.push_back(orientation);
  const auto count = static_cast<Eigen::Index>(scene.bodies.size());
  scene.initial.spin.conservativeResize(3, count);
  scene.initial.spin.col(count - 1) = spin;
  return static_cast<int>(count) - 1;
}

}  // namespace pbd
