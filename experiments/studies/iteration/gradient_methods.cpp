#include "studies/iteration/gradient_methods.h"

#include <cmath>
#include <utility>

#include "dense.h"
#include "rows/laws.h"

namespace pbdcheck {

using namespace pbd;
using Eigen::VectorXd;
using reference::ConeProblem;

namespace {

VectorXd mean_diagonal(const ConeProblem& problem) {
  const VectorXd diagonal = problem.delassus.diagonal();
  VectorXd metric(problem.contacts());
  for (int i = 0; i < problem.contacts(); ++i) metric[i] = diagonal.segment<3>(3 * i).mean();
  return metric;
}

VectorXd split_masses(const Rows& rows) {
  std::vector<int> count(rows.inverse_mass.size());
  const auto each_contact = [&](auto&& f) {
    for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
      if constexpr (Block::rows == 3)
        for (std::size_t i = 0; i < block.size(); ++i) f(block, i);
    });
  };
  each_contact([&](const auto& block, std::size_t i) {
    for (const int node : block.node[i]) ++count[static_cast<std::size_t>(node)];
  });
  std::vector<double> metric;
  each_contact([&]<class Block>(const Block& block, std::size_t i) {
    Eigen::MatrixXd split = Eigen::Matrix3d::Zero();
    for (int a = 0; a < Block::nodes; ++a) {
      const auto node = static_cast<std::size_t>(block.node[i][static_cast<std::size_t>(a)]);
      const Eigen::Matrix3d jacobian = block.jacobian[i].template middleCols<3>(3 * a);
      split += count[node] * rows.inverse_mass[node] * jacobian * jacobian.transpose();
    }
    metric.push_back(reference::symmetric_eigen(split).values.maxCoeff());
  });
  return Eigen::Map<VectorXd>(metric.data(), std::ssize(metric));
}

double lipschitz(const ConeProblem& problem, const VectorXd& metric) {
  const VectorXd root = metric.cwiseInverse().cwiseSqrt().transpose().replicate(3, 1).reshaped();
  const Eigen::MatrixXd scaled = root.asDiagonal() * Eigen::MatrixXd(problem.delassus) * root.asDiagonal();
  return reference::symmetric_eigen(scaled).values.maxCoeff();
}

}  // namespace

Metric metric_of(const DualCase& of, const GradientMethod& method) {
  if (method.splits_mass) return {split_masses(of.step.rows), 1};
  const VectorXd mean = mean_diagonal(of.problem);
  constexpr double own = 10;  // the step of power_law is a tenth
  return {mean, method.momentum == Momentum::power_law ? own : lipschitz(of.problem, mean)};
}

DualBound::DualBound(const DualCase& of, const Metric& metric, Order order)
    : order_(order), lipschitz_(metric.lipschitz) {
  const VectorXd squares = of.impulse.reshaped(3, metric.diagonal.size()).colwise().squaredNorm().transpose();
  const double minimum = of.impulse.dot(of.problem.free_velocity + of.velocity) / 2;  // F*, J
  length_ = lipschitz_ * metric.diagonal.dot(squares) / -minimum;
}

double DualBound::after(std::size_t k) const {
  const auto sweep = static_cast<double>(k);
  if (order_ == Order::none) return std::nan("");
  return order_ == Order::first ? length_ / (2 * sweep) : 2 * length_ / ((sweep + 1) * (sweep + 1));
}

double DualBound::worth() const {
  return order_ == Order::first ? length_ / 2 : std::sqrt(2 * length_) - 1;
}

GradientSweeps::GradientSweeps(const ConeProblem& problem, Momentum momentum, Metric metric, int budget)
    : problem_(problem),
      momentum_(momentum),
      metric_(std::move(metric)),
      budget_(budget),
      p_(VectorXd::Zero(3 * problem.contacts())),
      before_(p_) {}

void GradientSweeps::sweep() {
  const VectorXd carried = p_ + m_ * (p_ - before_);
  const VectorXd gradient = problem_.velocity(momentum_ == Momentum::power_law ? p_ : carried);
  VectorXd next(p_.size());
  for (int i = 0; i < problem_.contacts(); ++i)
    next.segment<3>(3 * i) = project_to_cone(
        problem_.friction[i],
        carried.segment<3>(3 * i) - gradient.segment<3>(3 * i) / (metric_.lipschitz * metric_.diagonal[i]));
  before_ = std::exchange(p_, next);
  ++sweep_;
  next_momentum(gradient.dot(p_ - before_) > 0);
}

void GradientSweeps::next_momentum(bool uphill) {
  if (momentum_ == Momentum::none) return;
  if (momentum_ == Momentum::power_law) {
    constexpr double exponent = 0.6;
    m_ = std::pow(sweep_ / (budget_ - 1.0), exponent);
  } else if (momentum_ == Momentum::restarted && uphill) {
    theta_ = 1, m_ = 0;
  } else {
    const double square = theta_ * theta_, next = (std::sqrt(square * square + 4 * square) - square) / 2;
    m_ = theta_ * (1 - theta_) / (square + next);
    theta_ = next;
  }
}

}  // namespace pbdcheck
