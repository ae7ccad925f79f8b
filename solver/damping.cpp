#include "damping.h"

#include <Eigen/Dense>

#include "effect_rows.h"

namespace pbd {
namespace {

double curvature(const StepCoefficients& c) {
  return c.x_a - (c.reach == 1 ? 0.0 : c.d * c.d / 2);
}

template <class E>
void begin(const E& effect, const StepCoefficients& c, const DampingBegin& start, const Points& a,
           BlockOf<E>& block) {
  using Square = typename BlockOf<E>::Square;
  Square share;  // (1 + T/d)^-1
  typename Constraint<E>::Jacobian unused;
  block.offset.resize(block.size());
  block.begin_value.resize(block.size());
  for (std::size_t i = 0; i < block.size(); ++i) {
    const std::size_t entry = block.entry(i);
    const auto value_at = [&](const Configuration& at, auto& jacobian) {
      typename BlockOf<E>::Value value;
      Constraint<E>::evaluate(effect, entry, local(effect, entry, block.node[i], at), value, jacobian);
      return value;
    };
    const typename BlockOf<E>::Value value = value_at(start.at, block.jacobian[i]);
    typename BlockOf<E>::Value from = value;  // c0
    if (c.x_v != 0) from += block.jacobian[i] * (c.x_v * block.gather(start.v, i));
    if (c.x_a != 0) from += block.jacobian[i] * (c.x_a * block.gather(a, i));
    if (c.before != 0) from += c.before * (value - block.begin_value[i]);
    if (bends(c)) {
      const typename BlockOf<E>::Value ahead = value_at(start.ahead, unused);
      const typename BlockOf<E>::Value behind = value_at(start.behind, unused);
      from += curvature(c) * ((ahead - 2 * value + behind) / (c.d * c.d));
    }
    block.begin_value[i] = value;

    if (i == 0 || !Constraint<E>::one_material)
      share = Square(Square::Identity() + Constraint<E>::retardation(effect, entry) / c.d).inverse();
    block.offset[i] = from - share * from;
    block.compliance[i] = share * Constraint<E>::compliance(effect, entry) / (c.s * c.d);
  }
}

}  // namespace

bool bends(const StepCoefficients& coefficients) {
  return curvature(coefficients) != 0;
}

void begin_damping(const Effect& effect, const StepCoefficients& coefficients, const DampingBegin& start,
                   const Points& a, AnyBlock& block) {
  std::visit(
      [&]<class E>(const E& stated) {
        if constexpr (RowEffect<E>) begin(stated, coefficients, start, a, std::get<BlockOf<E>>(block));
      },
      effect);
}

}  // namespace pbd
