#include "harness/order_fit.h"

#include <algorithm>
#include <cmath>

namespace pbdcheck {

double fitted_order(const std::vector<double>& h, const std::vector<double>& error) {
  double x_mean = 0, y_mean = 0, xx = 0, xy = 0;
  const auto count = static_cast<double>(h.size());
  for (std::size_t k = 0; k < h.size(); ++k) {
    if (!(error[k] > 0) || !std::isfinite(error[k])) return std::nan("");
    x_mean += std::log(h[k]) / count;
    y_mean += std::log(error[k]) / count;
  }
  for (std::size_t k = 0; k < h.size(); ++k) {
    xx += std::pow(std::log(h[k]) - x_mean, 2);
    xy += (std::log(h[k]) - x_mean) * (std::log(error[k]) - y_mean);
  }
  return xx > 0 ? xy / xx : std::nan("");
}

Measured off_linear(std::vector<double> exponents) {
  for (double& exponent : exponents) exponent = std::abs(exponent - 1);
  return Measured(std::move(exponents));
}

std::string_view behaviour_of(const std::vector<double>& error) {
  const bool numbers = std::all_of(error.begin(), error.end(), [](double e) { return std::isfinite(e); });
  if (error.empty() || !numbers || !(error.back() < error.front())) return "diverging";
  const auto rise = std::adjacent_find(error.begin(), error.end(), [](double a, double b) { return b >= a; });
  return rise == error.end() ? "converging" : "oscillating";
}

}  // namespace pbdcheck
