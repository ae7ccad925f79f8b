// Uniform strain of elastic solids: patch tests, stresses of St Venant-Kirchhoff's material.
#include "ledger/solids.h"

#include <cmath>

#include <fmt/format.h>

#include "closed_form.h"
#include "ledger/families.h"
#include "linear_fem.h"

namespace pbdcheck::ledger {

using namespace pbd;

Scene unit_cube(int cells, const Material& material, Strain strain) {
  Scene scene;
  add_solid(scene, kuhn_grid({cells, cells, cells}, Vec3::Ones()), 1000, material, strain);
  return scene;
}

Vec3 held_force(const Method& method, const Material& material, const Eigen::Matrix3d& f,
                const std::function<bool(const Vec3&)>& chosen) {
  Scene scene = unit_cube(1, material, Strain::green);
  const Points rest = scene.initial.x;
  scene.initial.x = (f * rest).eval();
  scene.effects.emplace_back(Gravity{});  // along z, so that the step has a scale
  Anchor anchors;
  for (int node = 0; node < scene.nodes(); ++node) {
    anchors.node.push_back(node);
    anchors.target.emplace_back(scene.initial.x.col(node));
    anchors.compliance.push_back(0);
  }
  scene.effects.emplace_back(std::move(anchors));
  Motion motion(scene, method);
  motion.advance(0.01);
  const auto forces = motion.workspace.forces(2);
  Vec3 sum = Vec3::Zero();
  for (int node = 0; node < scene.nodes(); ++node)
    if (chosen(rest.col(node))) sum += Eigen::Map<const Vec3>(forces.data() + 3 * node);
  return sum;
}

namespace {

constexpr Material rubber{1e6, 0.3};

/// `direct` by a tolerance that rounding does not reach where stresses are large.
Method stress_method(double tolerance) {
  Method method = direct_method();
  method.tolerance = tolerance;
  return method;
}

constexpr double large_h = 0.1;  // s: the slowest mode, 100 rad/s, keeps a tenth a step

// ---- patch test

/// Largest distance of inner nodes from the affine map that the boundary is held at, from a start beside it.
double patch_error(const Method& method, Strain strain, const Eigen::Matrix3d& gradient) {
  constexpr int cells = 3;
  Scene scene = unit_cube(cells, rubber, strain);
  const Points rest = scene.initial.x, exact = gradient * rest;
  scene.initial.x = exact;
  for (int node = 0; node < scene.nodes(); ++node) {
    const Vec3 x = rest.col(node);
    const bool outside = x.minCoeff() < 1e-9 || x.maxCoeff() > 1 - 1e-9;
    if (outside)
      scene.mass[static_cast<std::size_t>(node)] = infinity;
    else
      scene.initial.x.col(node) +=
          0.02 * Vec3(std::sin(7.0 * node), std::sin(8.0 * node), std::sin(9.0 * node));
  }
  // Nothing else moves at the end: a particle under a force beside it gives the steps their scale.
  const int beside = add_node(scene, Vec3::Zero(), 1);
  scene.effects.emplace_back(ExternalForce{{beside}, {Vec3(100, 0, 0)}});
  Motion motion(scene, method);
  motion.advance(large_h, 40);
  return (motion.state.x.leftCols(beside) - exact).colwise().norm().maxCoeff();
}

void patch_rows(Ledger& rows) {
  for (const Strain strain : {Strain::linear, Strain::green, Strain::corotational}) {
    const std::string name(strain_names[static_cast<std::size_t>(strain)]);
    rows.push_back(
        {.id = "solid.patch_" + name,
         .statement = "inner nodes follow the boundary's affine map, for all six strains",
         .quantity = "largest distance from it",
         .unit = "m",
         .formula = "0",
         .source = "hughes2000finite",
         .scene = fmt::format("unit cube of 27 bricks, {}, boundary strained by 5 %", name),
         .method = stress_method(1e-10),
         .bound = {.absolute = 1e-7, .derivation = "exact for linear elements; tolerance 1e-10"},
         .expected = [] { return 0.0; },
         .run =
             [strain](const Method& method) {
               double worst = 0;
               for (const auto& [i, j] : {std::pair{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}) {
                 Eigen::Matrix3d gradient = Eigen::Matrix3d::Identity();
                 gradient(i, j) += 0.05;
                 worst = larger(worst, patch_error(method, strain, gradient));
               }
               return worst;
             }});
  }
}

// ---- stresses

const LedgerBound stress_bound{
    .absolute = 1e-3, .relative = 1e-9, .derivation = "exact for uniform strain; 1e-9 of Young's modulus"};

void uniaxial_rows(Ledger& rows) {
  for (const double stretch : {0.5, 0.8, 1.2, 1.5, 2.0}) {
    rows.push_back({.id = fmt::format("solid.kirchhoff_{:g}", stretch),
                    .statement = "a bar of St Venant-Kirchhoff's material carries a cubic of its stretch",
                    .quantity = "nominal stress",
                    .unit = "Pa",
                    .formula = "E l (l^2 - 1)/2",
                    .source = "bathe2014finite",
                    .scene = fmt::format("unit cube, E = 1e6 Pa, nu = 0.3, held at stretch {:g}", stretch),
                    .method = direct_method(),
                    .bound = stress_bound,
                    .expected = [=] { return reference::kirchhoff_uniaxial_stress(rubber.young, stretch); },
                    .run =
                        [=](const Method& method) {
                          const double across = reference::kirchhoff_lateral_stretch(rubber.poisson, stretch);
                          return held_force(method, rubber, Vec3(stretch, across, across).asDiagonal(),
                                            [](const Vec3& x) { return x.x() > 0.5; })
                              .x();
                        }});
  }
}

/// The cube pulled by the dead loads of a nominal stress on its faces x = 0 and x = 1, raised in steps: let
/// go at once it would overshoot.
State pulled(const Method& method, double stress) {
  Scene scene = unit_cube(2, rubber, Strain::green);
  const TetMesh mesh = kuhn_grid({2, 2, 2}, Vec3::Ones());
  const auto end = [](const Vec3& x) { return x.x() > 1 - 1e-9; };
  const auto begin = [](const Vec3& x) { return x.x() < 1e-9; };
  const Points loads = reference::face_loads(mesh, end, Vec3(stress, 0, 0)) +
                       reference::face_loads(mesh, begin, Vec3(-stress, 0, 0));
  constexpr int raises = 20;
  scene.effects.emplace_back(nodal_force(loads / raises));
  Motion motion(scene, method);
  for (int k = 1; k <= raises; ++k) {
    motion.workspace.change(1, nodal_force(loads * k / raises));
    motion.advance(large_h, 3);
  }
  return equilibrium(motion, large_h);
}

/// Length of the cube's edge from the origin along an axis: turned about the pull, which nothing resists, it
/// stays as long.
double edge_length(const State& state, int axis) {
  const TetMesh mesh = kuhn_grid({2, 2, 2}, Vec3::Ones());
  const auto node_at = [&](const Vec3& corner) {
    Eigen::Index node = 0;
    (mesh.x.colwise() - corner).colwise().squaredNorm().minCoeff(&node);
    return node;
  };
  return (state.x.col(node_at(Vec3::Unit(axis))) - state.x.col(node_at(Vec3::Zero()))).norm();
}

void pulled_rows(Ledger& rows) {
  for (const double stretch : {1.2, 1.5})
    for (const int axis : {0, 1})
      rows.push_back(
          {.id = fmt::format("solid.pulled_{}_{:g}", axis == 0 ? "along" : "across", stretch),
           .statement = "a cube that is pulled stretches, and thins, as its stress says",
           .quantity = axis == 0 ? "stretch" : "lateral stretch",
           .unit = "1",
           .formula = axis == 0 ? "P = E l (l^2 - 1)/2" : "sqrt(1 - nu (l^2 - 1))",
           .source = "bathe2014finite",
           .scene = fmt::format("free unit cube, E = 1e6 Pa, nu = 0.3, dead loads of stretch {:g}", stretch),
           .method = stress_method(1e-10),
           .bound = {.relative = 1e-8, .derivation = "exact for uniform strain; tolerance 1e-10"},
           .expected =
               [=] {
                 return axis == 0 ? stretch : reference::kirchhoff_lateral_stretch(rubber.poisson, stretch);
               },
           .run =
               [=](const Method& method) {
                 const double stress = reference::kirchhoff_uniaxial_stress(rubber.young, stretch);
                 return edge_length(pulled(method, stress), axis);
               }});
}

void shear_rows(Ledger& rows) {
  for (const double shear : {0.1, 0.5, 1.0})
    for (const int axis : {0, 1})
      rows.push_back(
          {.id = fmt::format("solid.shear_p{}2_{:g}", axis + 1, shear),
           .statement = "simple shear of St Venant-Kirchhoff's material pushes across, too",
           .quantity = axis == 0 ? "P12" : "P22",
           .unit = "Pa",
           .formula = axis == 0 ? "mu s + (lambda/2 + mu) s^3" : "(lambda/2 + mu) s^2",
           .source = "bathe2014finite",
           .scene = fmt::format("unit cube, E = 1e6 Pa, nu = 0.3, held at shear {:g}", shear),
           .method = direct_method(),
           .bound = stress_bound,
           .expected =
               [=] {
                 const auto stress = reference::kirchhoff_shear(rubber.young, rubber.poisson, shear);
                 return axis == 0 ? stress.p12 : stress.p22;
               },
           .run =
               [=](const Method& method) {
                 Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
                 f(0, 1) = shear;
                 return held_force(method, rubber, f, [](const Vec3& x) { return x.y() > 0.5; })[axis];
               }});
}

}  // namespace

void solids(Ledger& rows) {
  patch_rows(rows);
  uniaxial_rows(rows);
  pulled_rows(rows);
  shear_rows(rows);
}

}  // namespace pbdcheck::ledger
