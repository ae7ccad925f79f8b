// What contact does not take.
#include "contact_runs.h"
#include "error.h"
#include "scenes/contacts.h"
#include "validate.h"

using namespace pbd;
using namespace pbd::test;
using namespace pbdcheck;

TEST_CASE("contact refuses what it cannot do") {
  const Scene scene = sliding_box(0, 0.5, 1);
  Method method;
  method.integrator = "midpoint";
  CHECK_THROWS_WITH(Workspace(scene, method),
                    Catch::Contains("midpoint with contact") && Catch::Contains("where steps end"));
  method.integrator = "newmark";
  method.beta = 0.25;
  method.gamma = 0.5;
  CHECK_THROWS_WITH(Workspace(scene, method), Catch::Contains("Newmark's own family with contact"));
  Method unknown;
  unknown.friction = "pyramid";
  CHECK_THROWS_WITH(Workspace(scene, unknown), Catch::Contains("friction") && Catch::Contains("pyramid"));
  Scene bad = scene;
  std::get<Contact>(bad.effects.back()).law[0].friction = -1;
  CHECK_THROWS_WITH(Workspace(bad, Method{}), Catch::Contains("friction") && Catch::Contains("-1"));
  bad = scene;
  std::get<Contact>(bad.effects.back()).collider[1].body = 7;
  CHECK_THROWS_WITH(Workspace(bad, Method{}), Catch::Contains("body[1]") && Catch::Contains("7"));
}

TEST_CASE("shapes, frames and laws that are none are refused by what they are and where") {
  using Change = void (*)(Contact&);
  const std::vector<std::pair<Change, std::vector<std::string>>> mistakes{
      {[](Contact& c) { c.collider[1].shape = Sphere{std::nan("")}; }, {"shape[1]", "radius", "nan", "> 0"}},
      {[](Contact& c) {
         c.collider[1].shape = Box{{1, -1, 1}};
       },
       {"shape[1]", "size", "got -1"}},
      {[](Contact& c) {
         c.collider[1].shape = Capsule{0.1, infinity};
       },
       {"shape[1]", "length", "inf"}},
      {[](Contact& c) {
         c.collider[1].shape = Cylinder{0, 1};
       },
       {"shape[1]", "radius", "got 0"}},
      {[](Contact& c) { c.collider[0].frame.origin.x() = infinity; }, {"frame origin[0]", "inf"}},
      {[](Contact& c) { c.collider[0].frame.rotation *= 1.001; }, {"frame rotation[0]", "a rotation"}},
      {[](Contact& c) { c.collider[0].frame.rotation *= -1; }, {"frame rotation[0]", "determinant -1"}},
      {[](Contact& c) { c.collider[1].surface_velocity.y() = infinity; }, {"surface velocity[1]", "inf"}},
      {[](Contact& c) { c.law[3].compliance = -1; }, {"compliance[3]", "got -1"}},
      {[](Contact& c) { c.law[3].damping = std::nan(""); }, {"damping[3]", "nan"}},
      {[](Contact& c) { c.law[2].friction = 0.1; }, {"law[1]", "symmetric"}},
  };
  for (const auto& [change, parts] : mistakes) {
    Scene scene = sliding_box(0, 0.5, 1);
    auto& contact = std::get<Contact>(scene.effects.back());
    contact.materials = 2;
    contact.law.assign(4, ContactLaw{});
    CHECK_NOTHROW(Workspace(scene, Method{}));
    change(contact);
    for (const std::string& part : parts)
      CHECK_THROWS_WITH(Workspace(scene, Method{}), Catch::Contains(part));
  }
}

TEST_CASE("materials of triangles are one each, known ones, and one where they share a node") {
  Scene scene;
  Contact contact;
  contact.materials = 2;
  contact.law.assign(4, ContactLaw{});
  for (int i = 0; i < 7; ++i) add_node(scene, Vec3(i, i % 2, 0), 1);
  contact.triangle = {{0, 1, 2}, {4, 5, 6}, {1, 2, 3}};
  const auto with = [&](const std::vector<int>& materials) {
    contact.triangle_material = materials;
    scene.effects = {contact};
    return scene;
  };
  for (const std::vector<int>& materials : {std::vector<int>{}, {0, 0, 0}, {1, 0, 1}})
    CHECK_NOTHROW(validate(with(materials)));
  const std::vector<std::pair<std::vector<int>, std::vector<std::string>>> mistakes{
      {{0, 0}, {"triangle_material", "got 2 entries", "3"}},
      {{0, 2, 0}, {"triangle_material[1]", "got 2", "from 0 to 1"}},
      {{0, -1, 0}, {"triangle_material[1]", "got -1"}},
      {{0, 0, 1}, {"triangle_material[2]", "got 1", "0, that of triangle 0, which has node 1, too"}},
  };
  for (const auto& [materials, parts] : mistakes)
    for (const std::string& part : parts) CHECK_THROWS_WITH(validate(with(materials)), Catch::Contains(part));
}

TEST_CASE("a body's own centre does not touch its shape") {
  Scene scene = sliding_box(0, 0.5, 0);
  auto& contact = std::get<Contact>(scene.effects.back());
  contact.node = {scene.bodies[1].node};
  contact.radius = {0.01};
  contact.node_material = {0};
  const State end = run(scene, contact_method("direct"), 0.01, 5);
  CHECK((end.x - scene.initial.x).norm() <= 1e-9);
}
