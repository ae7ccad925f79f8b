// What may change between two steps of one workspace.
#include <catch2/catch.hpp>

#include "error.h"
#include "planted_rows.h"
#include "scenes.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double h = 1.0 / 60;

Method by_quasi_newton() {
  Method method;
  method.outer = "quasi_newton";
  method.tolerance = 1e-10;
  return method;
}

/// The scene's strain a hundred times as stiff, or with a rest shape smaller by a hundredth.
TetStrain other_strain(const Scene& scene, std::size_t index, bool stiffer) {
  TetStrain strain = std::get<TetStrain>(scene.effects[index]);
  if (stiffer)
    strain.material.young *= 100;
  else
    for (auto& corners : strain.rest) corners *= 0.99;
  return strain;
}

std::size_t strain_of(const Scene& scene) {
  for (std::size_t i = 0; i < scene.effects.size(); ++i)
    if (std::holds_alternative<TetStrain>(scene.effects[i])) return i;
  throw std::logic_error("no solid");
}

}  // namespace

TEST_CASE("a modulus or rest shape changed between steps is the next step's, as in a workspace of its own") {
  const bool stiffer = GENERATE(true, false);
  const Scene soft = cantilever(4, {1e5, 0.3}, Strain::green);
  const std::size_t index = strain_of(soft);
  Scene hard = soft;
  hard.effects[index] = other_strain(soft, index, stiffer);
  const double least = spectrum(Planted(hard, h).rows, hard.nodes()).minCoeff();
  const double lightest = *std::min_element(hard.mass.begin(), hard.mass.end());
  for (const std::string outer : {"quasi_newton", "auto", "plain"}) {
    INFO(outer);
    Method method = by_quasi_newton();
    method.outer = outer;
    Workspace changed(soft, method);
    State state = soft.initial;
    for (int k = 0; k < 3; ++k) step(changed, h, state);
    State expected = state, old = state;
    changed.change(index, hard.effects[index]);
    const Report after = step(changed, h, state);
    CHECK(after.status == Status::ok);
    Workspace fresh(hard, method), unchanged(soft, method);
    const double scale = after.scale + step(fresh, h, expected).scale;
    step(unchanged, h, old);
    // Both miss the solution by at most the residuals, the dual one over sqrt(least eigenvalue of D^-1 N).
    CHECK((state.x - expected.x).norm() <=
          h * method.tolerance * scale * (1 + 1 / std::sqrt(least)) / std::sqrt(lightest));
    CHECK((state.x - old.x).norm() > 1e-2 * (state.x - soft.initial.x).norm());
  }
}

TEST_CASE("a step that an observer ends leaves no history, whatever the integrator keeps") {
  Scene scene;
  add_body(scene, Vec3::Zero(), 2, Vec3(1, 2, 3), Eigen::Quaterniond::Identity(), Vec3::UnitX(),
           Vec3(1, 1, 1));
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Gyroscopic{});
  for (const std::string integrator : {"bdf2", "newmark", "generalised_alpha"}) {
    INFO(integrator);
    Method method;
    method.integrator = integrator;
    Workspace ended(scene, method), fresh(scene, method);
    State state = scene.initial, expected = scene.initial;
    CHECK_THROWS_AS(step(ended, h, state, [](const Iterate&) { throw std::runtime_error("enough"); }),
                    std::runtime_error);
    step(ended, h, state);
    step(fresh, h, expected);
    CHECK(state.v == expected.v);
    CHECK(state.spin == expected.spin);
  }
}

TEST_CASE("a gyroscopic torque made explicit between steps acts once, as in a workspace of its own") {
  const bool implicit = GENERATE(true, false);
  Scene scene, other;
  for (Scene* own : {&scene, &other}) {
    add_body(*own, Vec3::Zero(), 2, Vec3(1, 2, 3), Eigen::Quaterniond::Identity(), Vec3::Zero(),
             Vec3(1, 1, 1));
    own->effects.emplace_back(Gyroscopic{own == &scene ? implicit : !implicit});
  }
  Workspace changed(scene, {}), fresh(other, {});
  State state = scene.initial, expected = scene.initial;
  changed.change(0, other.effects[0]);
  CHECK(step(changed, h, state).status == Status::ok);
  CHECK(step(fresh, h, expected).status == Status::ok);
  CHECK(state.spin == expected.spin);
  CHECK(state.spin != scene.initial.spin);
}

TEST_CASE("an effect is replaced by one of the same constraints only, and nothing changes otherwise") {
  const Scene scene = chain(4);
  std::size_t index = 0;
  while (!std::holds_alternative<Distance>(scene.effects[index])) ++index;
  const Distance links = std::get<Distance>(scene.effects[index]);
  Workspace workspace(scene, {});
  Distance other = links;
  SECTION("other nodes") {
    std::swap(other.node[0], other.node[1]);
  }
  SECTION("one link less") {
    other.node.pop_back();
    other.rest_length.pop_back();
    other.compliance.pop_back();
  }
  SECTION("a hard link that gives way") {
    other.compliance.assign(other.compliance.size(), 1e-3);
  }
  SECTION("one hard link of them that gives way") {
    other.compliance[1] = 1e-3;
  }
  SECTION("damping where there was none") {
    other.damping.assign(other.node.size(), 0.1);
  }
  SECTION("a length below zero") {
    other.rest_length[0] = -1;
  }
  CHECK_THROWS_AS(workspace.change(index, other), SetupError);
  CHECK_THROWS_AS(workspace.change(index, Gravity{}), SetupError);
  CHECK_THROWS_AS(workspace.change(99, links), SetupError);
  CHECK_THROWS_AS(workspace.forces(99), SetupError);
  CHECK_THROWS_AS(workspace.impulses(99), SetupError);
  const auto& kept = std::get<Distance>(workspace.scene().effects[index]);
  CHECK(kept.node == links.node);
  CHECK(kept.rest_length == links.rest_length);
  CHECK(kept.compliance == links.compliance);
  CHECK(kept.damping == links.damping);
  Distance longer = links;
  for (double& length : longer.rest_length) length *= 1.1;
  workspace.change(index, longer);
  State state = scene.initial;
  CHECK(step(workspace, h, state).status == Status::ok);
  CHECK((state.x.col(1) - state.x.col(0)).norm() == Approx(longer.rest_length[0]).epsilon(1e-6));
}

TEST_CASE("a linear solver that does not know the law of friction is refused before the first contact") {
  pbdcheck::BodyScene build({.friction = 0.5});
  build.ground();
  build.ball(0.1, 1, {Vec3(0, 0, 5)});
  const Scene scene = build.finish();
  Method method;
  method.relaxation = "augmented_lagrangian";
  for (const std::string_view law : friction_names) {
    INFO(law);
    method.friction = law;
    if (law == "box")
      CHECK_THROWS_AS(Workspace(scene, method), SetupError);
    else
      CHECK_NOTHROW(Workspace(scene, method));
  }
}
