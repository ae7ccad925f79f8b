#include "damping.h"

#include <Eigen/Dense>

#include "effect_rows.h"

namespace pbd {
namespace {

/// v^T c'' v from c at x + t v and x - t v.
template <class E>
typename Constraint<E>::Value bend(const E& effect, std::size_t entry,
                                   const typename Constraint<E>::Positions& x,
                                   const typename Constraint<E>::Positions& v,
                                   const typename Constraint<E>::Value& value, double t) {
  typename Constraint<E>::Value ahead, behind;
  typename Constraint<E>::Jacobian unused;
  Constraint<E>::evaluate(effect, entry, x + t * v, ahead, unused);
  Constraint<E>::evaluate(effect, entry, x - t * v, behind, unused);
  return (ahead - 2 * value + behind) / (t * t);
}

template <class E>
void begin(const E& effect, const StepCoefficients& c, const State& state, const Points& a,
           BlockOf<E>& block) {
  using Square = typename BlockOf<E>::Square;
  const double curvature = c.x_a - (c.reach == 1 ? 0.0 : c.d * c.d / 2);
  Square share;  // (1 + T/d)^-1
  block.offset.resize(block.size());
  block.begin_value.resize(block.size());
  for (std::size_t i = 0; i < block.size(); ++i) {
    const std::size_t entry = block.entry(i);
    const auto x = positions_of(block.node[i], state.x), v = positions_of(block.node[i], state.v);
    typename BlockOf<E>::Value value;
    Constraint<E>::evaluate(effect, entry, x, value, block.jacobian[i]);
    typename BlockOf<E>::Value from = value;  // c0
    if (c.x_v != 0) from += block.jacobian[i] * (c.x_v * block.gather(state.v, i));
    if (c.x_a != 0) from += block.jacobian[i] * (c.x_a * block.gather(a, i));
    if (c.before != 0) from += c.before * (value - block.begin_value[i]);
    if (curvature != 0) from += curvature * bend(effect, entry, x, v, value, c.d);
    block.begin_value[i] = value;

    if (i == 0 || !Constraint<E>::one_material)
      share = Square(Square::Identity() + Constraint<E>::retardation(effect, entry) / c.d).inverse();
    block.offset[i] = from - share * from;
    block.compliance[i] = share * Constraint<E>::compliance(effect, entry) / (c.s * c.d);
  }
}

}  // namespace

void begin_damping(const Effect& effect, const StepCoefficients& coefficients, const State& state,
                   const Points& a, AnyBlock& block) {
  std::visit(
      [&]<class E>(const E& stated) {
        if constexpr (RowEffect<E>) begin(stated, coefficients, state, a, std::get<BlockOf<E>>(block));
      },
      effect);
}

}  // namespace pbd
