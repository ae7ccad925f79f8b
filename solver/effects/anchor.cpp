#include "effects/anchor.h"

#include "rows/effect_rows.h"

namespace pbd {

using C = Constraint<Anchor>;

C::Nodes C::node(const Anchor& effect, std::size_t i) {
  return {effect.node[i]};
}

C::Square C::compliance(const Anchor& effect, std::size_t i) {
  return effect.compliance[i] * Square::Identity();
}

C::Square C::retardation(const Anchor& effect, std::size_t i) {
  return effect.damping[i] * Square::Identity();
}

void C::evaluate(const Anchor& effect, std::size_t i, const Positions& x, Value& value, Jacobian& jacobian) {
  value = x - effect.target[i];
  jacobian.setIdentity();
}

C::NodeBounds C::geometric_bound(const Anchor&, std::size_t, const Positions&, const Value&) {
  return NodeBounds::Zero();
}

std::unique_ptr<Source> make_source(const Scene& scene, const Anchor& effect) {
  return std::make_unique<EffectRows<Anchor>>(scene, effect);
}

}  // namespace pbd
