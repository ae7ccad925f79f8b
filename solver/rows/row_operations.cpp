#include "rows/row_operations.h"

#include "rows/invert.h"

namespace pbd {

template <int R, int K>
bool RowOperations<R, K>::invert_diagonal(Block& block, const std::vector<double>& inverse_mass,
                                          std::size_t i, const Jacobian& jacobian) {
  Square n = block.compliance[i];
  for (int a = 0; a < K; ++a) {
    const auto part = jacobian.template middleCols<3>(3 * a);
    n.noalias() += inverse_mass[block.node[i][a]] * (part * part.transpose());
  }
  bool singular = false;
  if (block.frictional()) {
    block.delassus[i] = n;
    const double trace = n.trace();
    block.inverse_diagonal[i] = (trace > 0 ? R / trace : 0.0) * Square::Identity();
    if (!(trace > 0)) block.bounds[i].freedom = Freedom::held;  // nothing that it touches can move
  } else {
    block.inverse_diagonal[i] = invert(n, singular);
  }
  return singular;
}

template <int R, int K>
auto RowOperations<R, K>::moving_squares(const Block& block, std::size_t i,
                                         const std::vector<double>& inverse_mass, const Jacobian& jacobian)
    -> Value {
  Value sum = Value::Zero();
  for (int a = 0; a < K; ++a)
    if (inverse_mass[block.node[i][a]] > 0)
      sum += jacobian.template middleCols<3>(3 * a).rowwise().squaredNorm();
  return sum;
}

template <int R, int K>
void RowOperations<R, K>::linearise(const RowPlace& place, const Value& value, double size, Block& block,
                                    std::size_t i, RowResidual& sums) {
  const Jacobian& jacobian = block.jacobian[i];
  block.bias[i] = value / place.map.d - block.rate(place.v, i);
  const bool singular = invert_diagonal(block, place.inverse_mass, i, jacobian);
  const Value r = value / place.map.d + block.compliance[i] * block.impulse[i];
  const double rounding = value_rounding * size / place.map.d;
  sums.add(
      singular ? place.unreachable_mass * r.squaredNorm() : squared_residual(block, i, r),
      rounding * rounding *
          moving_squares(block, i, place.inverse_mass, jacobian).dot(block.inverse_diagonal[i].diagonal()));
  sums.impulses_squared += block.squared_effect(place.inverse_mass, i, jacobian);
}

template <int R, int K>
bool RowOperations<R, K>::meets(const StepBegin& begin, double open, bool upwards, double size,
                                const Block& block, std::size_t i) requires(R == 1) {
  const StepMap& map = begin.map;
  const double sign = upwards ? 1 : -1;
  const auto along = [&](const Points& columns) { return sign * block.rate(columns, i)[0]; };
  const double closing = -along(begin.v);
  const double rounding = value_rounding * size / map.d *
                          std::sqrt(moving_squares(block, i, begin.inverse_mass, block.jacobian[i])[0]);
  if (!(closing > rounding)) return false;
  const double free = along(map.v_free);
  const double moved = along(map.x0) - along(begin.at.x) + map.d * free;
  const double ahead = open + begin.coefficients.extension * moved;
  return ahead < 0 && closing > pressed_speed * std::abs(free + closing);
}

namespace {

/// What the impulse of a row with bounds and the value `missed` (per second) can err by near the solution:
/// nothing where it is at a bound.
template <class Block>
Freedom freedom_of_errors(const Block& block, const typename Block::Value& missed, std::size_t i) {
  const auto& p = block.impulse[i];
  const typename Block::Value full = -block.by_inverse_diagonal(i, missed + block.compliance[i] * p);
  return allowed(block, i, p, full) == full ? Freedom::free : Freedom::held;
}

}  // namespace

template <int R, int K>
void RowOperations<R, K>::perturb(const RowError& error, const Value& value, const Jacobian& jacobian,
                                  Block& block, std::size_t i, Points& push) {
  block.apply(error.inverse_mass, i, jacobian, block.impulse[i], push);
  const Value before = block.bias[i] + block.rate(error.v, i);
  block.bias[i] = (value / error.map.d - before) / error.scale - block.rate(error.error, i);
  if constexpr (R == 1)
    if (block.bounded()) block.bounds[i].freedom = freedom_of_errors(block, before, i);
  block.impulse[i].setZero();
}

template <int R, int K>
void RowOperations<R, K>::append_metric(const Block& block, std::size_t i, const Jacobian& jacobian,
                                        const Stiffness& more, bool one_number,
                                        std::vector<MetricEntry>& entries) {
  const Square stiffness = block.stiffness[i];
  for (int a = 0; a < K; ++a)
    for (int b = 0; b <= a; ++b) {
      const Eigen::Matrix<double, R, 3> own = jacobian.template middleCols<3>(3 * a),
                                        other = jacobian.template middleCols<3>(3 * b);
      const Eigen::Matrix<double, 3, R> stiff = own.transpose() * stiffness;
      Eigen::Matrix3d pair = stiff * other + more.template block<3, 3>(3 * a, 3 * b);
      if (one_number) pair = Eigen::Matrix3d(Vec3::Constant(pair.trace() / 3).asDiagonal());
      entries.push_back({block.node[i][a], block.node[i][b], pair});
    }
}

// The shapes of AnyBlock that have masses.
template struct RowOperations<3, 1>;
template struct RowOperations<1, 2>;
template struct RowOperations<1, 4>;
template struct RowOperations<3, 3>;
template struct RowOperations<6, 4>;
template struct RowOperations<2, 4>;
template struct RowOperations<3, 4>;
template struct RowOperations<1, 3>;
template struct RowOperations<3, 5>;
template struct RowOperations<1, 5>;

void refresh_inverse_diagonal(Rows& rows) {
  for_each_block(rows.blocks, [&]<class Block>(Block& block) {
    if constexpr (!is_local<Block>)
      for (std::size_t i = 0; i < block.size(); ++i)
        RowOperations<Block::rows, Block::nodes>::invert_diagonal(block, rows.inverse_mass, i,
                                                                  block.jacobian[i]);
  });
}

}  // namespace pbd
