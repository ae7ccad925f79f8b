#include "linear/linear_solver.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "dense.h"
#include "effects/sources.h"
#include "scenes.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;

namespace {

/// Linear rows of a scene at rest with a planted solution: random impulses, and the biases that make them
/// exact.
struct Planted {
  Rows rows;
  Points v_free, v_exact;

  explicit Planted(const Scene& scene, double h = 1.0 / 60) {
    const std::vector<Slot> slots = make_slots(scene, Friction::coulomb, false, rows);
    const StepMap map{scene.initial.x, scene.initial.v, h, h, h};
    v_free = Points::Zero(3, scene.nodes());
    const std::vector<Pose> no_bodies;
    const Configuration at{scene.initial.x, no_bodies, 0};
    RowResidual unused;
    for (const Slot& slot : slots)
      slot.source->linearise({map, at, nullptr, scene.initial.v, rows.inverse_mass, 1}, slot.blocks(rows),
                             unused);
    for_each_block(rows.blocks, [](auto& block) {
      for (std::size_t i = 0; i < block.size(); ++i)
        for (int r = 0; r < block.rows; ++r)
          block.impulse[i][r] = std::sin(7.0 * static_cast<double>(i) + 3 * r + 1);
    });
    v_exact = v_free;
    apply_impulses(rows, v_exact);
    for_each_block(rows.blocks, [&](auto& block) {
      for (std::size_t i = 0; i < block.size(); ++i) {
        block.bias[i].setZero();
        block.bias[i] = -block.residual(v_exact, i, block.impulse[i]);
      }
      for (auto& impulse : block.impulse) impulse.setZero();
    });
  }
};

/// Error of v against the planted one after each of `sweeps` sweeps.
std::vector<double> errors(Planted problem, std::string_view name, int sweeps) {
  LinearSolver relaxation = make_linear_solver(name);
  Points v = problem.v_free;
  std::vector<double> found;
  std::visit(
      [&](auto& kind) {
        kind.begin(problem.rows, v, true);
        for (int k = 0; k < sweeps; ++k) {
          kind.sweep(problem.rows, v, nullptr);
          found.push_back((v - problem.v_exact).norm() / (problem.v_exact - problem.v_free).norm());
        }
      },
      relaxation);
  return found;
}

/// Contraction per sweep, fitted over the last half of the errors above rounding.
double measured_rate(const std::vector<double>& error) {
  std::size_t last = 0;
  while (last + 1 < error.size() && error[last + 1] > 1e-12) ++last;
  const std::size_t first = last / 2;
  return std::pow(error[last] / error[first], 1.0 / static_cast<double>(last - first));
}

}  // namespace

TEST_CASE("every relaxation finds a planted solution of chains, sheet and solid") {
  Scene scene;
  SECTION("chain") {
    scene = chain(8);
  }
  SECTION("chain with a heavy tip") {
    scene = chain(4, 10);
  }
  SECTION("solid") {
    scene = cantilever(4, {1e5, 0.3}, Strain::green);
  }
  SECTION("sheet with links, strain and bending") {
    const TriangleMesh mesh = grid_sheet({3, 3}, {1, 1});
    const int first = add_sheet_nodes(scene, mesh, 0.2);
    scene.effects.emplace_back(sheet_links(mesh, first, 1e-4));
    scene.effects.emplace_back(sheet_strain(mesh, first, {1e5, 0.3}, 1e-3));
    scene.effects.emplace_back(sheet_bending(mesh, first, 1e2));
    scene.effects.emplace_back(Anchor{.node = {0}, .target = {Vec3::Zero()}, .compliance = {0.0}});
  }
  const Planted problem(scene);
  for (const auto name : general_solver_names()) {
    INFO(name);
    CHECK(errors(problem, name, name == "direct" ? 3 : 20000).back() < 1e-9);
  }
}

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

TEST_CASE("conjugate gradients end after as many sweeps as a chain has links, whatever its masses") {
  const int links = 20;
  const Planted problem(chain(links, GENERATE(1.0, 1e3)));
  CHECK(errors(problem, "conjugate_gradients", links + 2).back() < 1e-8);
  // Before that the error falls by Chebyshev's bound, 2 ((sqrt(kappa) - 1)/(sqrt(kappa) + 1))^k in the norm
  // of N.
  const Planted equal(chain(50, 1, true));
  const double kappa = 1 / std::pow(std::tan(std::numbers::pi / (2 * 51)), 2);
  const auto error = errors(equal, "conjugate_gradients", 30);
  const double bound = 2 * std::sqrt(kappa) * std::pow((std::sqrt(kappa) - 1) / (std::sqrt(kappa) + 1), 30);
  CHECK(error.back() < bound);
}

TEST_CASE("direct solves doubled constraints and gives equal motion") {
  Scene doubled = chain(8);
  doubled.effects.push_back(doubled.effects.back());
  const Planted problem(doubled);
  CHECK(errors(problem, "direct", 4).back() < 1e-11);
}

TEST_CASE("the parts of direct solve bilateral rows alone, each by its own rate") {
  const Planted problem(chain(8, 10));
  CHECK(errors(problem, "ldlt", 3).back() < 1e-9);
  // A proximal shift of 1e-8 of N_ii leaves that share, over the smallest eigenvalue, of the error.
  CHECK(errors(problem, "semismooth_newton", 4).back() < 1e-9);
  CHECK(errors(problem, "augmented_lagrangian", 10).back() < 1e-9);
}

TEST_CASE("direct says which part worked last, and ldlt refuses contact") {
  Method method;
  method.relaxation = "direct";
  const Scene links = chain(4);
  State state = links.initial;
  CHECK(one_step(links, method, 0.01, state).linear_part == "ldlt");
  const Scene resting = pbdcheck::sliding_box(0, 0, 0);  // all contacts press: one step of Newton's solves it
  state = resting.initial;
  CHECK(one_step(resting, method, 0.01, state).linear_part == "semismooth_newton");
  method.relaxation = "ldlt";
  CHECK_THROWS_WITH(Workspace(resting, method), Catch::Contains("relaxation") && Catch::Contains("ldlt"));
}

TEST_CASE("an unknown relaxation is refused with the list") {
  CHECK_THROWS_WITH(make_linear_solver("sor"), Catch::Contains("sor") && Catch::Contains("gauss_seidel"));
}

TEST_CASE("the spectral bound is at most 1.05 times the largest eigenvalue, and bounds it on a chain") {
  const auto largest = [](const Rows& rows, int nodes) {
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(row_count(rows), 3 * nodes);
    Eigen::MatrixXd n = Eigen::MatrixXd::Zero(row_count(rows), row_count(rows)), diagonal = n;
    const auto each = [&](auto&& use) {
      int row = 0;
      for_each_block(rows.blocks, [&](const auto& block) {
        for (std::size_t i = 0; i < block.size(); ++i, row += block.rows) use(block, i, row);
      });
    };
    each([&](const auto& block, std::size_t i, int row) {
      for (int a = 0; a < block.nodes; ++a)
        jacobian.block(row, 3 * block.node[i][static_cast<std::size_t>(a)], block.rows, 3) =
            block.jacobian[i].middleCols(3 * a, 3);
      n.block(row, row, block.rows, block.rows) = block.compliance[i];
    });
    Eigen::VectorXd weights(3 * nodes);
    for (int k = 0; k < weights.size(); ++k) weights[k] = rows.inverse_mass[static_cast<std::size_t>(k / 3)];
    n += jacobian * weights.asDiagonal() * jacobian.transpose();
    each([&](const auto& block, std::size_t, int row) {
      diagonal.block(row, row, block.rows, block.rows) = n.block(row, row, block.rows, block.rows);
    });
    return reference::generalised_eigenvalues(n, diagonal).maxCoeff();
  };
  SECTION("solid: far below the number of elements at a node; a Rayleigh quotient is never too large") {
    const Scene scene = cantilever(4, {1e5, 0.3}, Strain::green);
    const Planted problem(scene);
    SpectralBound bound;
    const double exact = largest(problem.rows, scene.nodes());
    CHECK(bound.update(problem.rows, problem.v_free) <= 1.05 * exact * (1 + 1e-12));
  }
  SECTION("chain: two links at a node, whatever the power iteration says") {
    const Scene scene = chain(50, 1, true);
    const Planted problem(scene);
    SpectralBound bound;
    const double found = bound.update(problem.rows, problem.v_free);
    CHECK(found >= largest(problem.rows, scene.nodes()));
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

TEST_CASE(
    "jacobi solves rows that are there twice, whose largest eigenvalue is exactly the count at a node") {
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

TEST_CASE("a step from a place without extent leaves no solver unable to solve the next") {
  Scene scene;
  for (int k = 0; k < 2; ++k) add_node(scene, Vec3::Zero(), k == 0 ? infinity : 1);
  scene.effects = {Gravity{}, Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {0}}};
  for (const auto relaxation : general_solver_names()) {
    INFO(relaxation);
    Method method;
    method.relaxation = relaxation;
    Workspace workspace(scene, method);
    State state = scene.initial;
    step(workspace, 0.01, state);
    state = scene.initial;
    state.x.col(1) = Vec3(0, 0, -1);
    for (int k = 0; k < 5; ++k) CHECK(step(workspace, 0.01, state).status == Status::ok);
  }
}
