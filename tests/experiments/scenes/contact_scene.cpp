// Contact in scene files: what is read, and forces that statics tells.
#include <catch2/catch.hpp>

#include <fmt/format.h>
#include "harness/contact_sums.h"

#include "harness/probes.h"
#include "results.h"
#include "scenes/contacts.h"
#include "scenes/scene_file.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using pbd::Vec3;

namespace {

SceneFile read_contact_scene(const std::string& text) {
  const TemporaryFolder folder;
  return read_scene_file(folder.write("scene.toml", text + "[step]\nstep_s = 0.01\nsteps = 30\n"));
}

/// The state and the probes after `steps` steps that all say ok.
struct Run {
  pbd::State state;
  std::vector<Cell> probes;
  std::size_t contacts = 0;

  Run(const SceneFile& file, std::int64_t steps) : state(file.scene.initial) {
    pbd::Workspace workspace(file.scene, file.method);
    for (std::int64_t k = 0; k < steps; ++k)
      REQUIRE(pbd::step(workspace, file.step_s, state).status != pbd::Status::diverged);
    append_probes(file, state, &workspace, probes);
    contacts = workspace.contacts().size();
  }
  double number(std::size_t i) const { return std::get<double>(probes.at(i)); }
  Vec3 vector(std::size_t i) const { return {number(i), number(i + 1), number(i + 2)}; }
};

const std::string stone_and_wood = R"(
[gravity]
[gyroscopic]
[[rigid_body]]
name = "ground"
shape = "half_space"
rotation_rad = [0, 0.1, 0]
material = "stone"
[[rigid_body]]
name = "box"
shape = "box"
size_m = [0.2, 0.3, 0.1]
mass_kg = 4
position_m = [0, 0, 0.1]
velocity_m_s = [1, 0, -1]
angular_velocity_rad_s = [0.5, 0, 0.25]
material = "wood"
[[rigid_body]]
name = "ball"
shape = "sphere"
radius_m = 0.1
mass_kg = 1
position_m = [0, 0, 0.3]
material = "wood"
[contact]
friction = 0.4
restitution = 0.25
margin_m = 0.01
recovery_m_s = 2
[[contact.pair]]
materials = ["wood", "stone"]
friction = 0.7
[[contact.pair]]
materials = ["wood", "wood"]
stiffness_n_per_m = 8192
damping_s = 0.01
restitution = 0
[method]
relaxation = "direct"
)";
}  // namespace

TEST_CASE("a scene of contact in a file moves as the same one built by hand does, bit for bit") {
  auto file = read_contact_scene(stone_and_wood);

  const pbd::ContactLaw all{.friction = 0.4, .restitution = 0.25};
  BodyScene build(all);
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.1, Vec3::UnitY()).toRotationMatrix();
  build.fixed(HalfSpace{}, {Vec3::Zero(), Eigen::Quaterniond(tilt).normalized()}, 1);
  build.box({0.2, 0.3, 0.1}, 4, {{0, 0, 0.1}, Eigen::Quaterniond::Identity(), {1, 0, -1}, {0.5, 0, 0.25}}, 2);
  build.ball(0.1, 1, {Vec3(0, 0, 0.3)}, 2);
  build.materials(3, all);
  build.law(1, 2, {.friction = 0.7, .restitution = 0.25});
  build.law(2, 2, {.friction = 0.4, .compliance = 1.0 / 8192, .damping = 0.01});
  build.contact().margin = 0.01;
  build.contact().recovery = 2;
  const Run of_file(file, file.steps);
  file.scene = build.finish();
  const Run by_hand(file, file.steps);
  CHECK(of_file.state.x == by_hand.state.x);
  CHECK(of_file.state.v == by_hand.state.v);
  CHECK(of_file.state.spin == by_hand.state.spin);
  for (const std::size_t body : {0, 1, 2})
    CHECK(of_file.state.orientation[body].coeffs() == by_hand.state.orientation[body].coeffs());
}

TEST_CASE("nodes of every kind of table touch, all of them or those that are chosen") {
  const auto file = read_contact_scene(R"(
[contact]
thickness_m = 0.02
[[particle]]
position_m = [0, 0, 1]
mass_kg = 1
contact = {}
[particles]
position_m = [[0, 0, 2], [0, 0, 3], [0, 0, 4]]
mass_kg = 1
contact = { nodes = [2, 0], radius_m = 0.25 }
[[chain]]
links = 2
length_m = 1
mass_kg = 1
[[cloth]]
cells = [1, 1]
size_m = [1, 1]
area_density_kg_m2 = 1
contact = { radius_m = 0.5, material = "silk" }
[[solid]]
cells = [2, 2, 2]
size_m = [1, 1, 1]
density_kg_m3 = 1
young_pa = 1
poisson = 0
contact = { material = "silk" }
[[cloth]]
cells = [1, 1]
size_m = [1, 1]
area_density_kg_m2 = 1
contact = { material = "silk", surface = true }
[[solid]]
cells = [2, 2, 2]
size_m = [1, 1, 1]
density_kg_m3 = 1
young_pa = 1
poisson = 0
contact = { material = "wool", surface = true }
[[contact.pair]]
materials = ["silk", "wool"]
friction = 0.25
)");
  const auto* contact = contact_of(file.scene);
  REQUIRE(contact != nullptr);
  std::vector<int> expected{0, 3, 1, 7, 8, 9, 10};  // the chain has the nodes 4 to 6
  for (int node = 0; node < 27; ++node)
    if (node != 13) expected.push_back(15 + node);  // all but the middle one
  CHECK(contact->node == expected);
  CHECK(std::vector(contact->radius.begin(), contact->radius.begin() + 8) ==
        std::vector<double>{0, 0.25, 0.25, 0.5, 0.5, 0.5, 0.5, 0});
  CHECK(contact->node_material[2] == 0);
  CHECK(contact->node_material[3] == 1);
  CHECK(contact->triangle.size() == 2 + 6 * 2 * 4);
  std::vector<int> of_silk_and_wool(2, 1);
  of_silk_and_wool.resize(contact->triangle.size(), 2);
  CHECK(contact->triangle_material == of_silk_and_wool);
  const std::size_t cloth = contact->node.size(), solid = cloth + 2;
  CHECK(contact->between(cloth, solid).friction == 0.25);
  CHECK(contact->between(solid, solid).friction == 0.5);
  for (const auto& triangle : contact->triangle)
    for (const int node : triangle)
      CHECK(((node >= 11 && node < 15) || (node >= 42 && node < 69 && node != 55)));
  CHECK(contact->thickness == 0.02);
  CHECK(contact->recovery == pbd::infinity);
  CHECK(contact->law.size() == 9);
  CHECK(contact->law[0].friction == 0.5);
}

TEST_CASE("bodies that are kept out or apart do not touch, and no scene has contact without its table") {
  const std::string ball = "shape = \"sphere\"\nradius_m = 0.1\nmass_kg = 1\n";
  const std::string bodies = "[[rigid_body]]\nname = \"ground\"\nshape = \"half_space\"\n[gravity]\n" +
                             ("[[rigid_body]]\nname = \"ghost\"\nposition_m = [0, 0, 0.1]\n" + ball) +
                             "%[[rigid_body]]\nname = \"rests\"\nposition_m = [1, 0, 0.1]\n" + ball +
                             "[[rigid_body]]\nname = \"falls\"\nposition_m = [2, 0, 0.1]\n" + ball;
  const auto with = [&](const std::string& line) {
    std::string text = bodies;
    return text.replace(text.find('%'), 1, line);
  };
  const double fallen = -gravity * 0.01 * 0.01 * (1 + 2 + 3);
  const Run some(read_contact_scene(with("contact = false\n") +
                                    "[contact]\n[[contact.apart]]\nbodies = [\"falls\", \"ground\"]\n"),
                 3);
  CHECK(some.state.x(2, 1) - 0.1 == Approx(fallen));
  CHECK(some.state.x(2, 2) == Approx(0.1));
  CHECK(some.state.x(2, 3) - 0.1 == Approx(fallen));
  const auto without = read_contact_scene(with(""));
  CHECK(contact_of(without.scene) == nullptr);
  CHECK(Run(without, 3).state.x(2, 2) - 0.1 == Approx(fallen));
}

// The plane presses with m g cos(angle) along its normal and holds with m g sin(angle) uphill.
TEST_CASE("friction holds the box on the incline with m g sin(angle)") {
  const auto file = read_scene_file(scenes / "incline.toml");
  const double angle = 0.4, weight = 4 * gravity;
  CHECK(probe_columns(file) == std::vector<std::string>{"box_x_m", "box_y_m", "box_z_m",
                                                        "box_contact_force_x_n", "box_contact_force_y_n",
                                                        "box_contact_force_z_n", "box_friction_force_x_n",
                                                        "box_friction_force_y_n", "box_friction_force_z_n",
                                                        "contacts", "least_gap_m"});
  const Run run(file, file.steps);
  CHECK((run.vector(0) - 0.05 * Vec3(std::sin(angle), 0, std::cos(angle))).norm() <= 1e-9);
  CHECK((run.vector(3) - Vec3(0, 0, weight)).norm() <= 1e-7 * weight);
  const Vec3 uphill(-std::cos(angle), 0, std::sin(angle));
  CHECK((run.vector(6) - weight * std::sin(angle) * uphill).norm() <= 1e-7 * weight);
  CHECK(std::get<std::int64_t>(run.probes[9]) >= 3);  // its centre lies within what presses
  CHECK(std::get<std::int64_t>(run.probes[9]) <= 4);
  CHECK(std::abs(run.number(10)) <= 1e-9);

  std::vector<Cell> start;
  append_probes(file, file.scene.initial, nullptr, start);
  for (std::size_t i = 3; i < 11; ++i) CHECK(std::get<std::string>(start.at(i)).empty());
}

TEST_CASE("the ground carries the stack, and the third box the top") {
  const auto file = read_scene_file(scenes / "stack.toml");
  const Run run(file, 10);
  const double top = 1000 * gravity, all = 1003 * gravity;
  CHECK((run.vector(3) + Vec3(0, 0, all)).norm() <= 1e-6 * all);
  CHECK(run.vector(6).norm() <= 1e-6 * all);
  CHECK((run.vector(9) - Vec3(0, 0, top)).norm() <= 1e-6 * top);
  CHECK((run.vector(0) - Vec3(0, 0, 0.7)).norm() <= 1e-8);
  const auto& contact = *contact_of(file.scene);
  CHECK(contact.between(0, 1).friction == 0.9);  // ground, first
  CHECK(contact.between(1, 2).friction == 0.4);
  CHECK(probe_columns(file)[9] == "top_third_contact_force_x_n");
}

TEST_CASE("the cloth meets the ball, and both are written for ParaView") {
  const TemporaryFolder folder;
  const auto ran = run_program({"simulate", scenes / "cloth_on_ball.toml", "--set", "step.duration_s=0.12",
                                "--export", "vtk", "-o", folder.path});
  CHECK(ran.exit_code == 0);
  for (const auto* frame : {"frame_000024.vtu", "bodies_000024.vtu"})
    CHECK(std::filesystem::exists(folder.path / "frames" / frame));
  CHECK_THAT(read_text(folder.path / "frames" / "bodies_000024.vtu"),
             Catch::Contains("NumberOfPoints=\"482\""));  // the ball's 15 x 32 + 2, none of the ground
  const auto file = read_scene_file(scenes / "cloth_on_ball.toml");
  const Run run(file, 24);
  const std::string touching = read_text(folder.path / "frames" / "contacts_000024.vtu");
  CHECK_THAT(touching, Catch::Contains(fmt::format("NumberOfPoints=\"{}\"", run.contacts)));
  for (const auto* name : {"force", "impulse", "normal", "slip", "gap"})
    CHECK_THAT(touching, Catch::Contains(fmt::format("Name=\"{}\"", name)));
  const auto force = array_of(touching, "force"), impulse = array_of(touching, "impulse");
  REQUIRE(force.size() == 3 * run.contacts);
  REQUIRE(impulse.size() == force.size());
  for (std::size_t i = 0; i < force.size(); ++i) CHECK(impulse[i] == Approx(0.005 * force[i]).margin(1e-15));
  CHECK(std::abs(run.number(5) - gravity) <= 1e-3);  // of 1 kg at rest, whatever presses it from above
  CHECK(run.state.x(2, 84) >= 0.2 + 0.005 - 1e-4);   // the cloth's middle node stays above the ball
}

TEST_CASE("the scenes of soft and rigid things in contact solve all their steps, and none is refuted") {
  const std::string scene =
      GENERATE("box_on_soft_block", "soft_cubes", "trampoline", "dominoes", "strip_over_cylinder",
               "soft_block_on_box_on_cloth", "cable_arm", "ragdoll");
  const TemporaryFolder folder;
  const auto ran = run_program(
      {"simulate", scenes / (scene + ".toml"), "--set", "step.duration_s=0.5", "--check", "-o", folder.path});
  INFO(scene << "\n" << ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Catch::Contains("none refuted"));
  CHECK_THAT(ran.err, !Catch::Contains("missed"));
}
