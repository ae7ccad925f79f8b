#include "studies/time/damped_oscillators.h"

#include <cmath>
#include <numbers>

#include "mesh.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double stiffness = spring_stiffness, coefficient = damping_coefficient;
constexpr double amplitude = 0.1;  // of rest lengths, or of rest shapes

constexpr int masses = 10;

double chain_shape(int node) {
  return std::sin(std::numbers::pi * node / (masses + 1));
}

// ---- a regular tetrahedron with corners at distance sqrt(3) r from its centre

constexpr double r = 0.1, ball_density = 1000;  // m, kg/m^3
const Eigen::Matrix<double, 3, 4> corners =
    (Eigen::Matrix<double, 3, 4>() << r, -r, -r, r, r, -r, r, -r, r, r, -r, -r).finished();

/// Displacements a S x for a symmetric S stay of this kind: masses at the corners make sum m x x^T =
/// density V r^2 I, and the energy is V/2 a^2 (S : C S). So w^2 = (S : C S)/(density r^2 |S|^2).
Scene tetrahedron(const Eigen::Matrix3d& shape, const Material& elastic, const Material& damping) {
  Scene scene;
  TetMesh mesh;
  mesh.x = corners;
  mesh.tets = {{0, 1, 2, 3}};
  add_solid(scene, mesh, ball_density, elastic, Strain::corotational);
  std::get<TetStrain>(scene.effects[0]).damping = damping;
  scene.initial.x = (Eigen::Matrix3d::Identity() + amplitude * shape) * corners;
  return scene;
}

double bulk(const Material& m) {
  return m.young / (3 * (1 - 2 * m.poisson));
}
double shear(const Material& m) {
  return m.young / (2 * (1 + m.poisson));
}

/// Ends of frequencies near that of the springs, and damping moduli that are no multiple of the elastic ones.
constexpr Material elastic{300, 0.3}, viscous{4, 0.1};  // Pa, Pa s

}  // namespace

Oscillator damped_springs() {
  Oscillator all{
      "springs", {}, std::sqrt(stiffness), coefficient / stiffness, [](const Scene&, const Points& x) {
        return x(0, 1);
      }};
  add_node(all.scene, Vec3(-1, 0, 0), infinity);
  add_node(all.scene, Vec3(amplitude, 0, 0), 1);
  add_node(all.scene, Vec3(1, 0, 0), infinity);
  all.scene.effects.emplace_back(Distance{.node = {{0, 1}, {1, 2}},
                                          .rest_length = {1, 1},
                                          .compliance = {2 / stiffness, 2 / stiffness},
                                          .damping = {all.retardation, all.retardation}});
  return all;
}

Oscillator damped_chain() {
  const double half_root = std::sin(std::numbers::pi / (2 * (masses + 1)));
  const double compliance = 4 * half_root * half_root / stiffness;
  Oscillator all{
      "chain", {}, std::sqrt(stiffness), coefficient / stiffness, [](const Scene&, const Points& x) {
        double sum = 0;
        for (int node = 1; node <= masses; ++node) sum += chain_shape(node) * (x(0, node) - node);
        return 2 * sum / (masses + 1);
      }};
  Distance links;
  for (int node = 0; node <= masses + 1; ++node) {
    const bool wall = node == 0 || node > masses;
    add_node(all.scene, Vec3(node + amplitude * chain_shape(node), 0, 0), wall ? infinity : 1);
    if (node == 0) continue;
    links.node.push_back({node - 1, node});
    links.rest_length.push_back(1);
    links.compliance.push_back(compliance);
    links.damping.push_back(all.retardation);
  }
  all.scene.effects.emplace_back(std::move(links));
  return all;
}

Oscillator breathing_tetrahedron() {
  return {"tetrahedron, breathing", tetrahedron(Eigen::Matrix3d::Identity(), elastic, viscous),
          std::sqrt(3 * bulk(elastic) / ball_density) / r, bulk(viscous) / bulk(elastic),
          [](const Scene&, const Points& x) { return x.col(0).dot(corners.col(0)) / (3 * r * r) - 1; }};
}

Oscillator shearing_tetrahedron() {
  const Eigen::Matrix3d shape = Vec3(1, -1, 0).asDiagonal();
  return {"tetrahedron, shearing", tetrahedron(shape, elastic, viscous),
          std::sqrt(2 * shear(elastic) / ball_density) / r, shear(viscous) / shear(elastic),
          [](const Scene&, const Points& x) { return x(0, 0) / r - 1; }};
}

}  // namespace pbdcheck
