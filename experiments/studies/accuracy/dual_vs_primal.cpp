// Does the constraint solver, which works on the dual, reach the minimum of the primal incremental potential?
// One step of a falling cantilever against Newton on the energy, for stiffness, strains, meshes, relaxations
// and outer iterations; the floor where incremental multipliers stop, those of XPBD, a rival, too; and vertex
// block descent, a rival that has none.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/files.h"
#include "harness/judges.h"
#include "harness/measure.h"
#include "names.h"
#include "scenes/mesh_file.h"
#include "scenes/standard.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double dual_step_s = 1.0 / 60;

struct Problem : Case {
  std::string mesh;
  std::int64_t elements;
  Material material;
  Strain strain;
};

std::vector<Problem> problems(bool full) {
  const auto beam = [](int cells) { return kuhn_grid({cells, cells / 4, cells / 4}, Vec3(1, 0.25, 0.25)); };
  std::vector<std::pair<std::string, TetMesh>> meshes{
      {"grid n=8", beam(8)},
      {"grid n=12", beam(12)},
      {"beam.msh", read_tet_mesh(scenes_folder() / "meshes/beam.msh")}};
  std::vector<Problem> all;
  for (const auto& [name, mesh] : meshes)
    for (const double young : {1e5, 1e6, 1e7})
      for (const double poisson : {0.3, 0.45})
        for (const Strain strain : {Strain::green, Strain::corotational, Strain::linear}) {
          const bool small = name == "grid n=8" && (poisson == 0.3 || strain == Strain::green);
          const bool sample = young == 1e6 && poisson == 0.3 && strain == Strain::green;
          const Material material{young, poisson};
          if (full || small || sample)
            all.push_back({{fmt::format("cantilever {} {} E={:g} nu={:g}", name,
                                        strain_names[static_cast<std::size_t>(strain)], young, poisson),
                            clamped_solid(mesh, material, strain), dual_step_s, dual_step_s, 10},
                           name,
                           std::ssize(mesh.tets),
                           material,
                           strain});
        }
  return all;
}

struct Solver {
  std::string outer, relaxation;
  int max_outer, max_sweeps;
};

std::vector<Solver> solvers(bool full) {
  const int budget = full ? 1000 : 200;
  constexpr int rival_sweeps = 10000;  // as many as gauss_seidel has in the quick tier
  return {{"plain", "direct", 200, 10},
          {"plain", "gauss_seidel", budget, 50},
          {"plain", "nesterov_jacobi", budget, 50},
          {"plain", "jacobi", budget / 4, 50},
          {"incremental", "direct", 60, 10},
          {"incremental", "gauss_seidel", 20 * budget / 4, 1},
          {"rival", "xpbd", rival_sweeps, 1},
          {"rival", "vbd", rival_sweeps, 1}};
}

/// Leaves those points out that are less than a twentieth of the sweeps behind the last one; the end stays.
void thin(std::vector<TracePoint>& points) {
  std::int64_t next = 0;
  std::erase_if(points, [&](const TracePoint& point) {
    if (point.sweeps < next && &point != &points.back()) return true;
    next = point.sweeps + 1 + point.sweeps / 20;
    return false;
  });
}

/// A step by a solver; of a rival an iteration is a sweep.
Trace trace_of(const Problem& problem, const State& start, const Solver& solver, const Points& exact) {
  constexpr double tolerance = 1e-12;
  if (solver.outer == "rival") {
    const auto& rival = find_named(rivals::rivals(), "rival", solver.relaxation);
    Trace trace = measure_once(problem.scene, start, problem.h, rival, {tolerance, solver.max_outer}, exact);
    for (TracePoint& point : trace.points) point.sweeps = point.outer_iterations;
    thin(trace.points);
    return trace;
  }
  Method method;
  method.outer = solver.outer;
  method.relaxation = solver.relaxation;
  method.tolerance = tolerance;
  method.max_outer = solver.max_outer;
  method.max_sweeps = solver.max_sweeps;
  return measure_once(problem.scene, start, problem.h, method, exact);
}

std::string solver_name(const Solver& solver) {
  return solver.outer + "." + solver.relaxation;
}

}  // namespace

std::vector<Case> dual_vs_primal_cases(bool full) {
  const auto all = problems(full);
  return {all.begin(), all.end()};
}

void dual_vs_primal(Context& context) {
  const auto all = problems(context.full());
  const auto methods = solvers(context.full());
  context.begin(std::ssize(all));
  const std::vector<std::string> columns{"scene",      "elements", "young_pa", "poisson", "strain", "outer",
                                         "relaxation", "sweeps",   "error",    "wall_s",  "status", "reason"};
  Table errors = context.table("errors", columns);
  Table final = context.table("final", columns);
  Worst direct, soft, false_claims;

  for (const auto& problem : all) {
    const State start = start_of(problem);
    const auto exact = truth(problem.scene, start, problem.h);
    for (const auto& solver : methods) {
      const Trace trace = trace_of(problem, start, solver, exact.x);
      const auto status = std::string(status_names[static_cast<std::size_t>(trace.report.status)]);
      const auto write = [&](Table& table, const TracePoint& point) {
        table.row({problem.mesh, problem.elements, problem.material.young, problem.material.poisson,
                   std::string(strain_names[static_cast<std::size_t>(problem.strain)]), solver.outer,
                   solver.relaxation, point.sweeps, point.error, point.wall_s, status,
                   std::string(trace.report.reason)});
      };
      for (const auto& point : trace.points) write(errors, point);
      const TracePoint& last = trace.points.back();
      write(final, last);

      const auto name = solver_name(solver);
      if (name == "plain.direct") direct.add(last.error);
      if ((name == "plain.gauss_seidel" || name == "plain.nesterov_jacobi") && problem.material.young < 5e6)
        soft.add(last.error, name);
      if (trace.report.status == Status::ok) false_claims.add(last.error);
    }
    context.advance(problem.mesh);
  }
  const std::string statement = "the constraint solver reaches the primal solution with plain and ";
  context.verdict(Basis::code, "dual.direct", statement + "direct, all stiffnesses", "largest error",
                  direct.value(), 1e-10);
  context.verdict(Basis::code, "dual.relaxations",
                  statement + "gauss_seidel and nesterov_jacobi, E <= 1e6 Pa",
                  "largest error (" + soft.owner() + ")", soft.value(), 1e-10);
  context.verdict(Basis::code, "dual.no_false_claim",
                  "a step that claims to be solved to 1e-12 is within 1e-9 of the judge",
                  "largest error of status ok", false_claims.value(), 1e-9);
  errors.close();
  final.close();
}

}  // namespace pbdcheck
