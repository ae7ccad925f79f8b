// Finite element constraints against a mass-spring network on the same meshes, both against beam theory; the
// mesh's own exact values, which the constraint solver must reproduce whatever the mesh; and what is left of
// the beam's deflection as Poisson's ratio tends to 1/2. E = 1e7 Pa, nu = 0.3 where nothing else is said.
#include <Eigen/Dense>
#include <cmath>

#include "harness/measure.h"
#include "linear_fem.h"
#include "studies/accuracy/spring_network.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double beam_poisson = 0.3;

reference::LinearSolid judged_beam(int n, double poisson) {
  return reference::clamped_beam({10 * n, n, n}, beam_size, {beam_young, poisson}, beam_density);
}

void beam_rows(Table& table, const std::string& model, const BeamMesh& each, const std::string& quantity,
               double value, double mesh_exact, double beam, const Report& report) {
  table.row({model, std::int64_t{each.n}, std::ssize(each.mesh.tets), beam_size.y() / each.n, quantity, value,
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

/// The beam's modes and its lateral contraction, by elements and springs.
void modes_and_contraction(Context& context, Table& table, const BeamMesh& each, const Network& network,
                           const Statics& stretched) {
  const double theory = reference::timoshenko_cantilever_frequency(beam_theory(beam_poisson), 1);
  const FirstMode tets = first_mode(solid_beam(each.mesh, beam_poisson), each.mesh);
  const FirstMode springs = first_mode(spring_beam(each.mesh, network.kappa), each.mesh);
  const double lumped =
      reference::linear_modes(judged_beam(each.n, beam_poisson), 1, reference::MassMatrix::lumped).at(0);
  beam_rows(table, "tet_p1", each, "frequency_hz", tets.frequency, lumped, theory, tets.report);
  beam_rows(table, "springs", each, "frequency_hz", springs.frequency, lumped, theory, springs.report);
  const double lateral = lateral_contraction(each.mesh, beam_size, stretched.displacement);
  const double own = lateral_contraction(
      each.mesh, beam_size, reference::linear_static(judged_beam(each.n, beam_poisson), each.axial));
  beam_rows(table, "tet_p1", each, "poisson", lateral, own, beam_poisson, stretched.report);
  beam_rows(table, "springs", each, "poisson", network.lateral, own, beam_poisson, network.report);
  const std::string id = "mesh.n" + std::to_string(each.n);
  context.verdict(
      Basis::code, id + ".mode",
      "the constraint solver's first frequency is that of the mesh with lumped masses to 6 digits",
      "|value/reference - 1|", std::abs(tets.frequency / lumped - 1), 1e-6);
  context.verdict(Basis::code, id + ".poisson",
                  "a stretched beam of elements narrows as the mesh says to 6 digits",
                  "|value/reference - 1|", std::abs(lateral / own - 1), 1e-6);
}

void beam(Context& context, Table& table) {
  const double beam_compliance =
      reference::tip_deflection(beam_theory(beam_poisson), 1, reference::BeamTheory::timoshenko);
  const double beam_frequency = reference::timoshenko_cantilever_frequency(beam_theory(beam_poisson), 1);
  const double rod_compliance = beam_size.x() / (beam_young * beam_size.y() * beam_size.z());
  for (const auto& stated : stated_values) {
    if (stated.n == 8 && !context.full()) continue;
    const BeamMesh each = beam_mesh(stated.n);
    const auto body = judged_beam(stated.n, beam_poisson);
    const double exact = work_of(each.shear, reference::linear_static(body, each.shear));
    const double axial = work_of(each.axial, reference::linear_static(body, each.axial));
    const double frequency = reference::linear_modes(body, 1, reference::MassMatrix::consistent).at(0);
    const Scene solid = solid_beam(each.mesh, beam_poisson);
    const Statics bent = static_equilibrium(solid, each.shear),
                  stretched = static_equilibrium(solid, each.axial);
    const double deflection = work_of(each.shear, bent.displacement);
    const Network network = fitted_network(each, rod_compliance, beam_compliance);

    beam_rows(table, "tet_p1 reference", each, "compliance_j", exact, exact, beam_compliance, {});
    beam_rows(table, "tet_p1 reference", each, "frequency_hz", frequency, frequency, beam_frequency, {});
    beam_rows(table, "tet_p1", each, "compliance_j", deflection, exact, beam_compliance, bent.report);
    beam_rows(table, "springs", each, "compliance_j", network.shear, exact, beam_compliance, network.report);
    beam_rows(table, "springs", each, "axial_j", network.axial, rod_compliance, rod_compliance,
              network.report);
    beam_rows(table, "tet_p1 reference", each, "axial_j", axial, axial, rod_compliance, {});
    beam_rows(table, "tet_p1", each, "axial_j", work_of(each.axial, stretched.displacement), axial,
              rod_compliance, stretched.report);

    const std::string id = "mesh.n" + std::to_string(stated.n);
    context.verdict(Basis::theory, id + ".compliance",
                    "the reference reproduces the mesh-exact compliance to 6 digits", "|value/stated - 1|",
                    std::abs(exact / stated.compliance - 1), 1e-6);
    context.verdict(Basis::theory, id + ".frequency",
                    "the reference reproduces the mesh-exact first frequency to 6 digits",
                    "|value/stated - 1|", std::abs(frequency / stated.frequency - 1), 1e-6);
    context.verdict(Basis::code, id + ".solver",
                    "the constraint solver's static equilibrium is the mesh-exact one to 6 digits",
                    "|value/reference - 1|", std::abs(deflection / exact - 1), 1e-6);
    if (stated.n <= 2 || context.full()) modes_and_contraction(context, table, each, network, stretched);
    context.advance("beam n=" + std::to_string(stated.n));
  }
}

/// The deflection of linear tetrahedra over that of beam theory, as Poisson's ratio tends to 1/2.
void locking(Context& context) {
  Table table = context.table("locking", {"n", "elements", "poisson", "value", "reference_mesh",
                                          "reference_beam", "error_mesh", "error_beam", "status", "reason"});
  Worst error;
  const std::vector<int> levels = context.full() ? std::vector{1, 2, 4, 8} : std::vector{1, 2, 4};
  for (const int n : levels) {
    const BeamMesh each = beam_mesh(n);
    for (const double poisson : {0.0, 0.3, 0.45, 0.49, 0.499, 0.4999, 0.49999}) {
      const Statics bent = static_equilibrium(solid_beam(each.mesh, poisson), each.shear);
      const double value = work_of(each.shear, bent.displacement);
      const double mesh = work_of(each.shear, reference::linear_static(judged_beam(n, poisson), each.shear));
      const double beam =
          reference::tip_deflection(beam_theory(poisson), 1, reference::BeamTheory::timoshenko);
      const double apart = std::abs(value / mesh - 1);
      error.add(bent.report.status == Status::ok ? apart : std::nan(""));
      table.row({std::int64_t{n}, std::ssize(each.mesh.tets), poisson, value, mesh, beam, apart,
                 std::abs(value / beam - 1),
                 std::string(status_names[static_cast<std::size_t>(bent.report.status)]),
                 std::string(bent.report.reason)});
    }
    context.advance("locking n=" + std::to_string(n));
  }
  table.close();
  context.verdict(Basis::code, "mesh.locking.solver",
                  "up to nu = 0.49999 every step is solved and the equilibrium is the mesh's own to 6 digits",
                  "largest |value/reference - 1|", error.value(), 1e-6);
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
  context.begin(context.full() ? 4 + 4 + 4 : 3 + 3 + 3);
  Table beam_table =
      context.table("beam", {"model", "n", "elements", "h_m", "quantity", "value", "reference_mesh",
                             "reference_beam", "error_mesh", "error_beam", "status", "reason"});
  Table mms = context.table("mms", {"n", "h_m", "error_l2", "error_h1", "order_l2", "order_h1"});
  beam(context, beam_table);
  manufactured(context, mms);
  beam_table.close();
  mms.close();
  locking(context);
}

}  // namespace pbdcheck
