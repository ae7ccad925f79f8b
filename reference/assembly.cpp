#include "assembly.h"

#include <algorithm>
#include <cmath>

#include "dense.h"
#include "polar.h"

namespace pbd::reference {
namespace {

RowMatrix tangent(const Element& e, const Multipliers& m) {
  if (!e.hard() || !m.rho.size()) return e.stiffness;
  return Vector(m.rho.segment(e.first_row, e.rows)).asDiagonal();
}

/// Negative eigenvalues set to zero.
void project(LocalMatrix& h) {
  const auto [values, vectors] = symmetric_eigen(h);
  if (values(0) >= 0) return;
  h = vectors * values.cwiseMax(0).asDiagonal() * vectors.transpose();
}

/// d2L/dF2 of an element: J^T A^-1 J + sum_k (dL/dc)_k d2c_k/dF2.
LocalMatrix curvature_of(const Local& local, const RowVector& s, const RowMatrix& t) {
  LocalMatrix h = transposed_product(local.jacobian, (t * local.jacobian).eval());
  for (int k = 0; k < s.size(); ++k) h += s(k) * local.hessian[k];
  return h;
}

}  // namespace

Assembly::Assembly(const Model& model) : model_(&model), offset_(model.elements.size()) {
  Triplets pattern;
  const auto each_pair = [&](const Element& e, const auto& use) {
    for (int a = 0; a < e.nodes; ++a)
      for (int b = 0; b < e.nodes; ++b) {
        const int i = model.unknown(e, a), j = model.unknown(e, b);
        if (i >= 0 && j >= 0) use(4 * a + b, i / 3, j / 3);
      }
  };
  for (int i = 0; i < model.unknowns / 3; ++i) pattern.emplace_back(i, i, 1.0);
  for (const Element& e : model.elements)
    each_pair(e, [&](std::size_t, int i, int j) { pattern.emplace_back(i, j, 1.0); });
  const SparseMatrix blocks = from_triplets(model.unknowns / 3, model.unknowns / 3, pattern);

  auto& h = result_.hessian;
  h.resize(model.unknowns, model.unknowns);
  h.reserve(9 * blocks.nonZeros());
  for (int j = 0; j < model.unknowns; ++j) {
    h.startVec(j);
    for (SparseMatrix::InnerIterator it(blocks, j / 3); it; ++it)
      for (int k = 0; k < 3; ++k) h.insertBack(3 * static_cast<int>(it.row()) + k, j) = 0;
  }
  h.finalize();
  for (std::size_t n = 0; n < model.elements.size(); ++n)
    each_pair(model.elements[n], [&](std::size_t pair, int i, int j) {
      const int* begin = blocks.innerIndexPtr() + blocks.outerIndexPtr()[j];
      const int* end = blocks.innerIndexPtr() + blocks.outerIndexPtr()[j + 1];
      offset_[n][pair] = 3 * static_cast<int>(std::lower_bound(begin, end, i) - begin);
    });
}

const Derivatives& Assembly::at(const Points& x, const Multipliers& multipliers, Curvature curvature) {
  result_.value = 0;
  result_.gradient.setZero(model_->unknowns);
  result_.magnitude.setZero(model_->unknowns);
  result_.hard.setZero(model_->hard_rows);
  Eigen::Map<Vector>(result_.hessian.valuePtr(), result_.hessian.nonZeros()).setZero();
  jacobian_.clear();
  for (std::size_t n = 0; n < model_->elements.size(); ++n) {
    differentiate(model_->elements[n], x, local_);
    add(model_->elements[n], n, multipliers, curvature);
  }
  result_.jacobian = from_triplets(model_->hard_rows, model_->unknowns, jacobian_);
  return result_;
}

void Assembly::add(const Element& e, std::size_t index, const Multipliers& multipliers, Curvature curvature) {
  const RowVector s = stress(e, local_.value, multipliers);
  const LocalVector gradient = local_.jacobian.transpose() * s;
  LocalMatrix h = curvature_of(local_, s, tangent(e, multipliers));
  if (curvature == Curvature::projected) project(h);

  result_.value += energy(e, local_.value, multipliers);
  if (e.hard()) result_.hard.segment(e.first_row, e.rows) = local_.value;
  double* values = result_.hessian.valuePtr();
  const int* outer = result_.hessian.outerIndexPtr();
  for (int a = 0; a < e.nodes; ++a) {
    const int i = model_->unknown(e, a);
    if (i < 0) continue;
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 9> half(3, e.variables());  // sum_q w_aq h(q, .)
    half.setZero();
    for (int q = 0; q < e.columns; ++q) {
      const double w = e.weight(a, q);
      half += w * h.middleRows<3>(3 * q);
      result_.gradient.segment<3>(i) += w * gradient.segment<3>(3 * q);
      result_.magnitude.segment<3>(i) += std::abs(w) * gradient.segment<3>(3 * q).cwiseAbs();
    }
    for (int b = 0; b < e.nodes; ++b) {
      const int j = model_->unknown(e, b);
      if (j < 0) continue;
      Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
      for (int q = 0; q < e.columns; ++q) block += e.weight(b, q) * half.middleCols<3>(3 * q);
      const int offset = offset_[index][4 * a + b];
      for (int d = 0; d < 3; ++d) Eigen::Map<Vec3>(values + outer[j + d] + offset) += block.col(d);
    }
    if (e.hard()) add_jacobian(e, a, i);
  }
}

void Assembly::add_jacobian(const Element& e, int a, int unknown) {
  for (int k = 0; k < e.rows; ++k)
    for (int d = 0; d < 3; ++d) {
      double entry = 0;
      for (int q = 0; q < e.columns; ++q) entry += e.weight(a, q) * local_.jacobian(k, 3 * q + d);
      jacobian_.emplace_back(e.first_row + k, unknown + d, entry);
    }
}

Vector energy_gradient(const Model& model, const Points& x) {
  Vector gradient = Vector::Zero(model.unknowns);
  Local local;
  for (const Element& e : model.elements) {
    if (e.hard()) continue;
    differentiate_once(e, x, local);
    const LocalVector by_f = local.jacobian.transpose() * stress(e, local.value, {});
    for (int a = 0; a < e.nodes; ++a)
      if (const int i = model.unknown(e, a); i >= 0)
        for (int q = 0; q < e.columns; ++q) gradient.segment<3>(i) += e.weight(a, q) * by_f.segment<3>(3 * q);
  }
  return gradient;
}

Rows all_rows(const Model& model, const Points& x, const Vector& gamma) {
  Rows r;
  r.first = {0};
  for (const Element& e : model.elements) r.first.push_back(r.first.back() + e.rows);
  const int rows = r.first.back(), n = model.unknowns;
  r.value.setZero(rows), r.multiplier.setZero(rows);
  r.jacobian.setZero(rows, n), r.geometric.setZero(n, n);
  Local local;
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& e = model.elements[k];
    differentiate(e, x, local);
    const int at = r.first[k];
    const RowVector multiplier = -stress(e, local.value, {gamma, {}});
    r.value.segment(at, e.rows) = local.value;
    r.multiplier.segment(at, e.rows) = multiplier;
    LocalMatrix h = curvature_of(local, multiplier, RowMatrix::Zero(e.rows, e.rows));
    if (e.kind == Kind::corotational) {
      const HeldRotation held = held_rotation(local_matrix(e, x), multiplier);
      h = held.turning + product(held.jacobian.transpose() * e.stiffness, held.jacobian - local.jacobian);
      local.jacobian = held.jacobian;
    }
    for (int a = 0; a < e.nodes; ++a) {
      const int i = model.unknown(e, a);
      if (i < 0) continue;
      for (int q = 0; q < e.columns; ++q) {
        r.jacobian.block(at, i, e.rows, 3) += e.weight(a, q) * local.jacobian.middleCols<3>(3 * q);
        for (int b = 0; b < e.nodes; ++b) {
          const int j = model.unknown(e, b);
          if (j < 0) continue;
          for (int p = 0; p < e.columns; ++p)
            r.geometric.block<3, 3>(i, j) += e.weight(a, q) * e.weight(b, p) * h.block<3, 3>(3 * q, 3 * p);
        }
      }
    }
  }
  return r;
}

}  // namespace pbd::reference
