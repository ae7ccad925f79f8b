// A cantilever of linear tetrahedra, 1 x 0.1 x 0.1 m, 1e7 Pa, nu = 0.3, 1000 kg/m^3: the solver's equilibria
// and frequencies beside those of the same mesh by other code, and beam theory, which linear tetrahedra miss
// as that code says.
#include <cmath>

#include <fmt/format.h>

#include "closed_form.h"
#include "closed_form_solids.h"
#include "ledger/families.h"
#include "ledger/solids.h"
#include "linear_fem.h"
#include "scenes/standard.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

const Vec3 beam_size(1, 0.1, 0.1);
constexpr Material beam_material{1e7, 0.3};
constexpr double beam_density = 1000;
const reference::Beam beam{1, 0.1, 0.1, 1e7, 0.3, 1000};

reference::LinearSolid judged(int n) {
  return reference::clamped_beam({10 * n, n, n}, beam_size, beam_material, beam_density);
}

Scene solid(int n) {
  Scene scene;
  add_solid(scene, judged(n).mesh, beam_density, beam_material, Strain::linear);
  clamp_smallest_x(scene);
  return scene;
}

bool on_end(const Vec3& x) {
  return x.x() > 1 - 1e-9;
}

Points shear_load(const TetMesh& mesh) {
  return reference::face_loads(mesh, on_end, Vec3(0, 0, 1 / 0.01));
}

/// A torque of 1 N m about the beam's axis, as a uniform circulation's forces on the end face.
Points torsion_load(const TetMesh& mesh) {
  Points loads = reference::face_loads(mesh, on_end, Vec3(1, 0, 0));
  double torque = 0;
  for (int node = 0; node < loads.cols(); ++node) {
    const Vec3 arm = Vec3(mesh.x.col(node)) - Vec3(1, 0.05, 0.05);
    loads.col(node) = loads(0, node) * Vec3::UnitX().cross(arm);
    torque += arm.cross(Vec3(loads.col(node))).x();
  }
  return loads / torque;
}

Points weight_load(const TetMesh& mesh) {
  Scene scene;
  add_solid(scene, mesh, beam_density, beam_material, Strain::linear);
  Points loads = Points::Zero(3, scene.nodes());
  for (int node = 0; node < scene.nodes(); ++node)
    loads(2, node) = scene.mass[static_cast<std::size_t>(node)] * gravity;
  return loads;
}

/// Mean displacement of the end face along the shear load.
double drop(const TetMesh& mesh, const Points& u) {
  return shear_load(mesh).cwiseProduct(u).sum();
}

/// What a load displaces, in itself.
double compliance(const Points& loads, const Points& u) {
  return loads.cwiseProduct(u).sum();
}

struct LoadCase {
  const char *id, *quantity, *unit, *theory, *formula;
  Points (*load)(const TetMesh&);
  double (*beam_theory)();
  double (*measure)(const TetMesh&, const Points&, const Points&);
};

const LoadCase load_cases[]{
    {"tip_force", "displacement of the tip", "m", "Timoshenko's beam", "F L^3/(3 E I) + F L/(kappa G A)",
     shear_load, [] { return reference::tip_deflection(beam, 1, reference::BeamTheory::timoshenko); },
     [](const TetMesh& mesh, const Points&, const Points& u) { return drop(mesh, u); }},
    {"weight", "displacement of the tip", "m", "Timoshenko's beam", "q L^4/(8 E I) + q L^2/(2 kappa G A)",
     weight_load,
     [] { return reference::weight_deflection(beam, gravity, reference::BeamTheory::timoshenko); },
     [](const TetMesh& mesh, const Points&, const Points& u) { return drop(mesh, u); }},
    {"torsion", "angle of the end", "rad", "Saint-Venant's torsion", "T L/(0.1406 G a^4)", torsion_load,
     [] { return reference::square_bar_twist(1, 0.1, beam.young / (2 * (1 + beam.poisson)), 1); },
     [](const TetMesh&, const Points& loads, const Points& u) { return compliance(loads, u); }}};

double by_solver(const Method& method, const LoadCase& each, int n) {
  Scene scene = solid(n);
  const TetMesh mesh = judged(n).mesh;
  const Points loads = each.load(mesh);
  scene.effects.emplace_back(nodal_force(loads));
  return each.measure(mesh, loads, equilibrium(scene, method, static_step).x - mesh.x);
}

double by_judge(const LoadCase& each, int n) {
  const auto body = judged(n);
  const Points loads = each.load(body.mesh);
  return each.measure(body.mesh, loads, reference::linear_static(body, loads));
}

void load_rows(Ledger& rows) {
  const LedgerBound same_mesh{.relative = 1e-7,
                              .derivation = "same mesh: tolerance over the condition of bending"};
  for (const LoadCase& each : load_cases)
    for (const int n : {1, 2, 4}) {
      const LedgerRow row{.quantity = each.quantity,
                          .unit = each.unit,
                          .source = "hughes2000finite",
                          .scene = fmt::format("cantilever of {} x {} x {} bricks, linear", 10 * n, n, n),
                          .method = direct_method(),
                          .bound = same_mesh,
                          .run = [&each, n](const Method& method) { return by_solver(method, each, n); },
                          .tier = n > 2 ? Tier::full : Tier::quick};
      LedgerRow mesh = row, theory = row;
      mesh.id = fmt::format("cantilever.{}_mesh_{}", each.id, n);
      mesh.statement = "a cantilever bends and twists as its mesh says";
      mesh.formula = "K u = F, assembled and solved by other code";
      mesh.expected = [&each, n] { return by_judge(each, n); };
      theory.id = fmt::format("cantilever.{}_{}", each.id, n);
      theory.statement = fmt::format("it approaches {}", each.theory);
      theory.formula = each.formula;
      theory.source = "cowper1966shear";
      theory.expected = each.beam_theory;
      theory.deviation = {"the stiffness of linear tetrahedra on this mesh, which lock in shear",
                          [&each, n] { return by_judge(each, n); }};
      rows.push_back(std::move(mesh));
      rows.push_back(std::move(theory));
    }
}

void mode_rows(Ledger& rows) {
  for (const int n : {1, 2}) {
    const auto lowest = [n] {
      return reference::linear_modes(judged(n), 1, reference::MassMatrix::lumped).at(0);
    };
    const LedgerRow row{
        .quantity = "lowest frequency",
        .unit = "Hz",
        .scene = fmt::format("cantilever of {} x {} x {} bricks, linear, lumped, h = 0.025 s", 10 * n, n, n),
        .method = direct_method(),
        .bound = {.relative = 1e-6,
                  .derivation = "implicit Euler's phase undone; other modes fall to 1e-12 in 30 steps"},
        .run = [n](const Method& method) {
          Scene scene = solid(n);
          // Along the section's diagonal, about which the mesh is symmetric: the mode across it is not
          // excited.
          for (int node = 0; node < scene.nodes(); ++node)
            scene.initial.x.col(node) += 0.1 * std::pow(scene.initial.x(0, node), 2) * Vec3(0, 1, -1);
          const int tip = 10 * n;
          return slowest_frequency(scene, method, 0.025, 30,
                                   [tip](const State& state) { return state.x(1, tip) - state.x(2, tip); });
        }};
    LedgerRow mesh = row, theory = row;
    mesh.id = fmt::format("cantilever.mode_mesh_{}", n);
    mesh.statement = "a cantilever swings as its mesh says";
    mesh.formula = "K u = (2 pi f)^2 M u, assembled and solved by other code";
    mesh.source = "hughes2000finite";
    mesh.expected = lowest;
    theory.id = fmt::format("cantilever.mode_{}", n);
    theory.statement = "it approaches Timoshenko's beam";
    theory.formula = "root of Huang's frequency equation";
    theory.source = "huang1961effect";
    theory.expected = [] { return reference::timoshenko_cantilever_frequency(beam, 1); };
    theory.deviation = {"the stiffness of linear tetrahedra on this mesh, which lock in shear", lowest};
    rows.push_back(std::move(mesh));
    rows.push_back(std::move(theory));
  }
}

}  // namespace

void cantilevers(Ledger& rows) {
  load_rows(rows);
  mode_rows(rows);
}

}  // namespace pbdcheck::ledger
