#include "outer/acceleration.h"

#include <catch2/catch.hpp>

using namespace pbd;

namespace {

/// Distance from the fixed point 0 after some iterations that multiply every component by a number of its
/// own.
double error_after(int iterations, int memory) {
  Eigen::Matrix<double, 3, 2> growth;
  growth << -3, -1.5, 0.5, 0.9, -20, 0.99;
  Rows rows;
  rows.inverse_mass = {1, 0.25};
  Points v = Points::Ones(3, 2);
  Anderson anderson(memory);
  for (int k = 0; k < iterations; ++k) {
    anderson.begin(rows, v);
    v.array() *= growth.array();
    anderson.accelerate(rows.inverse_mass, rows, v);
  }
  return v.norm();
}

}  // namespace

TEST_CASE(
    "with as many differences as unknowns, a linear iteration ends at its fixed point, contracting or not") {
  CHECK(error_after(8, 6) < 1e-8);
  CHECK(error_after(8, 0) > 1e9);  // 20^8
}

// What one iteration multiplies by 0.999 would be extrapolated by 999 changes: 100 of them are taken.
TEST_CASE("an acceleration that is too long is shortened") {
  Rows rows;
  rows.inverse_mass = {1};
  Points v = Points::Ones(3, 1);
  Anderson anderson(5);
  for (int k = 0; k < 2; ++k) {
    anderson.begin(rows, v);
    v *= 0.999;
    CHECK(anderson.accelerate(rows.inverse_mass, rows, v) == (k == 1));
  }
  CHECK(v(0, 0) == Approx(0.999 * 0.999 - 100 * 0.001 * 0.999).epsilon(1e-9));
}

TEST_CASE("an acceleration follows when rows come and go") {
  const auto accelerated = [](Anderson& anderson, std::size_t constraints) {
    Rows rows;
    rows.inverse_mass = {1};
    RowBlock<1, 2> block;
    block.resize(constraints);
    rows.blocks.add(std::move(block));
    Points v = Points::Ones(3, 1);
    anderson.forget();
    for (int k = 0; k < 3; ++k) {
      anderson.begin(rows, v);
      v = Vec3(0.5, -2, 3).cwiseProduct(Vec3(v.col(0)));
      for (auto& impulse : std::get<RowBlock<1, 2>>(rows.blocks[0]).impulse) impulse[0] = v(2, 0);
      anderson.accelerate(rows.inverse_mass, rows, v);
    }
    const auto& impulses = std::get<RowBlock<1, 2>>(rows.blocks[0]).impulse;
    return Vec3(v(0, 0), impulses.front()[0], impulses.back()[0]);
  };
  Anderson used(5);
  for (const std::size_t constraints : {2U, 100U, 1U}) {
    Anderson fresh(5);
    CHECK(accelerated(used, constraints) == accelerated(fresh, constraints));
  }
}

TEST_CASE("a rejected acceleration leaves the image") {
  Rows rows;
  rows.inverse_mass = {1};
  Points v = Points::Ones(3, 1);
  Anderson anderson(5);
  Points image = v;
  for (int k = 0; k < 3; ++k) {
    anderson.begin(rows, v);
    v = Eigen::Vector3d(0.5, -2, 3).cwiseProduct(Eigen::Vector3d(v.col(0)));
    image = v;
    if (k == 2) REQUIRE(anderson.accelerate(rows.inverse_mass, rows, v));
    if (k < 2) anderson.accelerate(rows.inverse_mass, rows, v);
  }
  CHECK(v != image);
  anderson.reject(rows, v);
  CHECK(v == image);
  anderson.begin(rows, v);
  CHECK_FALSE(anderson.accelerate(rows.inverse_mass, rows, v));  // nothing is left to combine
}

TEST_CASE("an acceleration after which the residual has grown by more than a factor is taken back") {
  const double too_much = GENERATE(1.0, 10.0);
  for (const double growth : {0.99 * too_much, 1.01 * too_much}) {
    Scene scene;
    add_node(scene, Vec3::Zero(), 1);
    const Method method;
    StepSystem system(scene, method);
    system.problem.inverse_mass = system.rows.inverse_mass = {1};
    Points& v = system.at.v;
    v = Points::Ones(3, 1);
    Points image = v;
    Acceleration acceleration(5);
    Progress progress;
    progress.primal = 1;
    for (int k = 0; k < 3; ++k) {
      CHECK_FALSE(acceleration.refuted(system, progress, too_much));
      acceleration.note(system);
      v = Vec3(0.5, -2, 3).cwiseProduct(Vec3(v.col(0)));
      image = v;
      acceleration.accelerate(system);
    }
    REQUIRE(v != image);
    progress.primal = growth;
    CHECK(acceleration.refuted(system, progress, too_much) == (growth > too_much));
    CHECK((v == image) == (growth > too_much));
  }
}
