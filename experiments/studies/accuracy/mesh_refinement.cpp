// Finite element constraints against a mass-spring network on the same meshes, both against beam theory; and
// the mesh's own exact values, which the constraint solver must reproduce whatever the mesh. Beam of 1 x 0.1
// x 0.1 m, E = 1e7 Pa, nu = 0.3, rho = 1000 kg/m^3, clamped at x = 0, shear load 1 N on the end face.
#include <Eigen/Dense>
#include <cmath>

#include "closed_form.h"
#include "linear_fem.h"
#include "scenes/standard.h"
#include "step/step.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

const Vec3 size(1, 0.1, 0.1);
const Material beam_material{1e7, 0.3};
constexpr double beam_density = 1000;
const reference::Beam section{size.x(),    size.y(), size.z(), beam_material.young, beam_material.poisson,
                              beam_density};

bool on_end(const Vec3& x) {
  return x.x() > size.x() * (1 - 1e-9);
}

Vec3 traction(const Vec3& direction) {
  return direction / (size.y() * size.z());
}

/// Equilibrium under nodal loads as the end of the motion: implicit Euler multiplies a mode's amplitude by
/// 1/sqrt(1 + (w h)^2) a step, 1/10 or less for the lowest mode here (w > 10 rad/s).
struct Statics {
  double compliance;  // F . u, J
  Report report;
};

Statics static_compliance(Scene scene, const Points& loads) {
  constexpr double h = 1;
  constexpr int steps = 8;  // 1e-8 of the way is left
  ExternalForce effect;
  for (int node = 0; node < scene.nodes(); ++node)
    if (loads.col(node).norm() > 0) {
      effect.node.push_back(node);
      effect.force.emplace_back(loads.col(node));
    }
  scene.effects.emplace_back(std::move(effect));
  Method method;
  method.relaxation = "direct";
  method.tolerance = 1e-12;  // of the step's scale, h f/m, which is far larger than what is left to move
  Workspace workspace(scene, method);
  State state = scene.initial;
  Report report;
  for (int k = 0; k < steps; ++k) report = step(workspace, h, state);
  return {loads.cwiseProduct(state.x - scene.initial.x).sum(), report};
}

Scene solid(const TetMesh& mesh) {
  Scene scene;
  add_solid(scene, mesh, beam_density, beam_material, Strain::linear);
  clamp_smallest_x(scene);
  return scene;
}

/// Links along all edges, stiffness kappa E l_rest, masses of the solid.
Scene springs(const TetMesh& mesh, double kappa) {
  Scene scene = solid(mesh);
  Distance links;
  for (const auto& edge : edges(mesh)) {
    const double length = (mesh.x.col(edge[0]) - mesh.x.col(edge[1])).norm();
    links.node.push_back(edge);
    links.rest_length.push_back(length);
    links.compliance.push_back(1 / (kappa * beam_material.young * length));
  }
  scene.effects = {std::move(links)};
  return scene;
}

struct MeshLevel {
  int n;
  TetMesh mesh;
  Points shear, axial;  // nodal loads of 1 N in all
};

MeshLevel level(int n) {
  TetMesh mesh = kuhn_grid({10 * n, n, n}, size);
  const Points shear = reference::face_loads(mesh, on_end, traction(Vec3::UnitZ()));
  const Points axial = reference::face_loads(mesh, on_end, traction(Vec3::UnitX()));
  return {n, std::move(mesh), shear, axial};
}

/// Loads so small that the network's change of geometry stays below rounding of six digits.
constexpr double small_load = 1e-4;

/// The network's compliances per kappa are proportional to 1/kappa; kappa fits those of rod and beam theory
/// in the least squares of their logarithms, so that neither load case is favoured.
struct Network {
  double axial, shear;  // F . u at 1 N, J, with the fitted kappa
  Report report;
};

Network fitted_network(const MeshLevel& each, double axial_theory, double shear_theory) {
  const Scene unit = springs(each.mesh, 1);
  const Statics axial = static_compliance(unit, small_load * each.axial);
  const Statics shear = static_compliance(unit, small_load * each.shear);
  const double a = axial.compliance / (small_load * small_load);
  const double s = shear.compliance / (small_load * small_load);
  const double kappa = std::sqrt((a / axial_theory) * (s / shear_theory));
  return {a / kappa, s / kappa, shear.report.status == Status::ok ? axial.report : shear.report};
}

void beam_rows(Table& table, const std::string& model, const MeshLevel& each, const std::string& quantity,
               double value, double mesh_exact, double beam, const Report& report) {
  table.row({model, std::int64_t{each.n}, std::ssize(each.mesh.tets), size.y() / each.n, quantity, value,
             mesh_exact, beam, std::abs(value / mesh_exact - 1), std::abs(value / beam - 1),
             std::string(status_names[static_cast<std::size_t>(report.status)]), std::string(report.reason)});
}

/// Mesh-exact values of this beam, computed beforehand by an independent finite element code (7 digits or
/// more).
struct MeshExact {
  int n;
  double compliance, frequency;
};
constexpr MeshExact stated_values[]{{1, 8.843468e-4, 3.02611455},
                                    {2, 2.0305191e-3, 2.08724748},
                                    {4, 3.1730961e-3, 1.74884806},
                                    {8, 3.7473382e-3, 1.64751004}};

void beam(Context& context, Table& table) {
  const double beam_compliance = reference::tip_deflection(section, 1, reference::BeamTheory::timoshenko);
  const double beam_frequency = reference::timoshenko_cantilever_frequency(section, 1);
  const double rod_compliance = size.x() / (beam_material.young * size.y() * size.z());
  for (const auto& stated : stated_values) {
    if (stated.n == 8 && !context.full()) continue;
    const MeshLevel each = level(stated.n);
    const auto body =
        reference::clamped_beam({10 * stated.n, stated.n, stated.n}, size, beam_material, beam_density);
    const Points u = reference::linear_static(body, each.shear);
    const double exact = each.shear.cwiseProduct(u).sum();
    const double frequency = reference::linear_modes(body, 1, reference::MassMatrix::consistent).at(0);
    const Statics pbd = static_compliance(solid(each.mesh), each.shear);
    const Network network = fitted_network(each, rod_compliance, beam_compliance);

    beam_rows(table, "tet_p1 reference", each, "compliance_j", exact, exact, beam_compliance, {});
    beam_rows(table, "tet_p1 reference", each, "frequency_hz", frequency, frequency, beam_frequency, {});
    beam_rows(table, "tet_p1", each, "compliance_j", pbd.compliance, exact, beam_compliance, pbd.report);
    beam_rows(table, "springs", each, "compliance_j", network.shear, exact, beam_compliance, network.report);
    beam_rows(table, "springs", each, "axial_j", network.axial, rod_compliance, rod_compliance,
              network.report);
    const double axial = each.axial.cwiseProduct(reference::linear_static(body, each.axial)).sum();
    const Statics pbd_axial = static_compliance(solid(each.mesh), each.axial);
    beam_rows(table, "tet_p1 reference", each, "axial_j", axial, axial, rod_compliance, {});
    beam_rows(table, "tet_p1", each, "axial_j", pbd_axial.compliance, axial, rod_compliance,
              pbd_axial.report);

    const std::string id = "mesh.n" + std::to_string(stated.n);
    context.verdict(Basis::theory, id + ".compliance",
                    "the reference reproduces the mesh-exact compliance to 6 digits", "|value/stated - 1|",
                    std::abs(exact / stated.compliance - 1), 1e-6);
    context.verdict(Basis::theory, id + ".frequency",
                    "the reference reproduces the mesh-exact first frequency to 6 digits",
                    "|value/stated - 1|", std::abs(frequency / stated.frequency - 1), 1e-6);
    context.verdict(Basis::code, id + ".solver",
                    "the constraint solver's static equilibrium is the mesh-exact one to 6 digits",
                    "|value/reference - 1|", std::abs(pbd.compliance / exact - 1), 1e-6);
    context.advance("beam n=" + std::to_string(stated.n));
  }
}

void manufactured(Context& context, Table& table) {
  std::vector<int> levels{4, 8, 16};
  if (context.full()) levels.push_back(24);
  reference::ManufacturedError coarser{};
  double order_l2 = std::nan(""), order_h1 = std::nan("");
  int previous = 0;
  for (const int n : levels) {
    const auto error = reference::manufactured_cube(n, {1e6, 0.3});
    if (previous > 0) {
      const double ratio = std::log(static_cast<double>(n) / previous);
      order_l2 = std::log(coarser.l2 / error.l2) / ratio;
      order_h1 = std::log(coarser.h1_seminorm / error.h1_seminorm) / ratio;
    }
    table.row({std::int64_t{n}, 1.0 / n, error.l2, error.h1_seminorm, order_l2, order_h1});
    coarser = error;
    previous = n;
    context.advance("manufactured n=" + std::to_string(n));
  }
  context.verdict(Basis::theory, "mesh.mms.l2", "the manufactured solution converges with order 2 in L2",
                  "|order - 2|", std::abs(order_l2 - 2), 0.1);
  context.verdict(Basis::theory, "mesh.mms.h1", "the manufactured solution's gradient converges with order 1",
                  "|order - 1|", std::abs(order_h1 - 1), 0.1);
}

}  // namespace

void mesh_refinement(Context& context) {
  context.begin(context.full() ? 4 + 4 : 3 + 3);
  Table beam_table =
      context.table("beam", {"model", "n", "elements", "h_m", "quantity", "value", "reference_mesh",
                             "reference_beam", "error_mesh", "error_beam", "status", "reason"});
  Table mms = context.table("mms", {"n", "h_m", "error_l2", "error_h1", "order_l2", "order_h1"});
  beam(context, beam_table);
  manufactured(context, mms);
  beam_table.close();
  mms.close();
}

}  // namespace pbdcheck
