#include "nonlinear.h"

#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>
#include <chrono>
#include <cmath>

#include "ipopt_settings.h"
#include "kkt.h"
#include "rigid_nonlinear.h"

namespace pbd::reference {
namespace {

/// The scaled program; entries of the Hessian are the lower triangle of the assembled one.
class Program : public Ipopt::TNLP {
 public:
  Program(Objective objective, const Vector& start)
      : objective_(std::move(objective)), assembly_(*objective_.model), start_(start) {
    const Model& model = *objective_.model;
    const double mass = model.mass.mean(), per_time = (objective_.inertia.cwiseQuotient(model.mass)).mean();
    displacement_ = std::max(
        (objective_.target - start + model.force.cwiseQuotient(objective_.inertia)).cwiseAbs().maxCoeff(),
        1e-12);
    unknown_scale_ = displacement_ * (mass * model.mass.cwiseInverse()).cwiseSqrt();
    objective_scale_ = 1 / (mass * displacement_ * displacement_ * per_time);
    const Derivatives& d = assembly_.at(objective_.positions(start), {});
    row_scale_ = inverse_effective_mass(model, d.jacobian).unaryExpr([&](double n) {
      return n > 0 ? 1 / (std::sqrt(n * mass) * displacement_) : 1.0;
    });
    origin_ = objective_.value(start, {});
    jacobian_entries_ = static_cast<int>(d.jacobian.nonZeros());
    each_lower(d.hessian, [&](int, int, double) { ++hessian_entries_; });
    u = start;
    gamma.setZero(model.hard_rows);
  }

  Vector u, gamma;  // the solution, m and N
  double displacement() const { return displacement_; }

  /// Rounding error of the scaled gradient at the start: the unit roundoff times |H| |u|, at least 1e-12.
  double tolerance() {
    SparseMatrix h = assembly_.at(objective_.positions(start_), {}).hessian;
    h.diagonal() += objective_.inertia;
    const Vector forces = h.cwiseAbs() * start_.cwiseAbs();
    const double rounding = objective_scale_ * forces.cwiseProduct(unknown_scale_).maxCoeff() *
                            std::numeric_limits<double>::epsilon();
    return std::max(1e-12, 4 * rounding);
  }
  const Objective& objective() const { return objective_; }
  const Derivatives& derivatives() { return assembly_.at(objective_.positions(u), {gamma, {}}); }

  bool get_nlp_info(int& n, int& m, int& jacobian_entries, int& hessian_entries,
                    IndexStyleEnum& style) override {
    n = objective_.model->unknowns;
    m = objective_.model->hard_rows;
    jacobian_entries = jacobian_entries_;
    hessian_entries = hessian_entries_;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(int n, double* lower, double* upper, int m, double* row_lower,
                       double* row_upper) override {
    std::fill_n(lower, n, -1e20), std::fill_n(upper, n, 1e20);
    std::fill_n(row_lower, m, 0), std::fill_n(row_upper, m, 0);
    return true;
  }
  bool get_starting_point(int n, bool, double* z, bool, double*, double*, int m, bool needed,
                          double* y) override {
    std::fill_n(z, n, 0);
    if (needed) std::fill_n(y, m, 0);
    return true;
  }
  bool eval_f(int, const double* z, bool, double& value) override {
    value = objective_scale_ * (objective_.value(unknowns(z), {}) - origin_);
    return std::isfinite(value);
  }
  bool eval_grad_f(int n, const double* z, bool, double* gradient) override {
    const Vector at = unknowns(z);
    const Vector g = objective_.gradient(at, assembly_.at(objective_.positions(at), {}));
    Eigen::Map<Vector>(gradient, n) = objective_scale_ * unknown_scale_.cwiseProduct(g);
    return true;
  }
  bool eval_g(int, const double* z, bool, int m, double* rows) override {
    const Points x = objective_.positions(unknowns(z));
    for (const Element& e : objective_.model->elements)
      if (e.hard()) Eigen::Map<Vector>(rows, m).segment(e.first_row, e.rows) = constraint_value(e, x);
    Eigen::Map<Vector>(rows, m).array() *= row_scale_.array();
    return true;
  }
  bool eval_jac_g(int, const double* z, bool, int, int, int* row, int* column, double* values) override {
    const SparseMatrix& j = assembly_.at(objective_.positions(z ? unknowns(z) : start_), {}).jacobian;
    int entry = 0;
    for (int k = 0; k < j.outerSize(); ++k)
      for (SparseMatrix::InnerIterator it(j, k); it; ++it, ++entry) {
        if (values)
          values[entry] = row_scale_(it.row()) * it.value() * unknown_scale_(k);
        else
          row[entry] = static_cast<int>(it.row()), column[entry] = k;
      }
    return true;
  }
  bool eval_h(int, const double* z, bool, double factor, int m, const double* y, bool, int, int* row,
              int* column, double* values) override {
    int entry = 0;
    if (!values) {
      each_lower(assembly_.at(objective_.positions(start_), {}).hessian,
                 [&](int i, int j, double) { row[entry] = i, column[entry++] = j; });
      return true;
    }
    const Points x = objective_.positions(unknowns(z));
    SparseMatrix h = assembly_.at(x, {}).hessian;
    h.diagonal() += objective_.inertia;
    // Hessian of y.c: the constraints' share of L with gamma = -y.
    const Vector multiplier = -Eigen::Map<const Vector>(y, m).cwiseProduct(row_scale_);
    SparseMatrix constraints = assembly_.at(x, {multiplier, {}}).hessian;
    constraints -= assembly_.at(x, {}).hessian;
    h = factor * objective_scale_ * h + constraints;
    each_lower(h,
               [&](int i, int j, double v) { values[entry++] = v * unknown_scale_(i) * unknown_scale_(j); });
    return true;
  }
  void finalize_solution(Ipopt::SolverReturn, int n, const double* z, const double*, const double*, int m,
                         const double*, const double* y, double, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    u = unknowns(z);
    gamma = -Eigen::Map<const Vector>(y, m).cwiseProduct(row_scale_) / objective_scale_;
    static_cast<void>(n);
  }

 private:
  Vector unknowns(const double* z) const {
    return start_ + unknown_scale_.cwiseProduct(Eigen::Map<const Vector>(z, start_.size()));
  }
  template <class Use>
  static void each_lower(const SparseMatrix& h, const Use& use) {
    for (int j = 0; j < h.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(h, j); it; ++it)
        if (it.row() >= j) use(static_cast<int>(it.row()), j, it.value());
  }

  Objective objective_;
  Assembly assembly_;
  Vector start_, unknown_scale_, row_scale_;
  double displacement_ = 1, objective_scale_ = 1, origin_ = 0;
  int jacobian_entries_ = 0, hessian_entries_ = 0;
};

}  // namespace

Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt_application(double tolerance) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> app = IpoptApplicationFactory();
  const auto& options = app->Options();
  for (const char* name : {"tol", "dual_inf_tol", "compl_inf_tol", "constr_viol_tol"})
    options->SetNumericValue(name, tolerance);
  options->SetIntegerValue("acceptable_iter", 0);
  options->SetNumericValue("bound_relax_factor", 0);
  options->SetStringValue("nlp_scaling_method", "none");
  options->SetStringValue("sb", "yes");
  options->SetIntegerValue("print_level", 0);
  options->SetIntegerValue("max_iter", 500);
  return app;
}

Judgement ipopt(const Scene& scene, const State& state, double h) {
  if (!scene.bodies.empty()) return rigid_ipopt(scene, state, h);
  const auto begin = std::chrono::steady_clock::now();
  const Model model = make_model(scene);
  const Points target = state.x + h * state.v;
  const Ipopt::SmartPtr<Program> program =
      new Program({&model, model.mass / (h * h), gather(model, target), target}, gather(model, state.x));
  const auto app = ipopt_application(program->tolerance());
  Judgement j;
  if (app->Initialize() != Ipopt::Solve_Succeeded) {
    j.reason = "Ipopt refused its options";
    return j;
  }
  const auto status = app->OptimizeTNLP(GetRawPtr(program));
  j.outcome = status == Ipopt::Solve_Succeeded               ? Outcome::ok
              : status == Ipopt::Infeasible_Problem_Detected ? Outcome::infeasible
                                                             : Outcome::not_converged;
  if (j.outcome != Outcome::ok) j.reason = "Ipopt ended with status " + std::to_string(status);
  if (IsValid(app->Statistics())) j.iterations = app->Statistics()->IterationCount();
  j.x = program->objective().positions(program->u);
  j.v = (j.x - state.x) / h;
  for (std::size_t a = 0; a < scene.mass.size(); ++a)
    if (model.first[a] < 0) j.v.col(a) = state.v.col(a);
  j.multiplier = program->gamma;
  measure(program->objective(), program->derivatives(), program->u, program->displacement(), j);
  j.rank = -1;
  j.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return j;
}

}  // namespace pbd::reference
