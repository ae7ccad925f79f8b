// Contact of cloth with itself and with other cloth.
#include "body_scenes.h"
#include "contact_runs.h"
#include "linear/linear_names.h"
#include "mesh.h"
#include "side_by_side.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double thickness = 2e-3;

struct Sheets {
  Scene scene;
  Contact contact;

  explicit Sheets(double friction = 0.3) {
    contact.thickness = thickness;
    contact.law[0].friction = friction;
  }

  /// Returns the first node. Fixed sheets have no links.
  int add(const TriangleMesh& mesh, bool fixed = false) {
    const int first = add_sheet_nodes(scene, mesh, 0.5);
    for (auto [a, b, c] : mesh.triangles) contact.triangle.push_back({first + a, first + b, first + c});
    if (fixed)
      for (Eigen::Index i = 0; i < mesh.x.cols(); ++i)
        scene.mass[static_cast<std::size_t>(first + i)] = infinity;
    else
      scene.effects.emplace_back(sheet_links(mesh, first, 1e-5));
    return first;
  }

  Scene finish() {
    scene.effects.emplace_back(Gravity{});
    scene.effects.emplace_back(contact);
    return scene;
  }
};

}  // namespace

TEST_CASE("cloth that falls freely feels nothing of itself, flat or bent, however it is turned") {
  for (const auto& [radius, turned] : {std::pair{infinity, 0.0},
                                       {0.2, 0.0},
                                       {0.05, 0.0},
                                       {infinity, 0.3},
                                       {0.2, 0.3},
                                       {0.05, 0.3},
                                       {0.05, 1.1},
                                       {0.05, 2.0}}) {
    TriangleMesh mesh = grid_sheet({12, 4}, {0.3, 0.1});
    for (Eigen::Index i = 0; i < mesh.x.cols() && std::isfinite(radius); ++i) {
      const double angle = mesh.x(0, i) / radius;  // up to six: a tube that does not close
      mesh.x(0, i) = radius * std::sin(angle);
      mesh.x(2, i) = radius * std::cos(angle);
    }
    // Parallel edges cross by rounding alone.
    mesh.x = (Eigen::AngleAxisd(turned, Vec3(1, 2, 3).normalized()).toRotationMatrix() * mesh.x).eval();
    Sheets sheets;
    sheets.add(mesh);
    const Scene scene = sheets.finish();
    const Method method = contact_method("direct");
    constexpr double h = 0.01;
    constexpr int steps = 10;
    const State end = run(scene, method, h, steps);
    Points expected = scene.initial.x;
    expected.row(2).array() -= gravity * h * h * steps * (steps + 1) / 2;
    INFO("radius " << radius << " turned " << turned);
    CHECK((end.x - expected).cwiseAbs().maxCoeff() <= 1e-11);
  }
}

TEST_CASE("a sheet on another is carried, a thickness above it") {
  Sheets sheets;
  TriangleMesh table = grid_sheet({4, 4}, {0.4, 0.4}), cloth = grid_sheet({6, 6}, {0.2, 0.2});
  const auto centre = [](TriangleMesh& mesh) { mesh.x.colwise() -= mesh.x.rowwise().mean().eval(); };
  centre(table);
  centre(cloth);
  cloth.x = (Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix() * cloth.x).eval();
  cloth.x.row(2).array() += 0.004;
  sheets.add(table, true);
  const int first = sheets.add(cloth);
  const Scene scene = sheets.finish();
  const Method method = contact_method("direct");
  Workspace workspace(scene, method);
  const State end = run(scene, method, 0.005, 20, workspace);
  const Points x = end.x.middleCols(first, cloth.x.cols());
  CHECK(x.row(2).minCoeff() >= thickness - 1e-9);
  CHECK(x.row(2).maxCoeff() <= thickness + 1e-9);
  Vec3 carried = Vec3::Zero();
  for (const ContactForce& contact : workspace.contacts())
    carried += contact.normal.z() * contact.force.z() > 0 && contact.force.z() > 0 ? contact.force
                                                                                   : Vec3(-contact.force);
  CHECK(std::abs(carried.z() / weight(scene) - 1) <= 1e-8);
}

TEST_CASE("deformable surfaces rest on each other") {
  // A loose triangle above a fixed one; and two crossing edges of thin triangles.
  for (const bool edges : {false, true}) {
    Scene scene;
    Contact contact;
    constexpr double thickness = 0.01, height = thickness + 1e-3;
    const auto triangle = [&](const Vec3& a, const Vec3& b, const Vec3& c, double mass) {
      const int first = add_node(scene, a, mass);
      add_node(scene, b, mass);
      add_node(scene, c, mass);
      contact.triangle.push_back({first, first + 1, first + 2});
      return first;
    };
    triangle(edges ? Vec3(0, -1, 0) : Vec3(-1, -1, 0), edges ? Vec3(0, 1, 0) : Vec3(1, -1, 0),
             edges ? Vec3(0, 0, -1) : Vec3(0, 1, 0), infinity);
    const int upper = edges ? triangle(Vec3(-1, 0, height), Vec3(1, 0, height), Vec3(0, 0, 1), 1)
                            : triangle(Vec3(0, 0, height), Vec3(0.1, 0, 1), Vec3(0, 0.1, 1), 1);
    Distance links;
    for (const auto& [a, b] : {std::array{0, 1}, std::array{1, 2}, std::array{0, 2}}) {
      links.node.push_back({upper + a, upper + b});
      links.rest_length.push_back((scene.initial.x.col(upper + a) - scene.initial.x.col(upper + b)).norm());
      links.compliance.push_back(0);
    }
    contact.thickness = thickness;
    contact.law[0].friction = 0.3;
    contact.collider.push_back({Sphere{1}, add_body(scene, Vec3(9, 0, 0), 1, Vec3::Ones())});
    scene.effects = {Gravity{}, links, contact};
    const Method method = contact_method("direct");
    Workspace workspace(scene, method);
    constexpr double h = 0.01;
    State end = run(scene, method, h, 2, workspace);
    const Points before = end.v;
    REQUIRE(step(workspace, h, end).status == Status::ok);
    double carried = 0, gap = 1;
    Vec3 on_upper = Vec3::Zero();
    for (const ContactForce& each : workspace.contacts()) {
      CHECK(std::min(each.collider[0], each.collider[1]) >= 1);  // nodes, counted behind the sphere
      on_upper += each.collider[0] - 1 >= upper ? each.force : -each.force;
      carried += std::abs(each.force.z());
      gap = std::min(gap, each.gap);
    }
    const Vec3 gained = (end.v - before).middleCols<3>(upper).rowwise().sum() / h;  // times 1 kg
    CHECK((gained - 3 * Vec3(0, 0, -gravity) - on_upper).norm() <= 1e-7 * gravity);
    INFO((edges ? "edges" : "node and triangle"));
    CHECK(gap >= -1e-10);
    CHECK(carried > gravity);
    CHECK(std::abs(end.x(2, upper) - thickness) <= 1e-8);
  }
}

TEST_CASE("contacts that nothing can move have no impulse and leave the others theirs") {
  for (const std::string_view relaxation : general_solver_names()) {
    INFO(relaxation);
    Sheets sheets;
    TriangleMesh lower = grid_sheet({2, 2}, {0.4, 0.4}), upper = lower;
    upper.x.row(2).array() += thickness / 2;  // they overlap, and both are fixed
    upper.x = (Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix() * upper.x).eval();
    sheets.add(lower, true);
    sheets.add(upper, true);
    sheets.contact.collider.push_back({HalfSpace{}, add_world(sheets.scene)});
    const int ball = add_body(sheets.scene, Vec3(-1, 0, 0.1), 1, Vec3::Ones());
    sheets.contact.collider.push_back({Sphere{0.1}, ball});
    const Scene scene = sheets.finish();
    Workspace workspace(scene, contact_method(relaxation));
    State state = scene.initial;
    REQUIRE(step(workspace, 0.01, state).status == Status::ok);
    int fixed = 0;
    for (const ContactForce& contact : workspace.contacts()) {
      CHECK(contact.force.allFinite());
      fixed += contact.gap < 0;
    }
    CHECK(fixed > 0);
    CHECK(ground_force(workspace).z() == Approx(weight(scene)));
  }
}

TEST_CASE("edges that meet side by side in one plane stop each other by their ends") {
  const double leaning = GENERATE(0.0, 1e-12, 5e-4), h = 0.01, gap = 5e-3;
  const State end = run(side_by_side(leaning), contact_method("direct"), h, 1);
  CHECK(std::abs(end.v(0, 0) - gap / h) <= 1e-9);
  CHECK(std::abs(end.v(0, 1) - (gap + leaning) / h) <= 1e-9);
  CHECK(std::abs(end.v(0, 2) - 0.6) <= 1e-12);
}
