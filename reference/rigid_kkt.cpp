#include "rigid_kkt.h"

#include <algorithm>
#include <cmath>

#include "kkt.h"

namespace pbd::reference {

Scales scales_of(const RigidStep& s, const RigidSystem& system) {
  Scales scales{s.model.inertia.cwiseSqrt().cwiseInverse(), {}};
  const SparseMatrix own = scaled(system.jacobian, scales.unknown);
  scales.row = squared_rows(own, Vector::Ones(s.model.unknowns));
  scales.row += Vector(system.compliance.diagonal()) / (s.h * s.h);
  scales.row = scales.row.unaryExpr([](double n) { return n > 0 ? 1 / std::sqrt(n) : 1.0; });
  return scales;
}

int drop_dependent(const RigidModel& model, const RigidSystem& system, double threshold, Scales& scales) {
  const SparseMatrix hard = hard_rows(model, scaled(scales.row, system.jacobian, scales.unknown));
  const std::vector<int> independent = independent_rows(hard, threshold);
  int position = 0;
  for (int i = 0; i < model.rows(); ++i)
    if (model.hard[i] && !std::binary_search(independent.begin(), independent.end(), position++))
      scales.row(i) = 0;
  return static_cast<int>(independent.size());
}

bool RigidKkt::compute(const RigidStep& step, const RigidSystem& system, const Scales& scales) {
  scales_ = scales;
  h2_ = step.h * step.h;
  Triplets entries;
  const int n = step.model.unknowns, rows = step.model.rows();
  const auto add = [&](const SparseMatrix& part, const auto& use) {
    for (int j = 0; j < part.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(part, j); it; ++it) use(static_cast<int>(it.row()), j, it.value());
  };
  add(system.tangent, [&](int i, int j, double value) {
    entries.emplace_back(i, j, h2_ * scales.unknown(i) * value * scales.unknown(j));
  });
  add(system.jacobian, [&](int i, int j, double value) {
    const double own = scales.row(i) * value * scales.unknown(j);
    entries.emplace_back(n + i, j, own);
    entries.emplace_back(j, n + i, -own);
  });
  add(system.compliance, [&](int i, int j, double value) {
    entries.emplace_back(n + i, n + j, scales.row(i) * value * scales.row(j) / h2_);
  });
  for (int i = 0; i < rows; ++i)
    if (scales.row(i) == 0) entries.emplace_back(n + i, n + i, 1.0);
  matrix_ = from_triplets(n + rows, n + rows, entries);
  return lu_.compute(matrix_);
}

void RigidKkt::solve(const Vector& force, const Vector& value, Vector& increment, Vector& gamma) const {
  Vector rhs(force.size() + value.size());
  rhs << h2_ * scales_.unknown.cwiseProduct(force), scales_.row.cwiseProduct(value);
  const Vector solution = lu_.solve(rhs);
  increment = scales_.unknown.cwiseProduct(solution.head(force.size()));
  gamma = scales_.row.cwiseProduct(solution.tail(value.size())) / h2_;
}

}  // namespace pbd::reference
