// Rates at which relaxations approach the solution of a chain's rows.
#include <cmath>

#include <fmt/format.h>

#include "closed_form.h"
#include "contraction.h"
#include "harness/interrupt.h"
#include "harness/rows_of_step.h"
#include "ledger/families.h"
#include "linear/linear_solver.h"
#include "scenes/standard.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

constexpr double rate_h = 1.0 / 60;  // s; rates of hard chains do not depend on it

/// Sweeps in which the error of the velocities falls to a tenth, from the second to the fourth tenth by what
/// is `expected`: by then the slowest part is left.
double sweeps_per_decade(Scene scene, std::string_view relaxation, double expected) {
  stir(scene);
  const LinearStep step = linear_step(scene, scene.initial, rate_h);
  const Points solved = dense_solution(step);
  Rows rows = step.rows;
  Points v = step.v_free;
  LinearSolver solver = make_linear_solver(relaxation);
  const auto half = static_cast<std::int64_t>(2 * expected);
  double first = 0;
  std::visit(
      [&](auto& any) {
        any.begin(rows, v, true);
        for (std::int64_t k = 0; k < 2 * half; ++k) {
          throw_if_interrupted();
          if (k == half) first = (v - solved).norm();
          any.sweep(rows, v, nullptr);
        }
      },
      solver);
  return static_cast<double>(half) / std::log10(first / (v - solved).norm());
}

LedgerRow rate_row(std::string_view relaxation, const std::string& scene) {
  LedgerRow row{
      .quantity = "sweeps for another digit",
      .unit = "1",
      .scene = scene,
      .bound = {.relative = 1e-3, .derivation = "faster parts fall by four decades or more before"}};
  row.method.relaxation = relaxation;
  return row;
}

void equal_rows(Ledger& rows) {
  for (const std::string_view relaxation : {"jacobi", "gauss_seidel"})
    for (const int n : {10, 20, 50}) {
      LedgerRow row = rate_row(relaxation, fmt::format("free chain of {} links, equal masses", n));
      const bool jacobi = relaxation == "jacobi";
      const auto expected = [n, jacobi] {
        return reference::iterations_per_decade(std::pow(reference::chain_jacobi_radius(n), jacobi ? 1 : 2));
      };
      row.id = fmt::format("rate.{}_{}", relaxation, n);
      row.statement = jacobi ? "Jacobi's error on a chain falls at the radius of its iteration matrix"
                             : "that of Gauss-Seidel at the square of it";
      row.formula = jacobi ? "-1/log10(cos(pi/(n + 1)))" : "-1/log10(cos^2(pi/(n + 1)))";
      row.expected = expected;
      row.run = [=](const Method& method) {
        return sweeps_per_decade(chain(n, 1, true), method.relaxation, expected());
      };
      rows.push_back(std::move(row));
    }
}

void heavy_rows(Ledger& rows) {
  for (const auto& [n, ratio] : {std::pair{10, 1.0}, {10, 100.0}, {20, 100.0}}) {
    LedgerRow row =
        rate_row("gauss_seidel",
                 fmt::format("chain of {} links, fixed at one end, tip {:g} times as heavy", n, ratio));
    const auto expected = [n = n, ratio = ratio] {
      const Scene scene = chain(n, ratio);
      return reference::iterations_per_decade(
          reference::relaxation_rates(scene, scene.initial.x, rate_h, 1).gauss_seidel);
    };
    row.id = fmt::format("rate.heavy_tip_{}_{:g}", n, ratio);
    row.statement = "a heavy tip slows Gauss-Seidel down as its iteration matrix says";
    row.formula = "-1/log10 of the spectral radius of -(L + D)^-1 L^T";
    row.expected = expected;
    row.run = [=, n = n, ratio = ratio](const Method& method) {
      return sweeps_per_decade(chain(n, ratio), method.relaxation, expected());
    };
    rows.push_back(std::move(row));
  }
}

}  // namespace

void rates(Ledger& rows) {
  equal_rows(rows);
  heavy_rows(rows);
}

}  // namespace pbdcheck::ledger
