#include "compliant_forces.h"

#include <Eigen/Dense>

#include "effect_rows.h"

namespace pbd {
namespace {

template <class E>
void add_forces(const Scene& scene, const E& effect, bool with_damping, const Configuration& at,
                const Points& v, const std::vector<double>& inverse_mass, Points& acceleration) {
  using C = Constraint<E>;
  typename C::Value value;
  typename C::Jacobian jacobian;
  for (std::size_t i = 0; i < constraint_count(effect); ++i) {
    if (!compliant(effect, i)) continue;
    const auto node = columns_of(scene, effect, i);
    C::evaluate(effect, i, local(effect, i, node, at), value, jacobian);
    if (with_damping) value += C::retardation(effect, i) * (jacobian * positions_of(node, v).reshaped());
    const typename C::Value force = -C::compliance(effect, i).llt().solve(value);
    const Eigen::Matrix<double, 3, C::nodes> push = (jacobian.transpose() * force).reshaped(3, C::nodes);
    for (int a = 0; a < C::nodes; ++a) {
      const int index = node[static_cast<std::size_t>(a)];
      acceleration.col(index) += inverse_mass[static_cast<std::size_t>(index)] * push.col(a);
    }
  }
}

}  // namespace

void add_compliant_forces(const Scene& scene, const Configuration& at, const Points& v,
                          const std::vector<double>& inverse_mass, Points& acceleration) {
  for (const auto& any : scene.effects)
    std::visit(
        [&]<class E>(const E& effect) {
          if constexpr (RowEffect<E>)
            add_forces(scene, effect, damped(any), at, v, inverse_mass, acceleration);
        },
        any);
}

}  // namespace pbd
