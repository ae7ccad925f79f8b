#include "linear/linear_solver.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "planted_rows.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("every relaxation finds a planted solution of chains, sheet and solid") {
  Scene scene;
  SECTION("chain") {
    scene = chain(8);
  }
  SECTION("chain with a heavy tip") {
    scene = chain(4, 10);
  }
  SECTION("chain with a link between nodes that are held") {
    scene = chain(8);
    scene.mass[1] = infinity;
    std::get<Distance>(scene.effects.back()).compliance[0] = GENERATE(0.0, 1e-3);
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

// Where limits begin to hold or let go, earlier directions say nothing: a solver that has swept does what a
// fresh one does, bit for bit.
TEST_CASE("conjugate gradients begin anew where a limit holds or lets go") {
  Planted problem(chain(12, 5));
  auto& block = std::get<RowBlock<1, 2>>(problem.rows.blocks.at(0));
  block.bounds.assign(block.size(), {});  // ropes that only push: half of the planted impulses are none
  const auto held = [&](const Points& v) {
    std::vector<bool> found;
    for (std::size_t i = 0; i < block.size(); ++i) {
      const RowBlock<1, 2>::Value change =
          -block.inverse_diagonal[i] * block.residual(v, i, block.impulse[i]);
      found.push_back(block.impulse[i][0] <= 0 && change[0] < 0);
    }
    return found;
  };
  ConjugateGradients used;
  Points v = problem.v_free;
  used.begin(problem.rows, v, true);
  std::vector<bool> last(block.size(), false);
  int changed = 0, gone_on = 0;
  for (int k = 0; k < 60; ++k) {
    const std::vector<bool> now = held(v);
    Planted copy = problem;
    Points fresh_v = v;
    ConjugateGradients fresh;
    fresh.begin(copy.rows, fresh_v, true);
    fresh.sweep(copy.rows, fresh_v, nullptr);
    used.sweep(problem.rows, v, nullptr);
    if (k > 0 && now != last) {
      ++changed;
      CHECK(v == fresh_v);
    } else {
      gone_on += v != fresh_v;
    }
    last = now;
  }
  CHECK(changed > 1);
  CHECK(gone_on > 1);
}

TEST_CASE("direct solves doubled constraints and gives equal motion") {
  Scene doubled = chain(8);
  doubled.effects.push_back(doubled.effects.back());
  const Planted problem(doubled);
  CHECK(errors(problem, "direct", 4).back() < 1e-11);
}

TEST_CASE("the parts of direct solve bilateral rows alone, each by its own rate") {
  constexpr double ratio = 10;  // of masses
  const Scene scene = chain(8, ratio);
  const Planted problem(scene);
  const Eigen::VectorXd eigenvalues = spectrum(problem.rows, scene.nodes());
  const double least = eigenvalues.minCoeff(), condition = eigenvalues.maxCoeff() / least;
  const double rounding =
      static_cast<double>(row_count(problem.rows)) * condition * std::numeric_limits<double>::epsilon();
  // A shift of N by a share of its diagonal D leaves share/(share + least) of the error, in the norm of N:
  // |v|_M for hard rows.
  for (const auto& [name, share] :
       {std::pair{"ldlt", 1e-10}, {"semismooth_newton", 1e-8}, {"augmented_lagrangian", 1e-4}}) {
    INFO(name);
    const std::vector<double> error = errors(problem, name, 3);
    for (std::size_t k = 0; k < error.size(); ++k)
      CHECK(error[k] <= std::sqrt(ratio) * std::pow(share / (share + least), k + 1) + rounding);
  }
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
    CHECK(step(workspace, 0.01, state).status != Status::ok);  // the link has no direction
    state = scene.initial;
    state.x.col(1) = Vec3(0, 0, -1);
    for (int k = 0; k < 5; ++k) CHECK(step(workspace, 0.01, state).status == Status::ok);
  }
}
