// Block Jacobi, plain and with Nesterov's momentum, and the bound of its step.
#include <catch2/catch.hpp>
#include <numbers>

#include "planted_rows.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;

namespace {

/// Contraction per sweep, fitted over the last half of the errors above rounding.
double measured_rate(const std::vector<double>& error) {
  std::size_t last = 0;
  while (last + 1 < error.size() && error[last + 1] > 1e-12) ++last;
  const std::size_t first = last / 2;
  return std::pow(error[last] / error[first], 1.0 / static_cast<double>(last - first));
}

}  // namespace

TEST_CASE("Jacobi and Gauss-Seidel on a free chain of N links contract by cos(pi/(N+1)) and its square") {
  const int links = GENERATE(10, 20, 50);
  const Planted problem(chain(links, 1, true));
  const double jacobi = std::cos(std::numbers::pi / (links + 1));
  const int sweeps = 12 * links * links;
  // Within 2 % of the decay per sweep, that is of 1 - rate.
  CHECK(1 - measured_rate(errors(problem, "jacobi", sweeps)) == Approx(1 - jacobi).epsilon(0.02));
  CHECK(1 - measured_rate(errors(problem, "gauss_seidel", sweeps)) ==
        Approx(1 - jacobi * jacobi).epsilon(0.02));
}

TEST_CASE("Jacobi does not diverge where the power iteration falls short of the largest eigenvalue") {
  // The top of a sheet's spectrum is crowded; with omega too large its fastest mode grows sweep by sweep.
  Planted problem(pbdcheck::cloth(20, true), 1.0 / 120);
  Jacobi jacobi;
  Points v = problem.v_free;
  jacobi.begin(problem.rows, v, true);
  const double first = jacobi.sweep(problem.rows, v, nullptr).residual;
  double lowest = first, last = first;
  for (int k = 0; k < 30000; ++k) {
    last = jacobi.sweep(problem.rows, v, nullptr).residual;
    lowest = std::min(lowest, last);
  }
  CHECK(last < 0.1 * first);
  CHECK(last <= 1.01 * lowest);
}

TEST_CASE("accelerated Jacobi needs about the square root of Jacobi's sweeps") {
  const int links = 50;
  const Planted problem(chain(links, 1, true));
  const auto sweeps_to = [&](std::string_view name) {
    const auto error = errors(problem, name, 40000);
    return std::find_if(error.begin(), error.end(), [](double e) { return e < 1e-6; }) - error.begin();
  };
  const double kappa = 1 / std::pow(std::tan(std::numbers::pi / (2 * (links + 1))), 2);
  // Nesterov's bound with restart is a few sqrt(kappa) sweeps per factor e (O'Donoghue, Candes 2015: 2 e
  // sqrt(8)/2).
  CHECK(static_cast<double>(sweeps_to("nesterov_jacobi")) < 2 * std::exp(1) * std::sqrt(8 * kappa));
  CHECK(sweeps_to("jacobi") > 10 * sweeps_to("nesterov_jacobi"));
}

TEST_CASE("the spectral bound is at most 1.05 times the largest eigenvalue, and bounds it on a chain") {
  SECTION("solid: far below the number of elements at a node; a Rayleigh quotient is never too large") {
    const Scene scene = cantilever(4, {1e5, 0.3}, Strain::green);
    const Planted problem(scene);
    SpectralBound bound;
    const double exact = spectrum(problem.rows, scene.nodes()).maxCoeff();
    CHECK(bound.update(problem.rows, problem.v_free) <= 1.05 * exact * (1 + 1e-12));
  }
  SECTION("chain: two links at a node, whatever the power iteration says") {
    const Scene scene = chain(50, 1, true);
    const Planted problem(scene);
    SpectralBound bound;
    const double found = bound.update(problem.rows, problem.v_free);
    CHECK(found >= spectrum(problem.rows, scene.nodes()).maxCoeff());
    CHECK(found <= 2);
  }
}

TEST_CASE("Nesterov's momentum survives a linearisation that changes nothing") {
  const Planted problem(chain(50, 1, true));  // two links at a node: the bound, so the step, is 2 throughout
  constexpr int sweeps = 100;
  const auto run = [&](bool again) {
    Rows rows = problem.rows;
    Points v = problem.v_free;
    NesterovJacobi relaxation;
    relaxation.begin(rows, v, true);
    for (int k = 0; k < sweeps; ++k) {
      relaxation.sweep(rows, v, nullptr);
      if (again) relaxation.begin(rows, v, false);
    }
    return v;
  };
  const Points once = run(false);
  CHECK((run(true) - once).norm() < 1e-12 * once.norm());
}

TEST_CASE("jacobi solves rows that are there twice, whose largest eigenvalue is the count at a node") {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3::UnitX(), 1);
  const Distance link{.node = {{0, 1}}, .rest_length = {1}, .compliance = {0}};
  scene.effects = {Gravity{Vec3(9.81, 0, 0)}, link, link};
  Method method;
  method.relaxation = "jacobi";
  method.max_sweeps = 1000;
  State state = scene.initial;
  CHECK(one_step(scene, method, 0.01, state).status == Status::ok);
  CHECK(state.x(0, 1) == Approx(1));
}
