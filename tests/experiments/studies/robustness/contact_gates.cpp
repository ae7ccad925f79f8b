// Each gate of the hard cases of contact is fed what is wrong, and fails.
#include "studies/robustness/contact_gates.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace pbdcheck;

namespace {

std::vector<std::string> failing(const std::vector<Gate>& gates) {
  std::vector<std::string> names;
  for (const Gate& gate : gates)
    if (gate.fails()) names.emplace_back(gate.name);
  return names;
}

using Names = std::vector<std::string>;

/// A box of 1 kg and 0.2 m on the ground, or on a slope of `angle`.
ContactCase box(double friction, double angle = 0) {
  BodyScene build({.friction = friction});
  const Eigen::Quaterniond turn = about_y(angle);
  build.fixed(pbd::HalfSpace{}, {pbd::Vec3::Zero(), turn});
  build.box(pbd::Vec3::Constant(0.2), 1, {turn * pbd::Vec3(0, 0, 0.1), turn});
  ContactCase each{"box", build.finish(), 0.01, 0.2, 0.2};
  each.stays = true;
  return each;
}

Names failing_of(const ContactCase& each, const pbd::Method& method = {}) {
  return failing(run_contact_case(each, method, each.h).gates);
}

}  // namespace

TEST_CASE("a box at rest passes all gates it is asked for") {
  ContactCase each = box(0.5);
  each.lift = 1e-9;
  each.reaction = gravity;
  const CaseRun run = run_contact_case(each, {}, each.h);
  CHECK(failing(run.gates).empty());
  CHECK(all_hold(run.gates));
  CHECK(run.ok == 20);
}

TEST_CASE("each gate of contact sees its own fault, and what is not a number") {
  ContactCase each = box(0.5);
  each.scene.effects.emplace_back(pbd::PointJoint{});
  std::get<pbd::Contact>(each.scene.effects[2]).triangle = {{0, 0, 0}};  // something is soft
  each.apart_for_ever = {Pair{}};
  each.falls = true;
  each.lift = 0.01;
  each.reaction = 10;
  each.missed = [](const pbd::State& end, double, std::int64_t) { return end.time; };
  pbd::State fallen = each.scene.initial;
  fallen.x(0, 1) += 0.11;
  each.stays = false;
  const Watched right{0, 0, 0, 0, 0, 10, 0, 0, 0, 20};
  const auto with = [&](double Watched::*what, double number) {
    Watched wrong = right;
    wrong.*what = number;
    return failing(gates_of(each, wrong, fallen, 1, 0.01, 20));
  };
  CHECK(failing(gates_of(each, right, fallen, 1, 0.01, 20)).empty());
  const double none = std::nan("");
  const std::pair<double Watched::*, std::pair<std::string, double>> faults[]{
      {&Watched::excess, {"energy", 0.011}},
      {&Watched::overlap, {"penetration", 0.0021}},
      {&Watched::overlap_at_end, {"penetration_at_end", 0.00021}},
      {&Watched::joints, {"joints", 0.00021}},
      {&Watched::lift, {"lift", 0.011}},
      {&Watched::reaction, {"reaction", 10.0001}},
      {&Watched::crossing, {"crosses", 1}},
      {&Watched::passed, {"passes", 1}},
      {&Watched::not_finite, {"finite", 1}},
      {&Watched::refuted, {"claims", 1}},
      {&Watched::unimproved, {"residual", 1}}};
  for (const auto& [what, fault] : faults) {
    INFO(fault.first);
    CHECK(with(what, fault.second) == Names{fault.first});
    CHECK(with(what, none) == Names{fault.first});
  }
  CHECK(failing(gates_of(each, right, each.scene.initial, 1, 0.01, 20)) == Names{"falls"});
  pbd::State moves = fallen;
  moves.v(0, 1) = 0.01;  // m/s: 5e-5 J of 2 J
  CHECK(failing(gates_of(each, right, moves, 1, 0.01, 20)) == Names{"settles"});
  moves.time = 1;
  moves.v(0, 1) = 0;
  CHECK(failing(gates_of(each, right, moves, 1, 0.01, 20)) == Names{"answer"});
  each.falls = false;
  each.stays = true;
  CHECK(failing(gates_of(each, right, fallen, 1, 0.01, 20)) == Names{"stays"});
}

TEST_CASE("an answer is held to its own bound") {
  ContactCase each = box(0.5);
  each.missed = [](const pbd::State&, double, std::int64_t) { return 1e-3; };
  each.exact_to = 2e-3;
  CHECK(failing_of(each).empty());
  each.exact_to = 0.5e-3;
  CHECK(failing_of(each) == Names{"answer"});
}

TEST_CASE("no claim is judged where no step says ok") {
  Watched watched{};
  const auto gates = gates_of(box(0.5), watched, box(0.5).scene.initial, 1, 0.01, 20);
  const auto claims =
      std::find_if(gates.begin(), gates.end(), [](const Gate& gate) { return gate.name == "claims"; });
  REQUIRE(claims != gates.end());
  CHECK(claims->skipped == "no step says ok");
}

TEST_CASE("runs that go wrong fail the gates that watch them") {
  CHECK(failing_of(box(0.5, 0.6)) == Names{"settles", "stays"});  // it slides: tan 0.6 is 0.68

  ContactCase thrown = box(0.5);
  thrown.scene.initial.v(2, 1) = 1;
  thrown.stays = false;
  thrown.lift = 0;
  const Names flying = failing_of(thrown);
  CHECK(std::count(flying.begin(), flying.end(), "lift") == 1);

  ContactCase standing = box(0.5);
  standing.falls = true;
  CHECK(failing_of(standing) == Names{"falls"});

  ContactCase light = box(0.5);
  light.reaction = 0.999 * gravity;
  CHECK(failing_of(light) == Names{"reaction"});

  ContactCase sunk = box(0.5);
  sunk.scene.initial.x(2, 1) -= 0.05;  // it is put out in one step, at 5 m/s
  const Names out = failing_of(sunk);
  CHECK(std::count(out.begin(), out.end(), "energy") == 1);
}

TEST_CASE("what passes through a thin wall that it does not touch is seen, and what is stopped is not") {
  for (const bool touches : {false, true}) {
    BodyScene build({}, 0);
    build.contact().continuous = true;
    if (!touches) build.contact().apart = {{0, 1}};
    build.fixed(pbd::Box{pbd::Vec3(0.002, 1, 1)}, {pbd::Vec3(0.5, 0, 0)});
    const Placing thrown{pbd::Vec3::Zero(), Eigen::Quaterniond::Identity(), pbd::Vec3(50, 0, 0)};
    build.box(pbd::Vec3::Constant(0.1), 1, thrown);
    ContactCase each{"wall", build.finish(), 0.02, 0.02, 0.1};
    each.settles = false;
    const auto& colliders = build.contact().collider;
    const auto both = [&](double share) {
      return std::array{core_of(colliders[0], share), core_of(colliders[1], share)};
    };
    each.apart_for_ever = {{both(1), both(core_share)}};
    CHECK(failing_of(each) == (touches ? Names{} : Names{"passes", "claims"}));
  }
}

TEST_CASE("scripted nodes and surfaces excuse a gain of energy, soft ones do not") {
  ContactCase each = box(0.5);
  const auto asked = [&] {
    for (const Gate& gate : run_contact_case(each, {}, each.h).gates)
      if (gate.name == "energy") return gate.skipped.empty();
    return false;
  };
  CHECK(asked());
  std::get<pbd::Contact>(each.scene.effects[2]).collider[0].surface_velocity = pbd::Vec3(0.1, 0, 0);
  CHECK(!asked());
  std::get<pbd::Contact>(each.scene.effects[2]).collider[0].surface_velocity = pbd::Vec3::Zero();
  const int node = pbd::add_node(each.scene, pbd::Vec3(5, 5, 5), pbd::infinity);
  CHECK(asked());
  each.scene.initial.v(0, node) = 1;
  CHECK(!asked());
}

TEST_CASE("what a spring gives is no gain of energy, and a stretched link is a joint's error") {
  ContactCase each = box(0.5);
  each.stays = each.settles = false;
  const int node = pbd::add_node(each.scene, pbd::Vec3(5, 5, 5), pbd::infinity);
  const int end = pbd::add_node(each.scene, pbd::Vec3(6, 5, 5), 1);
  each.scene.effects.emplace_back(pbd::Distance{{{node, end}}, {0.5}, {1e-4}});  // 1250 J
  CHECK(failing_of(each).empty());
  ContactCase hard = box(0.5);
  hard.stays = hard.settles = false;
  hard.scene.initial.v(2, 1) = 0;
  const int a = pbd::add_node(hard.scene, pbd::Vec3(5, 5, 5), pbd::infinity);
  const int b = pbd::add_node(hard.scene, pbd::Vec3(6, 5, 5), pbd::infinity);
  hard.scene.effects.emplace_back(pbd::Distance{{{a, b}}, {0.9}, {0}});  // that nothing can mend
  const Names names = failing_of(hard);
  CHECK(std::count(names.begin(), names.end(), "joints") == 1);
}

TEST_CASE("the same motion in other units ends at the same place") {
  ContactCase each = box(0.5);
  each.scene.initial.v(0, 1) = 1;
  each.stays = each.settles = false;
  CHECK(failing_of(in_other_units(each, 1e3, 1e-6)).empty());
  ContactCase other = in_other_units(each, 1e3, 1e-6);
  other.scene.initial.v(0, 1) *= 1.001;
  CHECK(failing_of(other) == Names{"answer"});
}
