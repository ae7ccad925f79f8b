#include "linear/smoothed_law.h"

#include <cmath>

namespace pbd {
namespace {

/// max(l, 0), smoothed: (l + root)/2. Its derivative, and what that lacks to 1, are without cancellation.
struct Smoothed {
  double root, value, lacks;  // lacks: (root - l)/2

  Smoothed(double l, double e) : root(std::sqrt(l * l + 4 * e * e)) {
    const double larger = (std::abs(l) + root) / 2, smaller = e * e / larger;
    value = l > 0 ? larger : smaller;
    lacks = l > 0 ? smaller : larger;
  }
};

/// The matrix with the eigenvalue `across` at right angles to the normal and `along`, and `low` and `high` of
/// (1, -+along).
Eigen::Matrix3d spectral(double low, double high, double across, const Eigen::Vector2d& along) {
  const double mean = (low + high) / 2, half = (high - low) / 2;
  Eigen::Matrix3d m;
  m(0, 0) = mean;
  m.block<1, 2>(0, 1) = half * along.transpose();
  m.block<2, 1>(1, 0) = half * along;
  m.block<2, 2>(1, 1) = across * Eigen::Matrix2d::Identity() + (mean - across) * along * along.transpose();
  return m;
}

/// Q, its derivative, and what that lacks to the identity.
struct Projected {
  Vec3 value;
  Eigen::Matrix3d by_x, lacks;

  Projected(const Vec3& x, double e) {
    const double length = x.tail<2>().norm();
    const Eigen::Vector2d along = length > 0 ? Eigen::Vector2d(x.tail<2>() / length) : Eigen::Vector2d(1, 0);
    const Smoothed low(x[0] - length, e), high(x[0] + length, e);
    const double roots = low.root + high.root, turns = (low.value + high.value) / roots;
    value << (low.value + high.value) / 2, turns * x.tail<2>();
    by_x = spectral(low.value / low.root, high.value / high.root, turns, along);
    lacks = spectral(low.lacks / low.root, high.lacks / high.root, (low.lacks + high.lacks) / roots, along);
  }
};

}  // namespace

SmoothedLaw smoothed_law(bool coulomb, double mu, const Eigen::Matrix3d& n, double e, const Vec3& p,
                         const Vec3& r) {
  if (!(mu > 0)) {
    const double root = std::sqrt(n(0, 0) > 0 ? n(0, 0) : n.trace() / 3);  // p root and r/root are in sqrt(J)
    const Smoothed kept(p[0] * root - r[0] / root, e);
    SmoothedLaw law{p * root, root * Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero()};
    law.missed[0] -= kept.value;
    law.by_p(0, 0) = kept.lacks / kept.root * root;
    law.by_r(0, 0) = kept.value / kept.root / root;
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
  const Projected kept(x - z, e);
  return {x - kept.value, kept.lacks * to_x.asDiagonal(), kept.by_x * by_r};
}

}  // namespace pbd
