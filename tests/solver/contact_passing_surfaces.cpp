// Deformable surfaces that would pass each other within a step.
#include <random>

#include "body_scenes.h"
#include "contact_runs.h"
#include "mesh.h"
#include "surface_depth.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double sheet_thickness = 2e-3, h = 0.01;

/// A loose sheet of 0.2 m that flies at a fixed one of 0.8 m in the plane z = 0.
Scene flight(TriangleMesh loose, const Points& velocity) {
  TriangleMesh target = grid_sheet({4, 4}, {0.8, 0.8});
  target.x.colwise() -= Vec3(0.4, 0.4, 0);
  Scene scene;
  Contact contact;
  contact.thickness = sheet_thickness;
  contact.law[0].friction = 0.3;
  contact.recovery = 0;
  const auto add = [&](const TriangleMesh& mesh) {
    const int first = add_sheet_nodes(scene, mesh, 0.5);
    for (const auto& [a, b, c] : mesh.triangles)
      contact.triangle.push_back({first + a, first + b, first + c});
    return first;
  };
  add(target);
  std::fill(scene.mass.begin(), scene.mass.end(), infinity);
  const int first = add(loose);
  scene.initial.v.rightCols(loose.x.cols()) = velocity;
  scene.effects.emplace_back(sheet_links(loose, first, 1e-5));
  scene.effects.emplace_back(contact);
  return scene;
}

TriangleMesh loose_sheet() {
  TriangleMesh mesh = grid_sheet({2, 2}, {0.2, 0.2});
  mesh.x.colwise() -= Vec3(0.1, 0.1, 0);
  return mesh;
}

/// From above, by `way` (m) a step.
Scene fall(double way, std::mt19937_64& engine) {
  std::uniform_real_distribution<> part(-1, 1);
  const auto random = [&] { return Vec3(part(engine), part(engine), part(engine)); };
  TriangleMesh loose = loose_sheet();
  const Vec3 axis = random();
  loose.x = (Eigen::AngleAxisd(3 * axis.norm(), axis.normalized()).toRotationMatrix() * loose.x).eval();
  const double height = 0.15 + 0.5 * way * (1 + part(engine));
  loose.x.colwise() += Vec3(0.2 * part(engine), 0.2 * part(engine), height);
  Points velocity(3, loose.x.cols());
  for (auto v : velocity.colwise()) v = way / h * (Vec3(0, 0, -1) + 0.1 * random());
  return flight(loose, velocity);
}

/// That an edge goes through a triangle, or the loose sheet's middle has passed the fixed one.
bool is_through(const Scene& scene, const State& state) {
  const auto& triangles = std::get<Contact>(scene.effects.back()).triangle;
  for (const auto& found : reference::surface_overlaps(triangles, state.x, sheet_thickness, 0))
    if (found.kind == reference::SurfaceOverlap::Kind::through) return true;
  const Vec3 from = scene.initial.x.rightCols(9).rowwise().mean(), to = state.x.rightCols(9).rowwise().mean();
  const Vec3 at = from + from.z() / (from.z() - to.z()) * (to - from);
  return to.z() < 0 && at.head<2>().cwiseAbs().maxCoeff() <= 0.3;
}

}  // namespace

TEST_CASE("no deformable surface passes another within a solved step") {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<> part(0, 1);
  int through = 0, solved = 0, stopped = 0;
  constexpr int flights = 30;
  for (int k = 0; k < flights; ++k) {
    const double way = 0.2 * std::pow(10.0, -0.7 + 1.4 * part(engine));  // m, up to five sizes
    const Scene scene = fall(way, engine);
    Workspace workspace(scene, contact_method("direct"));
    State state = scene.initial;
    if (step(workspace, h, state).status != Status::ok) continue;
    ++solved;
    through += is_through(scene, state);
    const double free = (scene.initial.x + h * scene.initial.v).rightCols(9).row(2).mean();
    stopped += free < 0 && state.x.rightCols(9).row(2).mean() > 0;
  }
  INFO("of " << flights << " solved " << solved << " stopped " << stopped);
  CHECK(through == 0);
  CHECK(solved > flights / 2);
  CHECK(stopped > flights / 5);
}

// By less than a tenth of the thickness; more would take energy that it has not. The step at height 0.05 and
// way 0.2 takes about all of `max_outer`: another rounding may miss it.
TEST_CASE(
    "a sheet that slides over the border of another and too near to its plane is lifted or held there") {
  for (const double height : {0.95, 0.8, 0.5, 0.05, -0.5})
    for (const double way : {0.11, 0.2, 0.3}) {
      if (height < 0.5 && way > 0.2) continue;  // a step that crushes the sheet may miss
      TriangleMesh loose = loose_sheet();
      loose.x.colwise() += Vec3(-0.6, 0.03, height * sheet_thickness);  // 0.1 m beside it
      const Scene scene = flight(loose, Vec3(way / h, 0, 0).replicate(1, loose.x.cols()));
      Workspace workspace(scene, contact_method("direct"));
      State state = scene.initial;
      const Report report = step(workspace, h, state);
      INFO("height " << height << " way " << way << " " << report.reason);
      REQUIRE(report.status == Status::ok);
      const auto& triangles = std::get<Contact>(scene.effects.back()).triangle;
      const double missed = 1e-3 * sheet_thickness;
      CHECK(reference::surface_overlaps(triangles, state.x, sheet_thickness, missed).empty());
    }
}

// One on edge over the other, 1 mm above touch, crossed by 0.01 rad: by 50 mm beside they cross 5 m off.
TEST_CASE("edges that are nearly parallel do not hold triangles that have parted sideways") {
  Scene scene;
  Contact contact;
  contact.thickness = sheet_thickness;
  for (const Vec3& x : {Vec3(-0.5, 0, 0), Vec3(0.5, 0, 0), Vec3(0, 0, -1)}) add_node(scene, x, infinity);
  for (const Vec3& x : {Vec3(-0.4, -0.004, 0), Vec3(0.4, 0.004, 0), Vec3(0, 0, 1)})
    add_node(scene, x + Vec3(0, 0, sheet_thickness + 1e-3), 1, Vec3(0, 5, -1));
  contact.triangle = {{0, 1, 2}, {3, 4, 5}};
  scene.effects.emplace_back(contact);
  Workspace workspace(scene, contact_method("direct"));
  State state = scene.initial;
  REQUIRE(step(workspace, h, state).status == Status::ok);
  CHECK((state.v - scene.initial.v).norm() <= 1e-12);
}

// How far apart they are was seen while they were at rest; it says nothing of what they do then.
TEST_CASE("a sheet that flies to another from afar in one step stops at it") {
  constexpr double height = 0.15;  // m
  TriangleMesh loose = loose_sheet();
  loose.x.row(2).setConstant(height);
  const Scene scene = flight(loose, Points::Zero(3, loose.x.cols()));
  Workspace workspace(scene, Method{});
  State state = scene.initial;
  for (int k = 0; k < 3; ++k) REQUIRE(step(workspace, h, state).status == Status::ok);
  CHECK(state.x == scene.initial.x);
  auto flying = state.v.rightCols(loose.x.cols());
  flying.row(2).setConstant(-2 * height / h);
  REQUIRE(step(workspace, h, state).status == Status::ok);
  CHECK(state.x.rightCols(loose.x.cols()).row(2).minCoeff() >= sheet_thickness * (1 - 1e-6));
}
