#include "numerics.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_roots.h>

#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

namespace pbd::reference {
namespace {

using Scalar = std::function<double(double)>;

double call(double x, void* f) {
  return (*static_cast<const Scalar*>(f))(x);
}

gsl_function wrap(const Scalar& f) {
  return {&call, const_cast<Scalar*>(&f)};  // NOLINT: GSL's interface has no const
}

/// Throws for an error code, where GSL would abort the program.
void require(int status, const char* what) {
  if (status != GSL_SUCCESS) throw std::runtime_error(std::string(what) + ": " + gsl_strerror(status));
}

/// The right-hand side as GSL calls it, up to a number of evaluations. Exceptions are kept: GSL lets none
/// through.
struct Evaluations {
  const Slope& f;
  const OdeSettings& settings;
  Eigen::VectorXd y, slope;
  long count = 0;
  std::exception_ptr stopped{};

  static int call(double t, const double* y, double* slope, void* data) {
    auto& e = *static_cast<Evaluations*>(data);
    if (++e.count >= e.settings.max_evaluations) return GSL_EBADFUNC;
    if (e.settings.poll) try {
        e.settings.poll();
      } catch (...) {
        e.stopped = std::current_exception();
        return GSL_EBADFUNC;
      }
    e.y = Eigen::Map<const Eigen::VectorXd>(y, e.y.size());
    e.f(t, e.y, e.slope);
    Eigen::Map<Eigen::VectorXd>(slope, e.slope.size()) = e.slope;
    return e.slope.allFinite() ? GSL_SUCCESS : GSL_FAILURE;
  }
};

}  // namespace

double find_root(const Scalar& f, double low, double high) {
  gsl_set_error_handler_off();
  gsl_function wrapped = wrap(f);
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  require(gsl_root_fsolver_set(solver.get(), &wrapped, low, high), "root not bracketed");
  for (int i = 0; i < 200; ++i) {
    require(gsl_root_fsolver_iterate(solver.get()), "root");
    if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver.get()), gsl_root_fsolver_x_upper(solver.get()),
                               0, 1e-15) == GSL_SUCCESS)
      break;
  }
  return gsl_root_fsolver_root(solver.get());
}

double integrate(const Scalar& f, double low, double high) {
  constexpr std::size_t intervals = 1000;
  gsl_set_error_handler_off();
  gsl_function wrapped = wrap(f);
  const std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> workspace(
      gsl_integration_workspace_alloc(intervals), &gsl_integration_workspace_free);
  double result = 0, error = 0;
  require(gsl_integration_qag(&wrapped, low, high, 0, 1e-12, intervals, GSL_INTEG_GAUSS61, workspace.get(),
                              &result, &error),
          "quadrature");
  return result;
}

OdeSolution solve_ode(const Slope& f, Eigen::VectorXd y, const std::vector<double>& times,
                      const OdeSettings& settings) {
  for (std::size_t i = 0; i < times.size(); ++i)
    if (!(times[i] >= (i == 0 ? 0 : times[i - 1])))
      throw std::invalid_argument("ode: times must be >= 0 and increase");
  Evaluations evaluations{f, settings, y, y};
  gsl_set_error_handler_off();
  gsl_odeiv2_system system{&Evaluations::call, nullptr, static_cast<std::size_t>(y.size()), &evaluations};
  const std::unique_ptr<gsl_odeiv2_driver, decltype(&gsl_odeiv2_driver_free)> driver(
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, settings.tolerance,
                                    settings.tolerance),
      &gsl_odeiv2_driver_free);
  OdeSolution solution;
  double t = 0;
  for (const double end : times) {
    const int status = gsl_odeiv2_driver_apply(driver.get(), &t, end, y.data());
    if (evaluations.stopped) std::rethrow_exception(evaluations.stopped);
    if (evaluations.count >= settings.max_evaluations)
      throw OdeFailure("ode: stopped at t = " + std::to_string(t) + " s after " +
                       std::to_string(evaluations.count) + " evaluations");
    if (status != GSL_SUCCESS || !y.allFinite())
      throw OdeFailure("ode: no solution found beyond t = " + std::to_string(t) + " s");
    solution.states.push_back(y);
  }
  solution.evaluations = evaluations.count;
  return solution;
}

}  // namespace pbd::reference
