// GSL's root, quadrature and ODE solvers behind std::function.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_roots.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "closed_form.h"

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

std::vector<double> solve_ode(const std::function<std::vector<double>(double, const std::vector<double>&)>& f,
                              std::vector<double> y, double end) {
  using Slope = std::function<std::vector<double>(double, const std::vector<double>&)>;
  struct Context {
    const Slope& f;
    std::size_t size;
  } context{f, y.size()};
  const auto evaluate = [](double t, const double* at, double* slope, void* data) {
    const auto& c = *static_cast<Context*>(data);
    const std::vector<double> value = c.f(t, {at, at + c.size});
    std::copy(value.begin(), value.end(), slope);
    return static_cast<int>(GSL_SUCCESS);
  };
  gsl_set_error_handler_off();
  gsl_odeiv2_system system{evaluate, nullptr, y.size(), &context};
  const std::unique_ptr<gsl_odeiv2_driver, decltype(&gsl_odeiv2_driver_free)> driver(
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, 1e-14, 1e-14),
      &gsl_odeiv2_driver_free);
  double t = 0;
  require(gsl_odeiv2_driver_apply(driver.get(), &t, end, y.data()), "ode");
  return y;
}

}  // namespace pbd::reference
