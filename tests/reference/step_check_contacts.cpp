// A true step with contact, made by hand, is not refuted; with one number of it changed it is, by the check
// of that law.
#include <catch2/catch.hpp>
#include <numbers>

#include "claimed_contacts.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("contacts: force, cone, slip, gap and depth") {
  Step turned = box_on_ground(0.5, 1);
  for (auto& contact : turned.contacts) contact.force.x() *= -1;
  CHECK(refuted(turned) == Names{"angular momentum", "momentum", "sliding"});

  Step beyond = box_on_ground(0.5, 1);
  beyond.scene.effects.back() = [&] {
    auto contact = std::get<Contact>(beyond.scene.effects.back());
    contact.law[0].friction = 0.49;
    return contact;
  }();
  CHECK(refuted(beyond) == Names{"friction", "sliding"});

  Step idle = box_on_ground(0.5, 1);
  idle.contacts[0].force.x() *= 0.9;  // another takes its share
  idle.contacts[1].force.x() += 0.1 / 0.9 * idle.contacts[0].force.x();
  CHECK(refuted(idle).count("sliding") == 1);

  Step pulls = box_on_ground(0.5, 0);
  for (const int sign : {-1, 1}) {  // two pull as others push more
    pulls.contacts[sign < 0 ? 0 : 1].force.z() += 20 * sign;
    pulls.contacts[sign < 0 ? 3 : 2].force.z() += 20 * sign;
  }
  CHECK(refuted(pulls).count("contact pulls") == 1);

  Step open = balls();
  open.contacts[0].gap = 1e-6;
  CHECK(refuted(open) == Names{"open contact"});
  open.contacts[0].gap = -1e-6;
  CHECK(refuted(open) == Names{"gap told"});

  Step deep = balls();  // as if they had not met
  deep.contacts.clear();
  deep.end.v = deep.scene.initial.v;
  deep.move();
  CHECK(refuted(deep) == Names{"depth"});
}

TEST_CASE("contacts: what yields is a spring between the gap and the force") {
  Step step = box_on_ground(0, 0);
  auto& law = std::get<Contact>(step.scene.effects.back()).law[0];
  law.compliance = 1e-4;
  const double deep = law.compliance * weight_per_kg;  // four contacts carry 4 kg
  const Vec3 down(0, 0, -deep);
  step.scene.initial.x.col(1) += down;
  step.end.x.col(1) += down;
  for (auto& contact : step.contacts) contact.point += down, contact.gap = -deep;
  CHECK(refuted(step).empty());
  law.compliance *= 1.01;
  CHECK(refuted(step) == Names{"spring of contact"});
}

TEST_CASE("contacts: what met on the way is pushed as it stood there") {
  // The balls of balls(), turned by what is told of the way: where they touched is all that counts.
  Step step = balls();
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(2, Vec3::UnitY()));
  reference::ClaimedMeeting met;
  met.rotation = {turned.toRotationMatrix(), turned.conjugate().toRotationMatrix()};
  met.arm = {Vec3(0.1, 0, 0), Vec3(-0.1, 0, 0)};
  step.contacts[0].met = met;
  step.contacts[0].point = Vec3(5, 6, 7);  // of no use
  CHECK(refuted(step).empty());
  Step beside = step;
  beside.contacts[0].met->arm[0] = Vec3(0.1, 0, 1e-3);
  CHECK(refuted(beside) == Names{"angular momentum"});
  Step apart = step;
  apart.contacts[0].met->arm[1] = Vec3(-0.1001, 0, 0);
  CHECK(refuted(apart) == Names{"place of meeting"});
  // Across the normal, where no force has more of an arm for it.
  Step across = step;
  across.contacts[0].met->arm[1] = Vec3(-0.1, 1, 0);
  CHECK(refuted(across).contains("place of meeting"));
  // What is in each other, 0.25 m along the normal, is pushed between its points, off one of them too, but
  // not far beside.
  Step deep = step;
  deep.contacts[0].met->arm = {Vec3(-0.15, 0, 0), Vec3(-0.1, 0, 0)};
  CHECK(refuted(deep).empty());
  deep.contacts[0].met->arm = {Vec3(-0.15, 0.5, 0), Vec3(-0.1, 0.5, 0)};
  CHECK(refuted(deep).contains("place of meeting"));
  Step open = step;
  open.contacts[0].gap = 1e-6;
  CHECK(refuted(open) == Names{"open contact"});
}

TEST_CASE("contacts: force, cone, slip and depth under integrators of second order") {
  for (const std::string_view integrator : {"newmark", "bdf2", "generalised_alpha"}) {
    INFO(integrator);
    Step step = box_on_ground(0.5, 1);
    step.integrator = integrator;
    CHECK(refuted(step).empty());
    for (auto& contact : step.contacts) contact.force.x() *= -1;
    CHECK(refuted(step) == Names{"sliding"});
    for (auto& contact : step.contacts) contact.force *= -1;
    CHECK(refuted(step) == Names{"contact pulls", "friction", "sliding"});
    Step deep = balls();
    deep.integrator = integrator;
    CHECK(refuted(deep).empty());
    deep.end.x(0, 0) += 1e-3;
    CHECK(refuted(deep) == Names{"depth"});
  }
}

TEST_CASE("contacts: a belt drags by its slip, and brings energy") {
  Step step = box_on_ground(0.5, 1);  // seen by who goes along with the box
  step.scene.initial.v(0, 1) -= 1;
  step.end.v(0, 1) -= 1;
  step.move();
  for (auto& contact : step.contacts) contact.point.x() -= Step::h;
  const auto set_belt = [&](double speed) {
    std::get<Contact>(step.scene.effects.back()).collider[0].surface_velocity.x() = speed;
  };
  set_belt(-1);
  CHECK(refuted(step).empty());
  for (const double other : {0.0, 1.0}) {
    set_belt(other);
    CHECK(refuted(step) == Names{"energy", "sliding"});
  }
  set_belt(-1);
  // Met as the belt's body stood, which ends turned round.
  for (auto& contact : step.contacts) {
    reference::ClaimedMeeting met;
    for (const std::size_t side : {0, 1})
      met.arm[side] = contact.point - step.end.x.col(contact.collider[side]);
    contact.met = met;
  }
  step.end.orientation[0] = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ());
  CHECK(!refuted(step).contains("sliding"));
}

TEST_CASE("contacts: nodes that touch each other, but not those of one link") {
  Step step = balls();
  auto& contact = std::get<Contact>(step.scene.effects.back());
  Scene nodes;
  for (int i = 0; i < 2; ++i)
    add_node(nodes, step.scene.initial.x.col(i), step.scene.mass[i], step.scene.initial.v.col(i));
  contact.collider.clear();
  contact.node = {0, 1};
  contact.radius = {0.1, 0.1};
  contact.node_material = {0, 0};
  contact.nodes_touch = true;
  nodes.effects = {contact};
  Step met(nodes);
  met.end.v = step.end.v;
  met.move();
  met.contacts = step.contacts;
  CHECK(refuted(met).empty());
  met.contacts.clear();
  met.end.v = nodes.initial.v;
  met.move();
  CHECK(refuted(met) == Names{"depth"});
  nodes.effects = {Distance{.node = {{0, 1}}, .rest_length = {0.202}, .compliance = {1e9}}, contact};
  Step linked(nodes);
  linked.move();
  linked.forces[0] = {0.01 / 1e9};
  CHECK(refuted(linked).count("depth") == 0);
}

TEST_CASE("contacts: a ball in a triangle of a surface, and what a surface carries") {
  constexpr double thickness = 0.01, radius = 0.1, fall = 0.1;  // m, m/s
  const auto falling = [&](double gap) {
    Scene scene;
    add_body(scene, Vec3(0.1, 0.1, radius + thickness / 2 + gap), 2, Vec3::Constant(0.01),
             Eigen::Quaterniond::Identity(), Vec3(0, 0, -fall));
    Contact contact;
    contact.thickness = thickness;
    contact.collider.push_back({Sphere{radius}, 0});
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) add_node(scene, x, infinity);
    contact.triangle.push_back({1, 2, 3});
    scene.effects.emplace_back(contact);
    Step step(scene);
    step.move();
    return step;
  };
  CHECK(refuted(falling(Step::h * fall + 1e-9)).empty());
  CHECK(refuted(falling(Step::h * fall - 2e-4 * radius)) == Names{"depth"});

  Step stopped = falling(Step::h * fall / 2);  // the surface takes half of the speed
  stopped.end.v.col(0) /= 2;
  stopped.move();
  const Vec3 force(0, 0, 2 * fall / 2 / Step::h);
  stopped.contacts.push_back({{0, 2}, Vec3(0.1, 0.1, 0), Vec3::UnitZ(), force, 0});
  CHECK(refuted(stopped).empty());
  stopped.contacts[0].force *= 1.001;
  CHECK(refuted(stopped) == Names{"momentum"});
  stopped.contacts[0].force /= 1.001;
  const double side = std::sqrt(2.0);  // m, the longest of the triangle
  stopped.contacts[0].point.x() = -side - 0.9 * thickness;
  CHECK(refuted(stopped).count("place of contact") == 0);
  stopped.contacts[0].point.x() = -side - 1.1 * thickness;
  CHECK(refuted(stopped).count("place of contact") == 1);
}

TEST_CASE("contacts: a triangle of a surface that flies through another, unless it began in it") {
  constexpr double fall = 10;  // m/s
  for (const auto& [height, passes] : {std::pair{1.5, false}, {0.5, true}, {-0.02, false}}) {
    Scene scene;
    Contact contact;
    contact.thickness = 0.01;
    for (const Vec3& x : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)}) add_node(scene, x, infinity);
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.1, 0, 1), Vec3(-0.1, 0, 1)})
      add_node(scene, x + Vec3(0, 0, height * Step::h * fall), 1, Vec3(0, 0, -fall));
    contact.triangle = {{0, 1, 2}, {3, 4, 5}};
    scene.effects.emplace_back(contact);
    Step step(scene);
    step.move();
    CHECK(refuted(step) == (passes ? Names{"depth"} : Names{}));
  }
}

TEST_CASE("contacts: each surface slides on the ground by its own material") {
  constexpr double thickness = 0.01, speed = 1;  // m, m/s
  const std::array<double, 2> friction{0.2, 0.4};
  pbdcheck::BodyScene build({.friction = 0}, weight_per_kg);
  build.ground();
  build.materials(3, {.friction = 0});
  for (const int k : {0, 1}) build.law(0, k + 1, {.friction = friction[k]});
  Scene scene = build.finish();
  auto& contact = std::get<Contact>(scene.effects.back());
  contact.thickness = thickness;
  contact.triangle_material = {1, 2};
  for (const double shift : {0.0, 2.0}) {
    auto& nodes = contact.triangle.emplace_back();
    for (const std::size_t k : {0, 1, 2}) {
      const Vec3 place(shift + (k == 1 ? 1 : 0), k == 2 ? 1 : 0, thickness / 2);
      nodes[k] = add_node(scene, place, 1, Vec3(speed, 0, 0));
    }
  }
  Step step(scene);
  for (const std::size_t k : {0, 1})
    for (const int node : contact.triangle[k]) step.end.v(0, node) -= Step::h * friction[k] * weight_per_kg;
  step.move();
  for (const std::size_t k : {0, 1})
    for (const int node : contact.triangle[k])
      step.contacts.push_back({.collider = {1 + node, 0},
                               .point = step.end.x.col(node),
                               .normal = Vec3::UnitZ(),
                               .force = weight_per_kg * Vec3(-friction[k], 0, 1),
                               .gap = 0});
  CHECK(refuted(step).empty());
  std::get<Contact>(step.scene.effects.back()).triangle_material = {1, 1};
  CHECK(refuted(step) == Names{"friction"});
}

TEST_CASE("contacts: surfaces in each other are judged where the law of their two materials is hard") {
  constexpr double fall = 10;  // m/s
  for (const bool hard : {true, false}) {
    Scene scene;
    Contact contact;
    contact.thickness = 0.01;
    for (const Vec3& x : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)}) add_node(scene, x, infinity);
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.1, 0, 1), Vec3(-0.1, 0, 1)})
      add_node(scene, x + Vec3(0, 0, 0.5 * Step::h * fall), 1, Vec3(0, 0, -fall));
    contact.triangle = {{0, 1, 2}, {3, 4, 5}};
    contact.triangle_material = {0, 1};
    contact.materials = 2;
    const ContactLaw of_both{.compliance = hard ? 0 : 1e-3}, of_each{.compliance = hard ? 1e-3 : 0};
    contact.law = {of_each, of_both, of_both, of_each};
    scene.effects.emplace_back(contact);
    Step step(scene);
    step.move();
    CHECK(refuted(step) == (hard ? Names{"depth"} : Names{}));
    CHECK(step.judge().left_out.contains("depth: where shapes give way") == !hard);
  }
}

TEST_CASE("contacts: a box's edge that comes down across a cylinder's rim is deep by what it went on") {
  // The edge leads along (-1, 2, 1) through the rim's (radius, 0, half), whose tangent is y: n is across
  // both.
  constexpr double radius = 0.1, half = 0.15, side = 0.1, above = 1e-4;  // m
  const Vec3 n = Vec3(1, 0, 1).normalized(), along = Vec3(-1, 2, 1).normalized();
  Eigen::Matrix3d turned;
  turned << along, (n + along.cross(n)).normalized(), (along.cross(n) - n).normalized();
  const Vec3 middle = Vec3(radius, 0, half) + (above + side / std::sqrt(2.0)) * n;
  for (const double deep : {-1e-5, 5e-4}) {
    pbdcheck::BodyScene scene(ContactLaw{.friction = 0}, 0);
    scene.fixed(Cylinder{radius, 2 * half}, {.position = Vec3::Zero()});
    scene.box(Vec3::Constant(side), 1,
              {.position = middle,
               .orientation = Eigen::Quaterniond(turned),
               .velocity = -(above + deep) / Step::h * n});
    Step step(scene.finish());
    step.move();
    CHECK(refuted(step) == (deep > 0 ? Names{"depth"} : Names{}));
  }
}
