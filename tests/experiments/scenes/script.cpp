// Forces, motors and bodies that change with time, against the integrals of their courses.
#include "scenes/script.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <utility>

#include "harness/stepper.h"
#include "program.h"
#include "scenes/scene_file.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using pbd::Vec3;

namespace {

constexpr double course_h = 0.04;

const std::string course_step = "[step]\nstep_s = 0.04\nsteps = 100\n[method]\ntolerance = 1e-11\n";

/// Calls check(state) at the end of every step.
template <class Check>
void run(const std::string& text, const std::string& method, Check&& check) {
  const TemporaryFolder folder;
  SceneFile file =
      read_scene_file(folder.write("scene.toml", text + course_step), {"method.integrator=" + method});
  const pbd::Scene stated = file.scene;
  pbd::Workspace workspace(file.scene, file.method);
  pbd::State state = stated.initial;
  for (std::int64_t k = 0; k < file.steps; ++k) {
    file.script.begin_step(stated, file.step_s, file.scene, state);
    file.script.hand_on(file.scene, file.step_s, state.time, workspace);
    REQUIRE(pbd::step(workspace, file.step_s, state).status == pbd::Status::ok);
    check(state);
  }
}

/// Integral of the course [[0.5, 0], [1.5, 2], [2.5, 2], [3, -1]] from 0 to t.
double integral(double t) {
  const auto part = [&](double from, double to) { return std::clamp(t, from, to) - from; };
  const double up = part(0.5, 1.5), flat = part(1.5, 2.5), down = part(2.5, 3), last = part(3, 1e9);
  return up * up + 2 * flat + 2 * down - 3 * down * down - last;
}
const std::string course = "over_time = [[0.5, 0], [1.5, 2], [2.5, 2], [3, -1]]\n";

const std::vector<std::string> scripted_integrators{"implicit_euler", "newmark", "midpoint",
                                                    "symplectic_euler"};

}  // namespace

TEST_CASE("a course is integrated exactly, constant before its first time and after its last") {
  const Course made{{0.5, 1.5, 2.5, 3}, {0, 2, 2, -1}};
  for (double t = 0; t < 4; t += 0.07) CHECK(made.integral(t) == Approx(integral(t)).margin(1e-14));
  const Course constant{{7}, {3}};
  CHECK(constant.integral(2) == Approx(6));
  CHECK(constant.mean(6, 9) == Approx(3));
}

// v_k = (F/m) times the integral, x_n = h sum v_k under implicit Euler.
TEST_CASE("a course jumps where it changes much within less than a step, not where a fine table tells it") {
  const Course jump{{0.3, 0.300001}, {0, 1}};
  CHECK(jump.jumps(0.295, 0.305));
  CHECK(jump.jumps(0.305, 0.315));  // the mean of the whole step is another one
  CHECK(!jump.jumps(0.28, 0.29));
  CHECK(!jump.jumps(0.32, 0.33));
  Course sine;
  for (int k = 0; k <= 500; ++k) {
    sine.time.push_back(0.002 * k);
    sine.value.push_back(std::sin(3 * sine.time.back()));
  }
  for (int k = 0; k < 100; ++k) CHECK(!sine.jumps(0.01 * k, 0.01 * (k + 1)));
  CHECK(!Course{{0, 1}, {2, 2}}.jumps(0, 2));
}

TEST_CASE("a force over time gives the momentum of its integral, and implicit Euler's places") {
  const std::string scene =
      "[[particle]]\nposition_m = [1, 0, 0]\nmass_kg = 0.5\n[[force]]\nnode = 0\nforce_n = [0, 3, 0]\n" +
      course;
  for (const auto& integrator : scripted_integrators) {
    INFO(integrator);
    double place = 0;
    run(scene, integrator, [&](const pbd::State& state) {
      const double speed = 3 / 0.5 * integral(state.time);
      place += course_h * speed;
      CHECK(state.v(1, 0) == Approx(speed).margin(1e-12));
      if (integrator == "implicit_euler") CHECK(state.x(1, 0) == Approx(place).margin(1e-12));
    });
  }
}

TEST_CASE("a torque over time gives the angular momentum of its integral") {
  run("[[rigid_body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 0.5]\n[[torque]]\nbody = \"a\"\n"
      "torque_n_m = [0, 0, 0.2]\n" +
          course,
      "implicit_euler", [&](const pbd::State& state) {
        CHECK(state.spin(2, 0) == Approx(0.2 / 0.5 * integral(state.time)).margin(1e-12));
      });
}

TEST_CASE("a moving body is where the integral of its velocities is, under every integrator") {
  for (const auto& integrator : scripted_integrators) {
    INFO(integrator);
    run("[[rigid_body]]\nname = \"a\"\nheld = \"moving\"\nposition_m = [1, 2, 3]\nvelocity_m_s = [0, 4, 0]\n"
        "angular_velocity_rad_s = [0.3, 0, 0.4]\n" +
            course + "[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n",
        integrator, [&](const pbd::State& state) {
          const double length = integral(state.time);
          CHECK((state.x.col(1) - Vec3(1, 2 + 4 * length, 3)).norm() < 1e-12);
          const Eigen::Quaterniond expected(Eigen::AngleAxisd(0.5 * length, Vec3(0.6, 0, 0.8)));
          CHECK(state.orientation[0].angularDistance(expected) < 1e-7);  // of acos near 1
        });
  }
}

TEST_CASE("a body is led through its poses, on straight ways and the shorter turns, under every integrator") {
  const Vec3 place[]{{1, 2, 3}, {2, 2, 3}, {2, -1, 3}};
  const double time[]{0, 0.5, 1.7};
  const Eigen::Quaterniond turn[]{Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Vec3::UnitZ())),
                                  Eigen::Quaterniond(Eigen::AngleAxisd(1.2, Vec3::UnitX())),
                                  Eigen::Quaterniond(Eigen::AngleAxisd(-2, Vec3::UnitY()))};
  for (const std::string integrator :
       {"implicit_euler", "newmark", "midpoint", "symplectic_euler", "bdf2", "generalised_alpha"}) {
    INFO(integrator);
    Vec3 last_place = place[0], last_velocity = Vec3::Zero();
    Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();  // of the body's frame in the shape's
    bool first = true;
    run("[[rigid_body]]\nname = \"a\"\nshape = \"box\"\nsize_m = [3, 1, 2]\nheld = \"moving\"\n"
        "position_m = [1, 2, 3]\nrotation_rad = [0, 0, 0.2]\n"
        "[[rigid_body.pose]]\ntime_s = 0.5\nposition_m = [2, 2, 3]\nrotation_rad = [1.2, 0, 0]\n"
        "[[rigid_body.pose]]\ntime_s = 1.7\nposition_m = [2, -1, 3]\nrotation_rad = [0, -2, 0]\n"
        "[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n",
        integrator, [&](const pbd::State& state) {
          const double t = std::min(state.time, time[2]);
          const int k = t < time[1] ? 1 : 2;
          const double share = (t - time[k - 1]) / (time[k] - time[k - 1]);
          CHECK((state.x.col(1) - (1 - share) * place[k - 1] - share * place[k]).norm() < 1e-12);
          // From the last pose about one axis, by the share of the angle.
          const Eigen::AngleAxisd whole(turn[k - 1].conjugate() * turn[k]);
          const Eigen::Quaterniond expected =
              turn[k - 1] * Eigen::Quaterniond(Eigen::AngleAxisd(share * whole.angle(), whole.axis()));
          if (std::exchange(first, false)) axes = expected.conjugate() * state.orientation[0];
          CHECK((expected * axes).angularDistance(state.orientation[0]) < 1e-7);  // of acos near 1
          const Vec3 velocity = state.v.col(1);
          CHECK((state.x.col(1) - last_place - course_h * velocity).norm() < 1e-12);
          const bool within = t > course_h && t < time[2] && std::abs(t - time[1]) > 2 * course_h;
          if (within) CHECK(velocity == last_velocity);  // to the bit: integrators go on
          last_place = state.x.col(1);
          last_velocity = velocity;
        });
    CHECK((axes.toRotationMatrix().cwiseAbs().rowwise().maxCoeff() - Vec3::Ones()).norm() < 1e-12);
  }
}

// 1 - s^2 (3 - 2 s), s = t/T, of what parts of joints begin apart.
TEST_CASE("joints whose parts begin apart close in their time, from rest to rest") {
  const auto left = [](double t) {
    const double s = std::min(t / 1.5, 1.0);
    return 1 - s * s * (3 - 2 * s);
  };
  const std::string body =
      "[[rigid_body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nposition_m = [3, 0.3, 0.4]\n"
      "[[joint]]\nbodies = [\"world\", \"a\"]\nclose_s = 1.5\npoints_m = [[3, 0, 0], [3, 0.3, 0.4]]\n";
  for (const std::string kind : {"ball\"\n", "weld\"\n", "hinge\"\naxis = [1, 0, 0]\n",
                                 "universal\"\naxis = [1, 0, 0]\nsecond_axis = [0, 1, 0]\n",
                                 "slider\"\naxis = [1, 0, 0]\n", "distance\"\nrest_length_m = 0.1\n"}) {
    INFO(kind);
    run(body + "kind = \"" + kind, "implicit_euler", [&](const pbd::State& state) {
      const double length =
          kind.starts_with("distance") ? 0.1 + 0.4 * left(state.time) : 0.5 * left(state.time);
      CHECK((state.x.col(0) - Vec3(3, 0.6 * length, 0.8 * length)).norm() < 1e-9);
    });
  }
}

TEST_CASE("motors follow the integral of their rate") {
  run("[[rigid_body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\n"
      "[[joint]]\nkind = \"slider\"\nbodies = [\"world\", \"a\"]\npoint_m = [0, 0, 0]\naxis = [1, 0, 0]\n"
      "[[joint]]\nkind = \"slide\"\nbodies = [\"world\", \"a\"]\npoints_m = [[0, 0, 0], [0, 0, 0]]\n"
      "axis = [1, 0, 0]\nrate_m_s = 0.5\n" +
          course,
      "implicit_euler", [&](const pbd::State& state) {
        CHECK(state.x(0, 0) == Approx(0.5 * integral(state.time)).margin(1e-9));
      });
  run("[[rigid_body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\n"
      "[[joint]]\nkind = \"hinge\"\nbodies = [\"world\", \"a\"]\npoint_m = [0, 0, 0]\naxis = [0, 0, 1]\n"
      "[[joint]]\nkind = \"angle\"\nbodies = [\"world\", \"a\"]\naxis = [0, 0, 1]\nrate_rad_s = 0.5\n" +
          course,
      "implicit_euler", [&](const pbd::State& state) {
        CHECK(std::sin(0.25 * integral(state.time)) == Approx(state.orientation[0].z()).margin(1e-9));
      });
}

TEST_CASE("a motor whose rate jumps turns at the new one at once, under every integrator") {
  const TemporaryFolder folder;
  const std::string text =
      "[[rigid_body]]\nname = \"bar\"\nshape = \"box\"\nsize_m = [1, 0.1, 0.1]\nmass_kg = 1\n"
      "[[joint]]\nkind = \"hinge\"\nbodies = [\"world\", \"bar\"]\npoint_m = [0, 0, 0]\naxis = [0, 0, 1]\n"
      "[[joint]]\nkind = \"angle\"\nbodies = [\"world\", \"bar\"]\naxis = [0, 0, 1]\nrate_rad_s = 1\n"
      "over_time = [[0.3, 0], [0.300001, 1]]\n[step]\nstep_s = 0.01\nsteps = 60\n";
  for (const std::string method : {"implicit_euler", "newmark", "generalised_alpha", "bdf2"}) {
    SceneFile file = read_scene_file(folder.write("scene.toml", text), {"method.integrator=" + method});
    pbd::Workspace workspace(file.scene, file.method);
    Stepper stepper(file, workspace);
    pbd::State state = file.scene.initial;
    for (std::int64_t k = 0; k < file.steps; ++k) {
      REQUIRE(stepper.whole(state).status == pbd::Status::ok);
      INFO(method << ", step " << k);
      if (k < 29) CHECK(state.spin.cwiseAbs().maxCoeff() <= 1e-9);
      if (k > 30) CHECK(std::abs(state.spin.col(0).norm() - 1) <= 1e-6);
    }
  }
}

TEST_CASE("simulate and compare follow a course") {
  const TemporaryFolder folder;
  const auto scene = folder.write(
      "scene.toml",
      "[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 2\n[[particle]]\nposition_m = [1, 0, 0]\nmass_kg = 1\n"
      "[[distance]]\nnodes = [0, 1]\n[[force]]\nnode = 1\nforce_n = [0, 3, 0]\n" +
          course + course_step + "[[probe]]\nkind = \"momentum\"\n");
  CHECK(run_program({"simulate", scene, "-o", folder.path / "out"}).exit_code == 0);
  const auto probes = read_text(folder.path / "out" / "probes.csv");
  const auto last = probes.substr(probes.rfind('\n', probes.size() - 2) + 1);  // step, time, px, py, ...
  double momentum = 0;
  REQUIRE(std::sscanf(last.c_str(), "%*[^,],%*[^,],%*[^,],%lf", &momentum) == 1);
  CHECK(momentum == Approx(3 * integral(4)).epsilon(1e-9));
  const auto ran = run_program(
      {"compare", scene, "--at-step", "30", "--method", "relaxation=direct", "-o", folder.path / "cmp"});
  INFO(ran.err);
  CHECK(ran.exit_code == 0);
}
