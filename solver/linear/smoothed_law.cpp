#include "linear/smoothed_law.h"

#include <cmath>

namespace pbd {
namespace {

/// max(l, 0), smoothed, and its derivative.
struct Smoothed {
  double value, by_l;

  Smoothed(double l, double e) {
    const double root = std::sqrt(l * l + 4 * e * e);
    value = l > 0 ? (l + root) / 2 : 2 * e * e / (root - l);  // without cancellation
    by_l = value / root;
  }
};

/// Q and its derivative.
void project(const Vec3& x, double e, Vec3& value, Eigen::Matrix3d& by_x) {
  const Eigen::Vector2d tangential = x.tail<2>();
  const double length = tangential.norm();
  const Smoothed low(x[0] - length, e), high(x[0] + length, e);
  const double mean = (low.by_l + high.by_l) / 2, half = (high.by_l - low.by_l) / 2;
  by_x = mean * Eigen::Matrix3d::Identity();
  value = {(low.value + high.value) / 2, 0, 0};
  if (length == 0) return;
  const Eigen::Vector2d along = tangential / length;
  value.tail<2>() = (high.value - low.value) / 2 * along;
  by_x.block<1, 2>(0, 1) = half * along.transpose();
  by_x.block<2, 1>(1, 0) = half * along;
  const double turns = (high.value - low.value) / (2 * length);
  by_x.block<2, 2>(1, 1) = turns * Eigen::Matrix2d::Identity() + (mean - turns) * along * along.transpose();
}

}  // namespace

SmoothedLaw smoothed_law(bool coulomb, double mu, const Eigen::Matrix3d& n, double e, const Vec3& p,
                         const Vec3& r) {
  if (!(mu > 0)) {
    const double root = std::sqrt(n(0, 0) > 0 ? n(0, 0) : n.trace() / 3);  // p root and r/root are in sqrt(J)
    const Smoothed kept(p[0] * root - r[0] / root, e);
    SmoothedLaw law{p * root, root * Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero()};
    law.missed[0] -= kept.value;
    law.by_p(0, 0) -= kept.by_l * root;
    law.by_r(0, 0) = kept.by_l / root;
    return law;
  }
  const double root = std::sqrt((n(0, 0) / (mu * mu) + n(1, 1) + n(2, 2)) / 3);
  const Vec3 to_x(mu * root, root, root), to_z(1 / (mu * root), 1 / root, 1 / root);
  Vec3 z = to_z.cwiseProduct(r);
  Eigen::Matrix3d by_r = to_z.asDiagonal();
  if (coulomb) {
    const double length = std::sqrt(z.tail<2>().squaredNorm() + e * e);
    by_r.block<1, 2>(0, 1) = z.tail<2>().transpose() / (length * root);
    z[0] += length;
  }
  const Vec3 x = to_x.cwiseProduct(p);
  Vec3 kept;
  Eigen::Matrix3d by_x;
  project(x - z, e, kept, by_x);
  return {x - kept, (Eigen::Matrix3d::Identity() - by_x) * to_x.asDiagonal(), by_x * by_r};
}

}  // namespace pbd
