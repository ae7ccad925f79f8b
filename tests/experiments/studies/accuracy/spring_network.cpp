#include "studies/accuracy/spring_network.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "closed_form_solids.h"

using namespace pbdcheck;

TEST_CASE("springs along the diagonals of an icosahedron make an isotropic lattice of Poisson's ratio 1/4") {
  constexpr double golden = std::numbers::phi;
  pbd::Points springs(3, 6);
  springs << 0, 0, 1, -1, golden, golden,  //
      1, -1, golden, golden, 0, 0,         //
      golden, golden, 0, 0, 1, -1;
  CHECK(pbd::reference::spring_lattice_poisson(springs, Eigen::VectorXd::Ones(6)) ==
        Approx(0.25).epsilon(1e-12));
}

TEST_CASE("a cube of springs contracts as its lattice does, as far as its faces let it") {
  // What the faces add falls with 1/n: taken away to the first and the second order.
  const double two = fitted_cube(2).lateral, four = fitted_cube(4).lateral, eight = fitted_cube(8).lateral;
  const double first = 2 * four - two, finer = 2 * eight - four, limit = (4 * finer - first) / 3;
  CHECK(std::abs(limit - kuhn_network_poisson()) < std::abs(limit - finer));
}
