#include "harness/measure.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "harness/probes.h"

using namespace pbdcheck;

namespace {

// A mass of 2 kg at rest on a spring of rest length 1 m and stiffness k, stretched to 1.5 m.
constexpr double mass = 2, stiffness = 8, stretch = 0.5;

pbd::Scene one_spring() {
  pbd::Scene scene;
  pbd::add_node(scene, {0, 0, 0}, pbd::infinity);
  pbd::add_node(scene, {1 + stretch, 0, 0}, mass, {0, 3, 0});
  scene.effects.push_back(pbd::Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {1 / stiffness}});
  return scene;
}

}  // namespace

TEST_CASE("a trace ends at the step's solution, its work and time never fall") {
  pbd::Scene scene = one_spring();
  scene.initial.v.setZero();
  const double h = 0.1;
  pbd::Points solution = scene.initial.x;  // of m (x - x_l)/h^2 = -k (x - 1)
  solution(0, 1) = 1 + stretch / (1 + h * h * stiffness / mass);
  pbd::Method method;
  method.tolerance = 1e-13;
  const Trace trace = measure([&] { return measure_once(scene, scene.initial, h, method, solution); });
  CHECK(trace.report.status == pbd::Status::ok);
  REQUIRE(trace.points.size() >= 2);
  CHECK(trace.points.back().error < 1e-12);
  CHECK(trace.points.back().outer_iterations == trace.report.outer_iterations);
  for (std::size_t i = 1; i < trace.points.size(); ++i) {
    CHECK(trace.points[i].outer_iterations > trace.points[i - 1].outer_iterations);
    CHECK(trace.points[i].row_updates >= trace.points[i - 1].row_updates);
  }
}

TEST_CASE("the relative error is that of the worst node over the largest displacement") {
  pbd::Points start = pbd::Points::Zero(3, 2), reference = start, x = start;
  reference.col(0) = pbd::Vec3(3, 4, 0);
  x.col(0) = pbd::Vec3(3, 4, 1);
  x.col(1) = pbd::Vec3(0, 2, 0);
  CHECK(relative_error(x, reference, start) == Approx(2.0 / 5));
  CHECK(relative_error(x, reference, start, 4) == Approx(2.0 / 5));  // a displacement of at least 4 m
  CHECK(relative_error(x, reference, start, 8) == Approx(2.0 / 8));
  CHECK(relative_error(x, start, start) == Approx(std::sqrt(26.0)));  // nothing moved: in metres
  const pbd::Points at = pbd::Points::Constant(3, 2, 8), rounded = pbd::Points::Constant(3, 2, 8 + 1e-14);
  CHECK(relative_error(at, rounded, at) < 2e-14);  // but by rounding: likewise
  for (const double lost : {std::nan(""), pbd::infinity}) {
    pbd::Points nowhere = reference;
    nowhere(0, 1) = lost;
    CHECK_FALSE(std::isfinite(relative_error(nowhere, reference, start)));
    CHECK(std::isnan(relative_error(x, nowhere, start)));
  }
}

TEST_CASE("what is held counts in no error") {
  pbd::Scene scene;
  const int led = pbd::add_body(scene, pbd::Vec3(9, 0, 0), pbd::infinity, pbd::Vec3::Constant(pbd::infinity));
  pbd::add_body(scene, pbd::Vec3::Zero(), 1e-3, pbd::Vec3::Constant(1e-9));
  pbd::Points moved = scene.initial.x;
  moved(0, 0) += 5;
  std::vector<Eigen::Quaterniond> turned = scene.initial.orientation;
  turned[static_cast<std::size_t>(led)] = Eigen::Quaterniond(0, 1, 0, 0);
  CHECK(places(scene, moved, turned) == places(scene, scene.initial.x, scene.initial.orientation));
  CHECK(places(scene, moved, turned).cwiseAbs().maxCoeff() == Approx(1e-3));  // radii of gyration
}

// A body turns freely about z, its moments equal, by w h in a step; radii of gyration r = sqrt(I/m).
TEST_CASE("a body's turn counts as that of points at its radii of gyration") {
  const double w = 3, h = 0.1, inertia = 2, m = 8;
  pbd::Scene scene;
  pbd::add_body(scene, pbd::Vec3::Zero(), m, pbd::Vec3::Constant(inertia), Eigen::Quaterniond::Identity(),
                pbd::Vec3::Zero(), pbd::Vec3(0, 0, w));
  const auto turned = [&](double angle) {
    return places(scene, scene.initial.x, {Eigen::Quaterniond(Eigen::AngleAxisd(angle, pbd::Vec3::UnitZ()))});
  };
  // Chords of r: 2 r sin(angle/2).
  const double r = std::sqrt(inertia / m);
  CHECK(relative_error(turned(0.4), turned(0), turned(0)) == Approx(2 * r * std::sin(0.2)).epsilon(1e-14));
  const Trace right = measure_once(scene, scene.initial, h, pbd::Method{}, turned(w * h));
  CHECK(right.points.back().error < 1e-14);
  const Trace wrong = measure_once(scene, scene.initial, h, pbd::Method{}, turned(2 * w * h));
  for (const auto& point : wrong.points)
    CHECK(point.error == Approx(std::sin(w * h / 2) / std::sin(w * h)).epsilon(1e-12));
}

TEST_CASE("energies and constraint errors are those of the formulas") {
  pbd::Scene scene = one_spring();
  CHECK(kinetic_energy(scene, scene.initial) == Approx(mass * 9 / 2));
  CHECK(elastic_energy(scene, scene.initial) == Approx(stiffness * stretch * stretch / 2));
  CHECK(gravity_energy(scene, scene.initial) == 0);
  CHECK(constraint_error(scene, scene.effects[0], scene.initial) == 0);  // a spring is no constraint
  scene.effects.push_back(pbd::Gravity{{-4, 0, 0}});
  CHECK(gravity_energy(scene, scene.initial) == Approx(mass * 4 * (1 + stretch)));
  std::get<pbd::Distance>(scene.effects[0]).compliance[0] = 0;
  CHECK(elastic_energy(scene, scene.initial) == 0);
  CHECK(constraint_error(scene, scene.effects[0], scene.initial) == Approx(stretch));
}
