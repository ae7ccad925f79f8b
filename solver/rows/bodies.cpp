#include "rows/bodies.h"

#include <algorithm>
#include <cmath>

#include "rows/dense.h"
#include "rows/symmetric_eigen.h"

namespace pbd {

Eigen::Matrix3d cross_matrix(const Vec3& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

Eigen::Quaterniond rotation_by(const Vec3& angle) {
  const double half = angle.norm() / 2;
  constexpr double small = 1e-4;  // sin(half)/half = 1 - half^2/6 up to half^4/120
  const double ratio = half > small ? std::sin(half) / half : 1 - half * half / 6;
  const Vec3 vector = ratio / 2 * angle;
  return {std::cos(half), vector.x(), vector.y(), vector.z()};
}

Bodies::Bodies(const Scene& scene) : nodes_(scene.nodes()) {
  for (const RigidBody& body : scene.bodies) {
    const double mass = scene.mass[body.node];
    const bool turns = std::isfinite(body.inertia[0]);
    const double own = std::isfinite(mass) ? mass : 1;
    node_.push_back(body.node);
    radius_.push_back(turns ? Vec3((body.inertia / own).cwiseSqrt()) : Vec3(Vec3::Ones()));
    inverse_mass_.push_back(turns ? 1 / own : 0);
  }
  start_ = scene.initial.orientation;
}

std::vector<double> Bodies::inverse_masses(const Scene& scene) const {
  std::vector<double> inverse;
  for (const double mass : scene.mass) inverse.push_back(std::isfinite(mass) ? 1 / mass : 0.0);
  inverse.insert(inverse.end(), inverse_mass_.begin(), inverse_mass_.end());
  return inverse;
}

void Bodies::begin(const State& state, Points& x, Points& v) {
  if (count() == 0) {
    x = state.x;
    v = state.v;
    return;
  }
  x.setZero(3, columns());
  v.resize(3, columns());
  x.leftCols(nodes_) = state.x;
  v.leftCols(nodes_) = state.v;
  for (int b = 0; b < count(); ++b) v.col(column(b)) = radius_[b].cwiseProduct(state.spin.col(b));
  start_ = state.orientation;
}

void Bodies::end(const Points& x, const Points& v, State& state) const {
  state.x = x.leftCols(nodes_);
  state.v = v.leftCols(nodes_);
  for (int b = 0; b < count(); ++b) {
    state.orientation[b] = (start_[b] * rotation_by(x.col(column(b)).cwiseQuotient(radius_[b]))).normalized();
    state.spin.col(b) = v.col(column(b)).cwiseQuotient(radius_[b]);
  }
}

void Bodies::place(const Points& x, std::vector<Pose>& poses) const {
  poses.resize(radius_.size());
  for (int b = 0; b < count(); ++b) {
    Pose& pose = poses[b];
    pose.x = x.col(node_[b]);
    pose.rotation =
        (start_[b] * rotation_by(x.col(column(b)).cwiseQuotient(radius_[b]))).normalized().toRotationMatrix();
    pose.turn_per_arc = pose.rotation * radius_[b].cwiseInverse().asDiagonal();
  }
}

double Bodies::spin(int body, const Points& v) const {
  return v.col(column(body)).cwiseQuotient(radius_[body]).norm();
}

double Bodies::largest_spin(const Points& v) const {
  double largest = 0;
  for (int b = 0; b < count(); ++b) largest = std::max(largest, spin(b, v));
  return largest;
}

double Bodies::largest_radius() const {
  double largest = 0;
  for (const Vec3& radius : radius_) largest = std::max(largest, radius.maxCoeff());
  return largest;
}

Vec3 Bodies::acceleration(int body, const Vec3& torque, const Pose& pose) const {
  return inverse_mass_[body] * (pose.turn_per_arc.transpose() * torque);
}

namespace {

/// Not of a body that is held, nor of one whose moments are alike: its torque is a difference of equal
/// products.
bool has_gyroscopic(double inverse_mass, const Vec3& radius) {
  return inverse_mass > 0 && !(radius[0] == radius[1] && radius[1] == radius[2]);
}

}  // namespace

// I = m r^2, so that -I^-1 (w x I w) r = -(w x (r eta)) / r.
Vec3 Bodies::gyroscopic(int body, const Vec3& eta) const {
  const Vec3& r = radius_[body];
  if (!has_gyroscopic(inverse_mass_[body], radius_[body])) return Vec3::Zero();
  return -eta.cwiseQuotient(r).cross(r.cwiseProduct(eta)).cwiseQuotient(r);
}

Eigen::Matrix3d Bodies::gyroscopic_gradient(int body, const Vec3& eta) const {
  const Vec3& r = radius_[body];
  if (!has_gyroscopic(inverse_mass_[body], radius_[body])) return Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d by_w = cross_matrix(r.cwiseProduct(eta)) * r.cwiseInverse().asDiagonal();
  const Eigen::Matrix3d by_momentum = cross_matrix(eta.cwiseQuotient(r)) * r.asDiagonal();
  return r.cwiseInverse().asDiagonal() * (by_w - by_momentum);
}

double Bodies::add_gyroscopic(int body, double s, Vec3& eta) const {
  if (!has_gyroscopic(inverse_mass_[body], radius_[body])) return 0;
  constexpr int most = 50;
  constexpr double shortest = 1e-3, solved = 1e-13;  // rounding of the torque's terms
  const Vec3 free = eta;
  const auto missing = [&](const Vec3& at) -> Vec3 { return free + s * gyroscopic(body, at) - at; };
  Vec3 rest = missing(eta);
  for (int k = 0; k < most && rest.norm() > 0; ++k) {
    const Vec3 step = solve(Eigen::Matrix3d::Identity() - s * gyroscopic_gradient(body, eta), rest);
    double share = 1;
    Vec3 next = missing(eta + step);
    while (!(next.norm() < rest.norm()) && share > shortest) {
      share /= 2;
      next = missing(eta + share * step);
    }
    if (!(next.norm() < rest.norm())) break;
    eta += share * step;
    rest = next;
  }
  return rest.norm() <= solved * (1 + s * gyroscopic_gradient(body, eta).norm()) * eta.norm() ? 0
                                                                                              : rest.norm();
}

double Bodies::contraction(const Points& v, double d, double s, bool implicit_gyroscopic) const {
  double bound = 0;
  for (int b = 0; b < count(); ++b) {
    if (inverse_mass_[b] == 0) continue;
    const Vec3 eta = v.col(column(b));
    const Eigen::Matrix3d turned = radius_[b].asDiagonal() * cross_matrix(eta.cwiseQuotient(radius_[b])) *
                                   radius_[b].cwiseInverse().asDiagonal();
    const Eigen::Matrix3d squared = turned.transpose() * turned;
    const double largest = largest_eigenvalue(squared);
    double own = d / 2 * std::sqrt(std::max(0.0, largest));
    if (implicit_gyroscopic) own += s * gyroscopic_gradient(b, eta).norm();
    bound = std::max(bound, own);
  }
  return bound;
}

}  // namespace pbd
