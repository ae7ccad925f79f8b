#include "effects/anchor.h"

#include "rows/effect_rows.h"

namespace pbd {

auto Constraint<Anchor>::node(const Anchor& effect, std::size_t i) -> Nodes {
  return {effect.node[i]};
}

double Constraint<Anchor>::compliance_scale(const Anchor& effect, std::size_t i) {
  return effect.compliance[i];
}

auto Constraint<Anchor>::retardation(const Anchor& effect, std::size_t i) -> Square {
  return effect.damping[i] * Square::Identity();
}

void Constraint<Anchor>::evaluate(const Anchor& effect, std::size_t i, const Positions& x, Value& value,
                                  Jacobian& jacobian) {
  value = x - effect.target[i];
  jacobian.setIdentity();
}

auto Constraint<Anchor>::geometric_bound(const Anchor&, std::size_t, const Positions&, const Value&)
    -> NodeBounds {
  return NodeBounds::Zero();
}

std::unique_ptr<Source> make_source(const Scene& scene, const Anchor& effect) {
  return std::make_unique<EffectRows<Anchor>>(scene, effect);
}

}  // namespace pbd
