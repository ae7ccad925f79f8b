#include "mass_properties.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <sstream>

#include "error.h"

namespace pbd {
namespace {

constexpr double pi = std::numbers::pi;

MassProperties diagonal(double mass, const Vec3& moments) {
  return {mass, Vec3::Zero(), moments.asDiagonal()};
}

/// The integral of (x - centre)(x - centre)^T over what a surface encloses has no negative eigenvalue.
void require_inside(const Eigen::Matrix3d& second) {
  constexpr double rounding = 1e-9;
  if (!second.allFinite()) return;
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(second, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (least < -rounding * second.cwiseAbs().maxCoeff())
    throw SetupError(
        "surface", "parts that enclose a negative volume",
        "a surface that does not cross itself, all of its parts anticlockwise seen from outside");
}

}  // namespace

MassProperties sphere_properties(double radius, double density) {
  const double mass = density * 4 / 3 * pi * std::pow(radius, 3);
  return diagonal(mass, Vec3::Constant(0.4 * mass * radius * radius));
}

MassProperties box_properties(const Vec3& size, double density) {
  const double mass = density * size.prod();
  const Vec3 squares = size.cwiseAbs2();
  return diagonal(mass, mass / 12 * (Vec3::Constant(squares.sum()) - squares));
}

MassProperties cylinder_properties(double radius, double length, double density) {
  const double mass = density * pi * radius * radius * length;
  const double across = mass * (3 * radius * radius + length * length) / 12;
  return diagonal(mass, {across, across, mass * radius * radius / 2});
}

// Two half spheres of mass m/2 each, whose centre of mass is 3/8 r beyond the cylinder's ends.
MassProperties capsule_properties(double radius, double length, double density) {
  MassProperties whole = cylinder_properties(radius, length, density);
  const double caps = sphere_properties(radius, density).mass;
  const double own = 0.4 * caps * radius * radius;
  const double across = own + caps * (length * length / 4 + 3.0 / 8 * length * radius);
  whole.mass += caps;
  whole.inertia.diagonal() += Vec3(across, across, own);
  return whole;
}

MassProperties surface_properties(const TriangleMesh& surface, double density) {
  require_closed(surface);
  const Vec3 origin = surface.x.rowwise().mean();  // small numbers for a surface far away
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const auto& triangle : surface.triangles) {
    const Vec3 a = surface.x.col(triangle[0]) - origin, b = surface.x.col(triangle[1]) - origin,
               c = surface.x.col(triangle[2]) - origin, sum = a + b + c;
    const double six = a.dot(b.cross(c));
    volume += six / 6;
    first += six / 24 * sum;
    second += six / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (!(volume > 0)) {
    std::ostringstream text;
    text << "volume " << volume << " m^3";
    throw SetupError("surface", text.str(), "a positive volume: triangles anticlockwise seen from outside");
  }
  const Vec3 centre = first / volume;
  second -= volume * centre * centre.transpose();
  require_inside(second);
  return {density * volume, origin + centre,
          density * (second.trace() * Eigen::Matrix3d::Identity() - second)};
}

MassProperties with_mass(MassProperties properties, double mass) {
  properties.inertia *= mass / properties.mass;
  properties.mass = mass;
  return properties;
}

PrincipalInertia principal_inertia(const Eigen::Matrix3d& inertia) {
  constexpr double rounding = 1e-12;
  const Eigen::Matrix3d off = inertia - Eigen::Matrix3d(inertia.diagonal().asDiagonal());
  if (off.cwiseAbs().maxCoeff() <= rounding * inertia.trace())
    return {inertia.diagonal(), Eigen::Quaterniond::Identity()};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(inertia);
  Eigen::Matrix3d axes = eigen.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) *= -1;
  return {eigen.eigenvalues(), Eigen::Quaterniond(axes)};
}

}  // namespace pbd
