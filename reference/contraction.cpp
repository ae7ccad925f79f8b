#include "contraction.h"

#include <Eigen/Dense>
#include <cmath>

#include "assembly.h"
#include "error.h"

namespace pbd::reference {
namespace {

using Matrix = Eigen::MatrixXd;

/// Orthonormal basis of the null space of a wide matrix, one column a direction.
Matrix null_space(const Matrix& rows) {
  Eigen::ColPivHouseholderQR<Matrix> qr(rows.transpose());
  qr.setThreshold(1e-10);
  const Matrix q = qr.householderQ();
  return q.rightCols(rows.cols() - qr.rank());
}

/// Largest magnitude of the eigenvalues of a general matrix.
double spectral_radius(const Matrix& a) {
  return Eigen::EigenSolver<Matrix>(a, false).eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace

Contraction extremes(const Matrix& map) {
  Contraction found;
  const Eigen::EigenSolver<Matrix> solver(map, false);
  for (const auto& value : solver.eigenvalues()) {
    found.smallest = std::min(found.smallest, std::copysign(std::abs(value), value.real()));
    found.largest = std::max(found.largest, std::copysign(std::abs(value), value.real()));
  }
  return found;
}

Contraction plain_contraction(const Scene& scene, const Points& x, const Eigen::VectorXd& gamma, double h) {
  const Model model = make_model(scene);
  const Rows rows = all_rows(model, x, gamma);
  const Vector root = model.mass.cwiseSqrt().cwiseInverse();
  const Matrix jacobian = rows.jacobian * root.asDiagonal();
  Matrix hard(model.hard_rows, model.unknowns);
  Matrix metric = Matrix::Identity(model.unknowns, model.unknowns);
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& e = model.elements[k];
    const auto own = jacobian.middleRows(rows.first[k], e.rows);
    if (e.hard())
      hard.middleRows(e.first_row, e.rows) = own;
    else
      metric += h * h * own.transpose() * e.stiffness * own;
  }
  const Matrix basis =
      model.hard_rows > 0 ? null_space(hard) : Matrix::Identity(model.unknowns, model.unknowns);
  if (basis.cols() == 0) return {};
  const Matrix dropped = h * h * (root.asDiagonal() * rows.geometric * root.asDiagonal());
  const Matrix left = basis.transpose() * metric * basis;
  return extremes(left.llt().solve(basis.transpose() * dropped * basis));
}

RelaxationRates relaxation_rates(const Scene& scene, const Points& x, double h, double omega) {
  const Model model = make_model(scene);
  for (const Element& e : model.elements)
    if (e.kind == Kind::corotational)
      throw SetupError("relaxation_rates", "corotational tetrahedra", "green or linear strain");
  if (model.elements.empty()) throw SetupError("relaxation_rates", "no rows", "a scene with constraints");
  const Rows rows = all_rows(model, x, Vector::Zero(model.hard_rows));
  Matrix n = rows.jacobian * model.mass.cwiseInverse().asDiagonal() * rows.jacobian.transpose();
  Matrix diagonal = Matrix::Zero(n.rows(), n.cols()), lower = diagonal;
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const int at = rows.first[k], size = model.elements[k].rows;
    if (!model.elements[k].hard())
      n.block(at, at, size, size) += Matrix(model.elements[k].stiffness).inverse() / (h * h);
    diagonal.block(at, at, size, size) = n.block(at, at, size, size);
    lower.block(at, 0, size, at + size) = n.block(at, 0, size, at + size);
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> scaled(n, diagonal, Eigen::EigenvaluesOnly);
  const double smallest = scaled.eigenvalues().minCoeff(), largest = scaled.eigenvalues().maxCoeff();
  RelaxationRates rates;
  rates.jacobi = std::max(std::abs(1 - omega * smallest), std::abs(1 - omega * largest));
  rates.gauss_seidel = spectral_radius(lower.partialPivLu().solve(lower - n));
  rates.condition = smallest > 1e-14 * largest ? largest / smallest : infinity;
  return rates;
}

}  // namespace pbd::reference
