#include "passing.h"

#include <gsl/gsl_poly.h>

#include <algorithm>
#include <vector>

#include "placed_surface.h"

namespace pbd::reference {
namespace {

double volume(const Vec3& d, const Vec3& u, const Vec3& v) {
  return d.dot(u.cross(v));
}

/// d . (u x v) of three vectors that change evenly from t = 0 to 1: a cubic in t, whose coefficients begin
/// with the constant one.
std::array<double, 4> volume_of(const std::array<Vec3, 3>& from, const std::array<Vec3, 3>& to) {
  const auto& [d, u, v] = from;
  const Vec3 dd = to[0] - d, du = to[1] - u, dv = to[2] - v;
  return {volume(d, u, v), volume(dd, u, v) + volume(d, du, v) + volume(d, u, dv),
          volume(d, du, dv) + volume(dd, u, dv) + volume(dd, du, v), volume(dd, du, dv)};
}

/// Where a cubic changes its sign between 0 and 1.
std::vector<double> sign_changes(const std::array<double, 4>& c) {
  const auto value = [&](double t) { return gsl_poly_eval(c.data(), 4, t); };
  std::vector<double> stops{0, 1}, found;
  std::array<double, 2> flat{};
  const int count = gsl_poly_solve_quadratic(3 * c[3], 2 * c[2], c[1], flat.data(), flat.data() + 1);
  for (int k = 0; k < count; ++k)
    if (const double t = flat[static_cast<std::size_t>(k)]; t > 0 && t < 1) stops.push_back(t);
  std::sort(stops.begin(), stops.end());
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
    constexpr int halvings = 60;  // beyond the digits of t
    double low = stops[k], high = stops[k + 1];
    const bool below = value(low) < 0;
    if (below == (value(high) < 0)) continue;
    for (int n = 0; n < halvings; ++n) {
      const double middle = (low + high) / 2;
      ((value(middle) < 0) == below ? low : high) = middle;
    }
    found.push_back(high);
  }
  return found;
}

/// Where all are weights of corners.
bool within(const std::array<double, 3>& weight) {
  return *std::min_element(weight.begin(), weight.end()) >= -beyond;
}

/// Of a point in the plane of a face, or two lines in a plane.
bool meet_within(const FeaturePair& pair, const Places& a, const Places& b) {
  std::array<std::array<double, 3>, 2> weight{};
  if (pair.a.count == 1) {
    weigh_plane(b, a[0], weight[1]);
  } else {
    const Vec3 u = a[1] - a[0], v = b[1] - b[0];
    if (u.cross(v).norm() <= parallel * u.norm() * v.norm()) return false;  // and may be far from each other
    weigh_lines(a, b, weight);
  }
  return within(weight[0]) && within(weight[1]);
}

}  // namespace

bool passes_beside(const FeaturePair& pair, const Placement& start, const Placement& at) {
  const auto on_the_way = [&](const ContactFeature& own, double t) {
    Places x;
    for (std::size_t k = 0; k < static_cast<std::size_t>(own.count); ++k)
      x[k] = (1 - t) * placed(own.corner[k], start) + t * placed(own.corner[k], at);
    return x;
  };
  const auto sides = [&](double t) -> std::array<Vec3, 3> {
    const Places a = on_the_way(pair.a, t), b = on_the_way(pair.b, t);
    return {a[0] - b[0], b[1] - b[0], pair.a.count == 2 ? a[1] - a[0] : b[2] - b[0]};
  };
  bool odd = false;
  for (const double t : sign_changes(volume_of(sides(0), sides(1))))
    odd ^= !meet_within(pair, on_the_way(pair.a, t), on_the_way(pair.b, t));
  return odd;
}

}  // namespace pbd::reference
