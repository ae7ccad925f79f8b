#include "compliant_forces.h"

#include <Eigen/Dense>

#include "effect_rows.h"

namespace pbd {
namespace {

template <class E>
void add_forces(const E& effect, bool with_damping, const State& state,
                const std::vector<double>& inverse_mass, Points& acceleration) {
  using C = Constraint<E>;
  typename C::Value value;
  typename C::Jacobian jacobian;
  for (std::size_t i = 0; i < effect.node.size(); ++i) {
    if (!compliant(effect, i)) continue;
    const auto node = C::node(effect, i);
    C::evaluate(effect, i, positions_of(node, state.x), value, jacobian);
    if (with_damping)
      value += C::retardation(effect, i) * (jacobian * positions_of(node, state.v).reshaped());
    const typename C::Value force = -C::compliance(effect, i).llt().solve(value);
    const Eigen::Matrix<double, 3, C::nodes> push = (jacobian.transpose() * force).reshaped(3, C::nodes);
    for (int a = 0; a < C::nodes; ++a) {
      const int index = node[static_cast<std::size_t>(a)];
      acceleration.col(index) += inverse_mass[static_cast<std::size_t>(index)] * push.col(a);
    }
  }
}

}  // namespace

void add_compliant_forces(const Scene& scene, const State& state, const std::vector<double>& inverse_mass,
                          Points& acceleration) {
  for (const auto& any : scene.effects)
    std::visit(
        [&]<class E>(const E& effect) {
          if constexpr (RowEffect<E>) add_forces(effect, damped(any), state, inverse_mass, acceleration);
        },
        any);
}

}  // namespace pbd
