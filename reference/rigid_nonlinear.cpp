#include "rigid_nonlinear.h"

#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>
#include <chrono>
#include <cmath>

#include "ipopt_settings.h"
#include "rigid_equations.h"

namespace pbd::reference {
namespace {

/// The scaled equations as constraints of a program without objective: velocities in units that make
/// momenta, multipliers in units that make impulses alike.
class Feasibility : public Ipopt::TNLP {
 public:
  explicit Feasibility(const RigidStep& step) : step_(step), layout_(step_.model), scale_(layout_.size) {
    const RigidModel& model = step_.model;
    const double h = step_.h;
    const Vector velocity = step_.start_velocity();
    const RigidSystem system = system_at(step_, velocity, Vector::Zero(model.rows()));
    const Vector root = model.inertia.cwiseSqrt();
    // Speed of the free motion, and the mass it is meant for: the unit of impulses over root inertia.
    const Vector gained = h * system.load.cwiseQuotient(model.inertia);
    const double speed = std::max(displacement_of(step_, velocity) / h,
                                  gained.cwiseProduct(model.radius).cwiseAbs().maxCoeff());
    const double mass = model.inertia.cwiseQuotient(model.radius.cwiseAbs2()).mean();
    const double unit = std::sqrt(mass) * speed;
    start_ = Vector::Zero(layout_.size);
    start_.head(model.unknowns) = velocity;
    row_scale_ = Vector::Ones(layout_.size);
    scale_.head(model.unknowns) = unit * root.cwiseInverse();
    row_scale_.head(model.unknowns) = h / unit * root.cwiseInverse();
    const State free = step_.end(velocity);
    for (std::size_t b = 0; b < model.rotors.size(); ++b)
      if (const int at = layout_.quaternion[b]; at >= 0) {
        start_.segment<4>(at) << free.orientation[b].w(), free.orientation[b].vec();
        const double angle = h * scale_.segment<3>(model.rotors[b].unknown).maxCoeff();
        scale_.segment<4>(at).setConstant(angle);
        row_scale_.segment<4>(at).setConstant(1 / angle);
      }
    const SparseMatrix own = scaled(system.jacobian, root.cwiseInverse());
    const Vector lengths =
        (squared_rows(own, Vector::Ones(model.unknowns)) + Vector(system.compliance.diagonal()) / (h * h))
            .unaryExpr([](double n) { return n > 0 ? std::sqrt(n) : 1.0; });
    scale_.tail(model.rows()) = unit / h * lengths.cwiseInverse();
    row_scale_.tail(model.rows()) = lengths.cwiseInverse() / (h * unit);
    z = start_;
    entries_ = static_cast<int>(equations(Vector::Zero(layout_.size)).jacobian.size());
    const Vector reach = system.jacobian.cwiseAbs() * model.radius * free.x.cwiseAbs().maxCoeff();
    // Of quaternions, of order one, and of lengths.
    const int quaternions = layout_.multipliers - model.unknowns;
    const double turns = quaternions > 0 ? row_scale_.segment(model.unknowns, quaternions).maxCoeff() : 0;
    const double gaps = model.rows() > 0 ? reach.cwiseProduct(row_scale_.tail(model.rows())).maxCoeff() : 0;
    rounding_ = std::numeric_limits<double>::epsilon() * std::max(turns, gaps);
  }

  /// Rounding errors of the scaled equations, at least 1e-12.
  double tolerance() const { return std::max(1e-12, 8 * rounding_); }

  Vector z;
  Vector velocity() const { return z.head(step_.model.unknowns); }
  Vector gamma() const { return z.tail(step_.model.rows()); }

  bool get_nlp_info(int& n, int& m, int& jacobian_entries, int& hessian_entries,
                    IndexStyleEnum& style) override {
    n = m = layout_.size;
    jacobian_entries = entries_;
    hessian_entries = 0;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(int n, double* lower, double* upper, int m, double* row_lower,
                       double* row_upper) override {
    std::fill_n(lower, n, -1e20), std::fill_n(upper, n, 1e20);
    std::fill_n(row_lower, m, 0), std::fill_n(row_upper, m, 0);
    return true;
  }
  bool get_starting_point(int n, bool, double* x, bool, double*, double*, int m, bool needed,
                          double* y) override {
    std::fill_n(x, n, 0);
    if (needed) std::fill_n(y, m, 0);
    return true;
  }
  bool eval_f(int, const double*, bool, double& value) override {
    value = 0;
    return true;
  }
  bool eval_grad_f(int n, const double*, bool, double* gradient) override {
    std::fill_n(gradient, n, 0);
    return true;
  }
  bool eval_g(int n, const double* x, bool, int m, double* rows) override {
    Eigen::Map<Vector>(rows, m) = equations(Eigen::Map<const Vector>(x, n)).residual.cwiseProduct(row_scale_);
    return Eigen::Map<Vector>(rows, m).allFinite();
  }
  bool eval_jac_g(int n, const double* x, bool, int, int, int* row, int* column, double* values) override {
    const Equations at = equations(x ? Vector(Eigen::Map<const Vector>(x, n)) : Vector(Vector::Zero(n)));
    int entry = 0;
    for (const auto& t : at.jacobian) {
      if (values)
        values[entry] = row_scale_(t.row()) * t.value() * scale_(t.col());
      else
        row[entry] = t.row(), column[entry] = t.col();
      ++entry;
    }
    return true;
  }
  /// Zero: with as many equations as unknowns it decides nothing.
  bool eval_h(int, const double*, bool, double, int, const double*, bool, int, int*, int*, double*) override {
    return true;
  }
  void finalize_solution(Ipopt::SolverReturn, int n, const double* x, const double*, const double*, int,
                         const double*, const double*, double, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    z = start_ + scale_.cwiseProduct(Eigen::Map<const Vector>(x, n));
  }

 private:
  Equations equations(const Vector& x) const {
    const Vector at = start_ + scale_.cwiseProduct(x);
    return equations_at(step_, layout_, at);
  }

  const RigidStep& step_;
  Layout layout_;
  Vector scale_, row_scale_, start_;
  int entries_ = 0;
  double rounding_ = 0;
};

}  // namespace

Judgement rigid_ipopt(const Scene& scene, const State& state, double h) {
  const auto begin = std::chrono::steady_clock::now();
  const RigidStep step{make_rigid_model(scene), state, h};
  const Ipopt::SmartPtr<Feasibility> program = new Feasibility(step);
  const auto app = ipopt_application(program->tolerance());
  Judgement j;
  if (app->Initialize() != Ipopt::Solve_Succeeded) {
    j.reason = "Ipopt refused its options";
    return j;
  }
  const auto status = app->OptimizeTNLP(GetRawPtr(program));
  j.outcome = status == Ipopt::Solve_Succeeded || status == Ipopt::Feasible_Point_Found ? Outcome::ok
              : status == Ipopt::Infeasible_Problem_Detected                            ? Outcome::infeasible
                                                             : Outcome::not_converged;
  if (j.outcome != Outcome::ok) j.reason = "Ipopt ended with status " + std::to_string(status);
  if (IsValid(app->Statistics())) j.iterations = app->Statistics()->IterationCount();
  report(step, program->velocity(), program->gamma(), j);
  j.rank = -1;
  j.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return j;
}

}  // namespace pbd::reference
