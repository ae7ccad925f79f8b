#include "contraction.h"

#include <cmath>

#include "assembly.h"
#include "dense.h"
#include "error.h"

namespace pbd::reference {
namespace {

constexpr double dependent = 1e-10;  // rows whose pivot is below this share of the largest: rounding

}  // namespace

Contraction extremes(const Eigen::MatrixXd& map) {
  if (!map.allFinite()) return {std::nan(""), std::nan("")};
  Contraction found;
  for (const auto& value : eigenvalues(map)) {
    found.smallest = std::min(found.smallest, std::copysign(std::abs(value), value.real()));
    found.largest = std::max(found.largest, std::copysign(std::abs(value), value.real()));
  }
  return found;
}

Contraction plain_contraction(const Scene& scene, const Points& x, const Eigen::VectorXd& gamma, double h) {
  const Model model = make_model(scene);
  const Rows rows = all_rows(model, x, gamma);
  const Vector root = model.mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd jacobian = rows.jacobian * root.asDiagonal();
  Eigen::MatrixXd hard(model.hard_rows, model.unknowns);
  Eigen::MatrixXd metric = Eigen::MatrixXd::Identity(model.unknowns, model.unknowns);
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& e = model.elements[k];
    const auto own = jacobian.middleRows(rows.first[k], e.rows);
    if (e.hard())
      hard.middleRows(e.first_row, e.rows) = own;
    else
      metric += product(h * h * own.transpose() * e.stiffness, own);
  }
  const Eigen::MatrixXd basis = model.hard_rows > 0
                                    ? null_space(hard, dependent)
                                    : Eigen::MatrixXd::Identity(model.unknowns, model.unknowns);
  if (basis.cols() == 0) return {};
  const Eigen::MatrixXd dropped = h * h * (root.asDiagonal() * rows.geometric * root.asDiagonal());
  const Eigen::MatrixXd left = congruence(metric, basis);
  return extremes(solve_definite(left, congruence(dropped, basis)));
}

RelaxationRates relaxation_rates(const Scene& scene, const Points& x, double h, double omega) {
  const Model model = make_model(scene);
  for (const Element& e : model.elements)
    if (e.kind == Kind::corotational)
      throw SetupError("relaxation_rates", "corotational tetrahedra", "green or linear strain");
  if (model.elements.empty()) throw SetupError("relaxation_rates", "no rows", "a scene with constraints");
  const Rows rows = all_rows(model, x, Vector::Zero(model.hard_rows));
  Eigen::MatrixXd n =
      product_transposed(rows.jacobian * model.mass.cwiseInverse().asDiagonal(), rows.jacobian);
  Eigen::MatrixXd diagonal = Eigen::MatrixXd::Zero(n.rows(), n.cols()), lower = diagonal;
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const int at = rows.first[k], size = model.elements[k].rows;
    if (!model.elements[k].hard())
      n.block(at, at, size, size) += inverse(model.elements[k].stiffness) / (h * h);
    diagonal.block(at, at, size, size) = n.block(at, at, size, size);
    lower.block(at, 0, size, at + size) = n.block(at, 0, size, at + size);
  }
  const Vector scaled = generalised_eigenvalues(n, diagonal);
  const double smallest = scaled.minCoeff(), largest = scaled.maxCoeff();
  RelaxationRates rates;
  rates.jacobi = std::max(std::abs(1 - omega * smallest), std::abs(1 - omega * largest));
  rates.gauss_seidel = eigenvalues(solve(lower, Eigen::MatrixXd(lower - n))).cwiseAbs().maxCoeff();
  rates.condition = smallest > 1e-14 * largest ? largest / smallest : infinity;
  return rates;
}

}  // namespace pbd::reference
