// Steps with a closed form, and agreement of the judges where there is none.
#include "judge.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "closed_form.h"
#include "error.h"
#include "mesh.h"
#include "nonlinear.h"
#include "primal_newton.h"

using namespace pbd;
using namespace pbd::reference;

namespace {

/// Chain of total length 1 m swinging about a fixed node, 0.1 kg a node, the last one `ratio` times as heavy.
Scene swinging_chain(int links, double ratio) {
  const Vec3 along(std::sin(1.0), 0, -std::cos(1.0)), across(std::cos(1.0), 0, std::sin(1.0));
  Scene scene;
  Distance distance;
  add_node(scene, Vec3::Zero(), infinity);
  for (int i = 1; i <= links; ++i) {
    const double s = double(i) / links;
    add_node(scene, s * along, i == links ? 0.1 * ratio : 0.1, 2 * s * across);
    distance.node.push_back({i - 1, i});
    distance.rest_length.push_back(1.0 / links);
    distance.compliance.push_back(0);
  }
  scene.effects = {Gravity{}, distance};
  return scene;
}

Scene cantilever(int n, double young, double poisson, Strain strain) {
  Scene scene;
  add_solid(scene, kuhn_grid({n, n / 4, n / 4}, Vec3(1, 0.25, 0.25)), 1000, {young, poisson}, strain);
  for (int i = 0; i < scene.nodes(); ++i)
    if (scene.initial.x(0, i) == 0) scene.mass[static_cast<std::size_t>(i)] = infinity;
  scene.effects.emplace_back(Gravity{});
  return scene;
}

/// Sheet of n x n cells, saddle-shaped so that hard links are independent, held at two corners.
Scene saddle_cloth(int n, double compliance) {
  TriangleMesh mesh = grid_sheet({n, n}, {1, 1});
  for (int i = 0; i < mesh.x.cols(); ++i)
    mesh.x(2, i) = 0.2 * std::pow(mesh.x(0, i) - 0.5, 2) - 0.3 * std::pow(mesh.x(1, i) - 0.3, 2);
  Scene scene;
  add_sheet_nodes(scene, mesh, 0.2);
  scene.mass[0] = scene.mass[static_cast<std::size_t>(n)] = infinity;
  scene.effects = {Gravity{}, sheet_links(mesh, 0, compliance), sheet_bending(mesh, 0, 100)};
  return scene;
}

double relative(const Points& a, const Points& b, const Points& start) {
  return (a - b).cwiseAbs().maxCoeff() / (a - start).cwiseAbs().maxCoeff();
}

/// Both judges reach a certified minimum and agree to 1e-9 of the step's displacement.
void check_agreement(const Scene& scene, double h) {
  const Judgement newton = primal_newton(scene, scene.initial, h), other = ipopt(scene, scene.initial, h);
  INFO(newton.reason << newton.note << " / " << other.reason);
  REQUIRE(newton.outcome == Outcome::ok);
  REQUIRE(other.outcome == Outcome::ok);
  CHECK(newton.certified);
  CHECK(newton.correction <= 1e-11);
  CHECK(newton.infeasible <= 1e-12);
  CHECK(relative(newton.x, other.x, scene.initial.x) <= 1e-9);
  CHECK(relative(newton.x, scene.initial.x + h * newton.v, scene.initial.x) <= 1e-12);
  if (newton.multiplier.size() > 0)
    CHECK((newton.multiplier - other.multiplier).norm() <= 1e-6 * newton.multiplier.norm());
}

}  // namespace

TEST_CASE("free particles move by gravity and external forces") {
  Scene scene;
  add_node(scene, Vec3(1, 2, 3), 2, Vec3(0.5, 0, 1));
  add_node(scene, Vec3(0, 0, 0), infinity, Vec3(1, 0, 0));
  scene.effects = {Gravity{}, ExternalForce{{0, 0}, {Vec3(4, 0, 0), Vec3(0, 2, 0)}}};
  const double h = 0.1;
  for (const NamedJudge& named : judges()) {
    INFO(named.name);
    const Judgement j = named.judge(scene, scene.initial, h);
    CHECK(j.outcome == Outcome::ok);
    const Vec3 velocity = Vec3(0.5, 0, 1) + h * Vec3(2, 1, -9.81);
    CHECK((j.v.col(0) - velocity).norm() <= 1e-11);
    CHECK((j.x.col(0) - Vec3(1, 2, 3) - h * velocity).norm() <= 1e-12);
    CHECK((j.x.col(1) - Vec3(h, 0, 0)).norm() <= 1e-15);
    CHECK((j.v.col(1) - Vec3(1, 0, 0)).norm() == 0);
  }
}

TEST_CASE("one implicit Euler step of a pendulum projects the free step onto its circle") {
  // M (x - y)/h^2 = gamma x/l is radial, so that x = l y/|y| and gamma = m (l - |y|)/h^2, y the free step.
  const double h = 1.0 / 30, mass = 0.1;
  const Scene scene = swinging_chain(1, 1);
  const Vec3 y = scene.initial.x.col(1) + h * scene.initial.v.col(1) + h * h * Vec3(0, 0, -9.81);
  for (const NamedJudge& named : judges()) {
    INFO(named.name);
    const Judgement j = named.judge(scene, scene.initial, h);
    CHECK((j.x.col(1) - y.normalized()).norm() <= 1e-13);
    CHECK(j.multiplier(0) == Approx(mass * (1 - y.norm()) / (h * h)).epsilon(1e-10));
  }
}

TEST_CASE("one implicit Euler step of a spring pendulum and of a compliant anchor") {
  // Along y: m (r - |y|)/h^2 + (r - l)/A = 0.
  const double h = 1.0 / 30, mass = 0.1, compliance = 1e-3, inertia = mass / (h * h);
  Scene scene = swinging_chain(1, 1);
  const Vec3 y = scene.initial.x.col(1) + h * scene.initial.v.col(1) + h * h * Vec3(0, 0, -9.81);
  std::get<Distance>(scene.effects[1]).compliance[0] = compliance;
  const double r = (inertia * y.norm() + 1 / compliance) / (inertia + 1 / compliance);
  CHECK((primal_newton(scene, scene.initial, h).x.col(1) - r * y.normalized()).norm() <= 1e-13);
  const Vec3 target(0.3, 0.4, 0.5);
  scene.effects[1] = Anchor{{1}, {target}, {compliance}};
  const Vec3 held = (inertia * y + target / compliance) / (inertia + 1 / compliance);
  CHECK((primal_newton(scene, scene.initial, h).x.col(1) - held).norm() <= 1e-13);
}

TEST_CASE("the judges agree on chains") {
  for (const int links : {1, 10, 20, 50, 100})
    for (const double ratio : {1.0, 100.0})
      for (const double h : {1.0 / 30, 1.0 / 240}) check_agreement(swinging_chain(links, ratio), h);
}

TEST_CASE("the judges agree on solids of every strain") {
  for (const Strain strain : {Strain::green, Strain::corotational, Strain::linear})
    for (const int n : {8, 12})
      for (const double young : {1e5, 1e7}) check_agreement(cantilever(n, young, 0.3, strain), 1.0 / 60);
  check_agreement(cantilever(8, 1e6, 0.4999, Strain::green), 1.0 / 60);
}

TEST_CASE("the judges agree on cloth") {
  check_agreement(saddle_cloth(20, 0), 1.0 / 60);
  check_agreement(saddle_cloth(20, 1e-5), 1.0 / 60);
  const TriangleMesh mesh = grid_sheet({8, 8}, {1, 1});
  Scene membrane;
  add_sheet_nodes(membrane, mesh, 0.2);
  membrane.mass[0] = membrane.mass[8] = infinity;
  membrane.effects = {Gravity{}, sheet_strain(mesh, 0, {1e5, 0.3}, 1e-3), sheet_bending(mesh, 0, 100)};
  check_agreement(membrane, 1.0 / 60);
}

TEST_CASE("Newton holds for heavy tips, long and short steps, and through a swing") {
  for (const int links : {20, 100})
    for (const double ratio : {1000.0, 1e4})
      for (const double h : {1.0 / 30, 1.0 / 480}) {
        const Scene scene = swinging_chain(links, ratio);
        const Judgement j = primal_newton(scene, scene.initial, h);
        CHECK(j.outcome == Outcome::ok);
        CHECK(j.certified);
        CHECK(j.residual <= 1e-11);
        CHECK(j.infeasible <= 1e-12);
      }
  const Scene scene = swinging_chain(20, 1000);
  State state = scene.initial;
  for (int frame = 0; frame < 60; ++frame) {
    const Judgement j = primal_newton(scene, state, 1.0 / 60);
    REQUIRE(j.outcome == Outcome::ok);
    REQUIRE(j.certified);
    state.x = j.x, state.v = j.v;
  }
}

TEST_CASE("redundant constraints are found and share the multipliers of single ones") {
  const double h = 1.0 / 60;
  Scene scene = swinging_chain(5, 10);
  const Judgement single = primal_newton(scene, scene.initial, h);
  CHECK(single.rank == 5);
  scene.effects.push_back(scene.effects[1]);
  const Judgement doubled = primal_newton(scene, scene.initial, h);
  REQUIRE(doubled.outcome == Outcome::ok);
  CHECK(doubled.rank == 5);
  CHECK(doubled.note.find("redundant") != std::string::npos);
  CHECK(relative(single.x, doubled.x, scene.initial.x) <= 1e-12);
  for (int i = 0; i < 5; ++i) {
    CHECK(doubled.multiplier(i) == Approx(single.multiplier(i) / 2).epsilon(1e-9));
    CHECK(doubled.multiplier(i + 5) == Approx(single.multiplier(i) / 2).epsilon(1e-9));
  }
  CHECK(relative(ipopt(scene, scene.initial, h).x, single.x, scene.initial.x) <= 1e-9);
}

TEST_CASE("contradictory constraints are not passed off as solved") {
  for (const double factor : {1.1, 1 + 1e-6}) {
    Scene scene = swinging_chain(2, 1);
    Distance longer = std::get<Distance>(scene.effects[1]);
    longer.rest_length[1] *= factor;
    scene.effects.emplace_back(longer);
    for (const NamedJudge& named : judges()) {
      INFO(named.name << " " << factor);
      const Judgement j = named.judge(scene, scene.initial, 1.0 / 60);
      CHECK(j.outcome != Outcome::ok);
      CHECK_FALSE(j.reason.empty());
    }
  }
}

TEST_CASE("an affine map of the boundary is followed by the interior") {
  Eigen::Matrix3d f;
  f << 1.1, 0.2, -0.1, 0.05, 0.9, 0.3, 0.1, -0.2, 1.2;
  for (const Strain strain : {Strain::green, Strain::corotational, Strain::linear}) {
    TetMesh mesh = kuhn_grid({3, 3, 3}, Vec3::Ones());
    for (int i = 0; i < mesh.x.cols(); ++i) {
      const Vec3 x = mesh.x.col(i);
      if (x.minCoeff() > 0 && x.maxCoeff() < 1)
        mesh.x.col(i) += 0.05 * Vec3(std::sin(9 * i), std::cos(7 * i), std::sin(5 * i));
    }
    Scene scene;
    add_solid(scene, mesh, 1000, {1e6, 0.3}, strain);
    const Points rest = scene.initial.x;
    for (int i = 0; i < scene.nodes(); ++i) {
      if (rest.col(i).minCoeff() > 1e-9 && rest.col(i).maxCoeff() < 1 - 1e-9) continue;
      scene.mass[static_cast<std::size_t>(i)] = infinity;
      scene.initial.x.col(i) = f * rest.col(i);
    }
    const Judgement j = primal_static(scene);
    INFO(strain_names[static_cast<std::size_t>(strain)] << " " << j.reason);
    CHECK(j.outcome == Outcome::ok);
    CHECK((j.x - f * rest).cwiseAbs().maxCoeff() <= 1e-12);
  }
}

TEST_CASE("a chain of hard links hangs as the discrete catenary") {
  for (const int links : {10, 20, 40}) {
    const double length = 1.5 / links;
    Scene scene;
    Distance distance;
    // Starts as a triangle: two straight halves from support to support.
    for (int i = 0; i <= links; ++i) {
      const double s = double(i) / links, depth = std::sqrt(0.75 * 0.75 - 0.25);
      add_node(scene, Vec3(s, 0, -depth * (1 - std::abs(2 * s - 1))), i == 0 || i == links ? infinity : 0.1);
      if (i > 0)
        distance.node.push_back({i - 1, i}), distance.rest_length.push_back(length),
            distance.compliance.push_back(0);
    }
    scene.effects = {Gravity{}, distance};
    const Judgement j = primal_static(scene);
    INFO(links << " " << j.reason << j.note);
    REQUIRE(j.outcome == Outcome::ok);
    CHECK(j.certified);
    const DiscreteCatenary exact = discrete_catenary(1, 1.5, links);
    CHECK(-j.x.row(2).minCoeff() == Approx(exact.sag).epsilon(1e-10));
    const int middle = links / 2;
    const double horizontal = -j.multiplier(middle) * (j.x(0, middle + 1) - j.x(0, middle)) / length;
    CHECK(horizontal == Approx(exact.horizontal_share * links * 0.1 * 9.81).epsilon(1e-9));
  }
}

TEST_CASE("a column of springs stretches as its formula says") {
  Scene column;
  Distance springs;
  for (int i = 0; i <= 20; ++i) {
    add_node(column, Vec3(0, 0, -i), i == 0 ? infinity : 1);
    if (i > 0)
      springs.node.push_back({i - 1, i}), springs.rest_length.push_back(1),
          springs.compliance.push_back(1e-4);
  }
  column.effects = {Gravity{}, springs};
  const Judgement hung = primal_static(column);
  CHECK(hung.outcome == Outcome::ok);
  CHECK(-hung.x(2, 20) - 20 == Approx(spring_chain_stretch(20, 1e4, 1, 9.81)).epsilon(1e-11));
}

TEST_CASE("an upright pendulum balances, but is not certified") {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(0, 0, 1), 1);
  scene.effects = {Gravity{}, Distance{{{0, 1}}, {1}, {0}}};
  const Judgement j = primal_static(scene);
  CHECK(j.residual <= 1e-12);
  CHECK_FALSE(j.certified);
  CHECK(j.note.find("second-order") != std::string::npos);
}

TEST_CASE("an observer sees iterates that end at the result, with increasing times") {
  const Scene scene = cantilever(4, 1e5, 0.3, Strain::green);
  double last = -1;
  Points seen;
  int count = 0;
  const auto observe = [&](double seconds, const Points& x) {
    CHECK(seconds >= last);
    last = seconds, seen = x, ++count;
  };
  const Judgement j = primal_newton(scene, scene.initial, 1.0 / 60, {.observer = observe});
  CHECK(count == j.iterations);
  CHECK((seen - j.x).norm() == 0);
}

TEST_CASE("judges refuse damping, which they do not know") {
  Scene scene = cantilever(4, 1e5, 0.3, Strain::green);
  std::get<TetStrain>(scene.effects[0]).damping = Material{1e3, 0.3};
  for (const auto& judge : judges())
    CHECK_THROWS_WITH(judge.judge(scene, scene.initial, 0.01), Catch::Contains("effects[0] damping"));
}

TEST_CASE("judges are found by name") {
  CHECK(find_judge("primal_newton") == static_cast<Judge>(primal_newton));
  CHECK(find_judge("ipopt") == static_cast<Judge>(ipopt));
  CHECK_THROWS_WITH(find_judge("oracle"), Catch::Contains("primal_newton, ipopt"));
}
