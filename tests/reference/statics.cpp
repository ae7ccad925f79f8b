// Equilibria with a closed form.
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "closed_form.h"
#include "mesh.h"
#include "primal_newton.h"

using namespace pbd;
using namespace pbd::reference;

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
      scene.mass[i] = infinity;
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
