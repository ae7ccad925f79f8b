#include "cone_ipopt.h"

#include <Eigen/Core>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>
#include <chrono>
#include <cmath>

#include "cone_fixed_point.h"
#include "ipopt_settings.h"

namespace pbd::reference {
namespace {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// A form gives, for one contact with unknowns y: r(y), dr/dy, sum_k u_k d2r_k/dy2, and a constraint g(y) >= 0
// with its derivatives. mu = 0 fixes the last two unknowns at 0. A bounded row is its own unknown.

struct PolarTangent {
  static Vector3d impulse(const Vector3d& y, double mu) { return {y(0), mu * y(0) * y(1), mu * y(0) * y(2)}; }
  static Matrix3d derivative(const Vector3d& y, double mu) {
    Matrix3d d;
    d << 1, 0, 0, mu * y(1), mu * y(0), 0, mu * y(2), 0, mu * y(0);
    return d;
  }
  static Matrix3d curvature(const Vector3d& u, double mu) {
    Matrix3d c = Matrix3d::Zero();
    c.block<1, 2>(0, 1) = mu * u.tail<2>().transpose();
    c.block<2, 1>(1, 0) = mu * u.tail<2>();
    return c;
  }
  static double constraint(const Vector3d& y, double) { return 1 - y.tail<2>().squaredNorm(); }
  static Vector3d gradient(const Vector3d& y, double) { return {0, -2 * y(1), -2 * y(2)}; }
  static Matrix3d hessian(const Vector3d&, double) { return Vector3d(0, -2, -2).asDiagonal(); }
};

struct Ratio {
  static Vector3d impulse(const Vector3d& y, double) { return y; }
  static Matrix3d derivative(const Vector3d&, double) { return Matrix3d::Identity(); }
  static Matrix3d curvature(const Vector3d&, double) { return Matrix3d::Zero(); }
  static double constraint(const Vector3d& y, double mu) {
    return mu > 0 ? mu * y(0) - y.tail<2>().squaredNorm() / (mu * y(0)) : 1;
  }
  static Vector3d gradient(const Vector3d& y, double mu) {
    if (mu == 0) return Vector3d::Zero();
    const Vector2d t = y.tail<2>() / y(0);
    return {mu + t.squaredNorm() / mu, -2 * t(0) / mu, -2 * t(1) / mu};
  }
  static Matrix3d hessian(const Vector3d& y, double mu) {
    if (mu == 0) return Matrix3d::Zero();
    const Vector2d t = y.tail<2>() / y(0);
    Matrix3d h;
    h << -t.squaredNorm(), t(0), t(1), t(0), -1, 0, t(1), 0, -1;
    return 2 / (mu * y(0)) * h;
  }
};

/// min 1/2 r.W r + q.r over y.
template <class Form>
class ConeProgram : public Ipopt::TNLP {
 public:
  explicit ConeProgram(const ConeProblem& problem)
      : mu_(problem.friction),
        lower_(problem.lower),
        upper_(problem.upper),
        w_(problem.delassus),
        q_(problem.free_velocity) {}

  VectorXd impulse(const double* y) const {
    VectorXd r = Map<const VectorXd>(y, q_.size());
    for (int i = 0; i < mu_.size(); ++i) r.segment<3>(3 * i) = Form::impulse(contact(y, i), mu_(i));
    return r;
  }
  VectorXd found;  // the impulses

  bool get_nlp_info(int& n, int& m, int& jacobian, int& hessian, IndexStyleEnum& style) override {
    n = static_cast<int>(q_.size());
    m = static_cast<int>(mu_.size());
    jacobian = 3 * m;
    hessian = n * (n + 1) / 2;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(int n, double* lower, double* upper, int m, double* row_lower,
                       double* row_upper) override {
    constexpr double none = 1e20;  // Ipopt's infinity
    for (int k = 0; k < 3 * m; ++k) {
      const bool fixed = k % 3 > 0 && mu_(k / 3) == 0;
      lower[k] = k % 3 == 0 || fixed ? 0 : -none;
      upper[k] = fixed ? 0 : none;
    }
    for (int k = 3 * m; k < n; ++k) {
      lower[k] = std::max(lower_(k - 3 * m), -none);
      upper[k] = std::min(upper_(k - 3 * m), none);
    }
    std::fill_n(row_lower, m, 0), std::fill_n(row_upper, m, none);
    return true;
  }
  bool get_starting_point(int n, bool, double* y, bool, double*, double*, int, bool, double*) override {
    for (int k = 0; k < n; ++k) y[k] = k < 3 * mu_.size() && k % 3 == 0 ? 1 : 0;
    return true;
  }
  bool eval_f(int, const double* y, bool, double& value) override {
    const VectorXd r = impulse(y);
    value = r.dot(w_ * r) / 2 + q_.dot(r);
    return std::isfinite(value);
  }
  bool eval_grad_f(int n, const double* y, bool, double* gradient) override {
    const VectorXd u = w_ * impulse(y) + q_;
    Map<VectorXd>(gradient, n) = u;
    for (int i = 0; i < mu_.size(); ++i)
      Map<Vector3d>(gradient + 3 * i) =
          Form::derivative(contact(y, i), mu_(i)).transpose() * u.segment<3>(3 * i);
    return true;
  }
  bool eval_g(int, const double* y, bool, int m, double* g) override {
    for (int i = 0; i < m; ++i) g[i] = Form::constraint(contact(y, i), mu_(i));
    return Map<VectorXd>(g, m).allFinite();
  }
  bool eval_jac_g(int, const double* y, bool, int m, int, int* row, int* column, double* values) override {
    for (int k = 0; k < 3 * m; ++k)
      if (values)
        values[k] = Form::gradient(contact(y, k / 3), mu_(k / 3))(k % 3);
      else
        row[k] = k / 3, column[k] = k;
    return true;
  }
  bool eval_h(int n, const double* y, bool, double factor, int m, const double* multiplier, bool, int,
              int* row, int* column, double* values) override {
    int entry = 0;
    if (!values) {
      for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j) row[entry] = i, column[entry++] = j;
      return true;
    }
    const VectorXd u = w_ * impulse(y) + q_;
    MatrixXd h = w_;
    for (int i = 0; i < m; ++i) {
      const Matrix3d d = Form::derivative(contact(y, i), mu_(i));
      h.middleRows<3>(3 * i) = d.transpose() * h.middleRows<3>(3 * i).eval();
      h.middleCols<3>(3 * i) = h.middleCols<3>(3 * i).eval() * d;
    }
    h *= factor;
    for (int i = 0; i < m; ++i)
      h.block<3, 3>(3 * i, 3 * i) += factor * Form::curvature(u.segment<3>(3 * i), mu_(i)) +
                                     multiplier[i] * Form::hessian(contact(y, i), mu_(i));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) values[entry++] = h(i, j);
    return h.allFinite();
  }
  void finalize_solution(Ipopt::SolverReturn, int, const double* y, const double*, const double*, int,
                         const double*, const double*, double, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    found = impulse(y);
  }

 private:
  static Vector3d contact(const double* y, int i) { return Map<const Vector3d>(y + 3 * i); }

  VectorXd mu_, lower_, upper_;
  MatrixXd w_;
  VectorXd q_;
};

/// Impulses of the scaled problem, empty if Ipopt gave none. `barrier` is how its parameter falls.
template <class Form>
VectorXd run(const ConeProblem& scaled, const char* barrier, int& iterations) {
  // The error of a contact with r = u = 0 goes as the root of this; below rounding Ipopt ends without
  // success.
  constexpr double complementarity = 1e-16;
  const auto app = ipopt_application(complementarity);
  app->Options()->SetStringValue("mu_strategy", barrier);
  if (app->Initialize() != Ipopt::Solve_Succeeded) return {};
  const Ipopt::SmartPtr<ConeProgram<Form>> program = new ConeProgram<Form>(scaled);
  app->OptimizeTNLP(GetRawPtr(program));
  if (IsValid(app->Statistics())) iterations += app->Statistics()->IterationCount();
  return program->found;
}

/// The law `cone`. Where one form or barrier stops short of the tolerance the next is tried.
ConeSolution minimum(const ConeProblem& problem, double tolerance, ConeWork* work) {
  EquilibratedCone scaled = equilibrate(problem);
  const double size = scaled.problem.free_velocity.cwiseAbs().maxCoeff();
  ConeSolution best;
  best.impulse.setZero(problem.rows());
  if (size > 0) {
    scaled.problem.free_velocity /= size;
    scaled.problem.lower /= size;
    scaled.problem.upper /= size;
    double smallest = infinity;
    for (const char* barrier : {"monotone", "adaptive"})
      for (const auto form : {run<PolarTangent>, run<Ratio>}) {
        if (smallest <= tolerance || (work != nullptr && work->spent())) break;
        const int before = best.iterations;
        const VectorXd found = form(scaled.problem, barrier, best.iterations);
        if (work != nullptr) work->spend(std::pow(problem.rows(), 2), best.iterations - before);
        if (found.size() == 0 || !found.allFinite()) continue;
        const VectorXd impulse = size * scaled.scale.cwiseProduct(found);
        const double residual = measure_cone(problem, FrictionLaw::cone, impulse).residual();
        if (residual < smallest) smallest = residual, best.impulse = impulse;
      }
  }
  certify(problem, FrictionLaw::cone, tolerance, best);
  return best;
}

}  // namespace

ConeSolution cone_ipopt(const ConeProblem& problem, FrictionLaw law, double tolerance, ConeWork* work) {
  const auto begin = std::chrono::steady_clock::now();
  ConeSolution solution;
  if (problem.contacts() > most_ipopt_contacts) {
    solution.impulse.setZero(problem.rows());
    solution.reason = "more than " + std::to_string(most_ipopt_contacts) + " contacts";
    certify(problem, law, tolerance, solution);
  } else if (law == FrictionLaw::cone) {
    solution = minimum(problem, tolerance, work);
  } else {
    solution = coulomb_by_fixed_point(
        problem, tolerance, {[&](const ConeProblem& convex) { return minimum(convex, tolerance, work); }, {}},
        work);
  }
  solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return solution;
}

}  // namespace pbd::reference
