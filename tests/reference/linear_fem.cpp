// Values that belong to a mesh, catalogued with 7 digits from an independent finite element code, and orders
// of convergence against a manufactured solution.
#include "linear_fem.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace pbd;
using namespace pbd::reference;

namespace {

const Material beam_material{1e7, 0.3};

LinearSolid beam(int n) {
  return clamped_beam({10 * n, n, n}, Vec3(1, 0.1, 0.1), beam_material, 1000);
}

/// F.u under a transverse force of 1 N spread evenly over the tip.
double compliance(int n) {
  const LinearSolid solid = beam(n);
  const auto tip = [](const Vec3& x) { return x.x() > 1 - 1e-9; };
  const Points loads = face_loads(solid.mesh, tip, Vec3(0, 0, 1 / (0.1 * 0.1)));
  REQUIRE(loads.row(2).sum() == Approx(1).epsilon(1e-13));
  return loads.cwiseProduct(linear_static(solid, loads)).sum();
}

}  // namespace

TEST_CASE("a clamped beam of linear tetrahedra has the compliance of its mesh") {
  CHECK(compliance(1) == Approx(8.843468e-4).epsilon(1e-7));
  CHECK(compliance(2) == Approx(2.0305191e-3).epsilon(1e-7));
  CHECK(compliance(4) == Approx(3.1730961e-3).epsilon(1e-7));
}

TEST_CASE("a bar without Poisson contraction stretches exactly under end traction") {
  const LinearSolid solid = clamped_beam({4, 2, 2}, Vec3(1, 0.1, 0.1), {1e7, 0}, 1000);
  const auto tip = [](const Vec3& x) { return x.x() > 1 - 1e-9; };
  const Points u = linear_static(solid, face_loads(solid.mesh, tip, Vec3(1e4, 0, 0)));
  Points exact = Points::Zero(3, u.cols());
  exact.row(0) = 1e-3 * solid.mesh.x.row(0);
  CHECK((u - exact).cwiseAbs().maxCoeff() <= 1e-15);
}

TEST_CASE("a clamped beam of linear tetrahedra has the first frequency of its mesh") {
  const auto first = [](int n, MassMatrix mass) { return linear_modes(beam(n), 2, mass).front(); };
  CHECK(first(1, MassMatrix::consistent) == Approx(3.02611455).epsilon(1e-8));
  CHECK(first(2, MassMatrix::consistent) == Approx(2.08724748).epsilon(1e-8));
  CHECK(first(4, MassMatrix::consistent) == Approx(1.74884806).epsilon(1e-8));
  CHECK(first(1, MassMatrix::lumped) == Approx(3.01090054).epsilon(1e-8));
  CHECK(first(2, MassMatrix::lumped) == Approx(2.08442102).epsilon(1e-8));
  CHECK(first(4, MassMatrix::lumped) == Approx(1.74823158).epsilon(1e-8));
}

TEST_CASE("the beam of 30720 tetrahedra", "[.slow]") {
  CHECK(compliance(8) == Approx(3.7473382e-3).epsilon(1e-7));
  CHECK(linear_modes(beam(8), 2, MassMatrix::consistent).front() == Approx(1.64751004).epsilon(1e-8));
  CHECK(linear_modes(beam(8), 2, MassMatrix::lumped).front() == Approx(1.64736275).epsilon(1e-8));
}

TEST_CASE("a manufactured solution is approached with order 2 in L2 and 1 in H1") {
  const Material material{1e6, 0.3};
  const ManufacturedError e4 = manufactured_cube(4, material), e8 = manufactured_cube(8, material),
                          e16 = manufactured_cube(16, material);
  CHECK(e4.l2 == Approx(1.184842e-2).epsilon(1e-6));
  CHECK(e8.l2 == Approx(3.101474e-3).epsilon(1e-6));
  CHECK(e16.l2 == Approx(7.841755e-4).epsilon(1e-6));
  CHECK(e4.h1_seminorm == Approx(0.1602130).epsilon(1e-6));
  CHECK(e8.h1_seminorm == Approx(0.08342223).epsilon(1e-6));
  CHECK(e16.h1_seminorm == Approx(0.04210412).epsilon(1e-6));
  CHECK(std::log2(e8.l2 / e16.l2) == Approx(2).margin(0.1));
  CHECK(std::log2(e8.h1_seminorm / e16.h1_seminorm) == Approx(1).margin(0.1));
}
