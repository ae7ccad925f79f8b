// Hard chains in minimal coordinates against formulas, multipliers and stiff springs; what is refused.
#include "planar_chain.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "closed_form.h"
#include "dense.h"
#include "energies.h"
#include "error.h"
#include "ode.h"

using namespace pbd;
using namespace pbd::reference;

namespace {

constexpr double chain_gravity = 9.81, pi = std::numbers::pi;

struct Bob {
  double mass, length, angle, rate = 0;  // angle from straight down, towards x
};

/// Node 0 holds the chain at the origin; it moves in the plane of x and z.
Scene hung(const std::vector<Bob>& bobs, double compliance = 0) {
  Scene scene;
  Distance links;
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();
  add_node(scene, x, infinity);
  for (const Bob& b : bobs) {
    x += b.length * Vec3(std::sin(b.angle), 0, -std::cos(b.angle));
    v += b.length * b.rate * Vec3(std::cos(b.angle), 0, std::sin(b.angle));
    const int node = add_node(scene, x, b.mass, v);
    links.node.push_back({node - 1, node}), links.rest_length.push_back(b.length);
    links.compliance.push_back(compliance);
  }
  scene.effects = {Gravity{}, links};
  return scene;
}

/// Five unlike links in a tilted plane, hung elsewhere, nodes and links out of order, with a force on one
/// bob.
Scene irregular_chain() {
  const Scene plain =
      hung({{0.3, 0.5, 1.2, 1}, {0.1, 0.2, 0.4, -2}, {1, 0.7, -0.3}, {0.2, 0.4, 2, 3}, {0.5, 0.3, 1}});
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const std::vector<int> order{3, 0, 5, 2, 1, 4};  // where each node goes
  Scene scene = plain;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int from = static_cast<int>(i), to = order[i];
    scene.mass[to] = plain.mass[i];
    scene.initial.x.col(to) = Vec3(1, -2, 3) + turn * plain.initial.x.col(from);
    scene.initial.v.col(to) = turn * plain.initial.v.col(from);
  }
  auto& links = std::get<Distance>(scene.effects[1]);
  for (auto& [a, b] : links.node) a = order[a], b = order[b];
  std::swap(links.node[0], links.node[3]), std::swap(links.rest_length[0], links.rest_length[3]);
  std::swap(links.node[2][0], links.node[2][1]);
  scene.effects[0] = Gravity{turn * Vec3(0, 0, -chain_gravity)};
  scene.effects.emplace_back(ExternalForce{{2}, {turn * Vec3(0.5, 0, 0.3)}});
  return scene;
}

/// The same motion with Lagrange multipliers, index reduced: M x'' = f + J^T m, J x'' = -(J)' v, with rows c
/// =
/// (|d|^2 - l^2)/2 for the difference d of two nodes.
OdeSolution by_multipliers(const Scene& scene, const std::vector<double>& times, double tolerance) {
  const Model model = make_model(scene);
  const auto& links = std::get<Distance>(scene.effects[1]).node;
  const int n = model.unknowns, rows = static_cast<int>(links.size());
  const auto slope = [&](double, const Vector& y, Vector& out) {
    const Points x = scatter(model, scene.initial.x, y.head(n));
    const Points v = scatter(model, scene.initial.v, y.tail(n));
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows, n);
    Vector bend(rows);
    for (int r = 0; r < rows; ++r) {
      const auto [a, b] = links[r];
      const int i = model.first[a], j = model.first[b];
      const Vec3 d = x.col(b) - x.col(a);
      if (i >= 0) jacobian.block<1, 3>(r, i) = -d.transpose();
      if (j >= 0) jacobian.block<1, 3>(r, j) = d.transpose();
      bend(r) = (v.col(b) - v.col(a)).squaredNorm();
    }
    const Eigen::MatrixXd inverse_mass = model.mass.cwiseInverse().asDiagonal();
    const Vector m = solve_definite(product_transposed(product(jacobian, inverse_mass), jacobian),
                                    Vector(-bend - jacobian * inverse_mass * model.force));
    out << y.tail(n), inverse_mass * (model.force + jacobian.transpose() * m);
  };
  Vector start(2 * n);
  start << gather(model, scene.initial.x), gather(model, scene.initial.v);
  return solve_ode(slope, start, times, {tolerance});
}

void check_refused(const Scene& scene, const std::string& part) {
  INFO(part);
  CHECK_THROWS_AS(ode(scene, {1}), SetupError);
  CHECK_THROWS_WITH(ode(scene, {1}), Catch::Contains(part));
}

}  // namespace

TEST_CASE("one hard link swings by the pendulum's elliptic functions") {
  const std::vector<double> times{0, 0.1, 1, 2, 5, 10};
  for (const double amplitude : {0.1, pi / 2, 3.0}) {
    const Trajectory found = ode(hung({{2, 0.6, amplitude}}), times);
    REQUIRE(found.outcome == Outcome::ok);
    for (std::size_t s = 0; s < times.size(); ++s) {
      const Angle exact = pendulum_motion(0.6, chain_gravity, amplitude, times[s]);
      const Vec3 x = 0.6 * Vec3(std::sin(exact.angle), 0, -std::cos(exact.angle));
      // The sum of the steps' errors; a period that depends on the amplitude makes them grow with time, near
      // the upright by its unstable rate for as long as the bob lingers there, 1/cos(amplitude/2) in all.
      const double w = std::sqrt(chain_gravity / 0.6), largest = 2 * w;
      const double growth = (1 + w * times[s]) / std::pow(std::cos(amplitude / 2), 2);
      const double bound = static_cast<double>(found.evaluations) / 13 * 1.1e-13 * (1 + largest) * growth;
      CHECK((found.samples[s].x.col(1) - x).norm() <= bound);
    }
  }
}

TEST_CASE("small double pendulums swing in their modes, up to the cube of the amplitude") {
  for (const DoublePendulum& p : {DoublePendulum{1, 1, 1, 1}, {1, 2, 1, 0.5}, {0.3, 0.1, 0.4, 0.9}})
    for (const int mode : {1, 2}) {
      const double w = 2 * pi * double_pendulum_frequency(p, chain_gravity, mode), end = 3 / w;
      const double lower = (p.upper_mass + p.lower_mass) * (chain_gravity - w * w * p.upper_length) /
                           (w * w * p.lower_mass * p.lower_length);
      std::vector<double> deviations;
      for (const double amplitude : {0.02, 0.01}) {
        const Trajectory found = ode(hung({{p.upper_mass, p.upper_length, amplitude},
                                           {p.lower_mass, p.lower_length, lower * amplitude}}),
                                     {end});
        REQUIRE(found.outcome == Outcome::ok);
        const Points& x = found.samples[0].x;
        const double swing = std::cos(w * end) * amplitude;
        deviations.push_back(std::hypot(std::asin(x(0, 1) / p.upper_length) - swing,
                                        std::asin((x(0, 2) - x(0, 1)) / p.lower_length) - lower * swing));
        CHECK(found.position_error[0] < 1e-4 * deviations.back() * std::min(p.upper_length, p.lower_length));
      }
      // 8, up to terms of the fifth order; a wrong frequency or shape would halve.
      CHECK(deviations[0] / deviations[1] == Approx(8).epsilon(0.02));
    }
}

TEST_CASE("an irregular chain moves as with Lagrange multipliers") {
  const std::vector<double> times{0.1, 0.5, 1, 2};
  const Scene scene = irregular_chain();
  const Model model = make_model(scene);
  const Trajectory found = ode(scene, times);
  REQUIRE(found.outcome == Outcome::ok);
  CHECK(*found.energy_drift <= 1e-12);
  const OdeSolution fine = by_multipliers(scene, times, 1e-13), coarse = by_multipliers(scene, times, 1e-11);
  for (std::size_t s = 0; s < times.size(); ++s) {
    const int n = model.unknowns;
    const Vector difference = fine.states[s] - coarse.states[s];
    const State& state = found.samples[s];
    const double x_bound = found.position_error[s] + difference.head(n).norm();
    const double v_bound = found.velocity_error[s] + difference.tail(n).norm();
    CHECK((gather(model, state.x) - fine.states[s].head(n)).cwiseAbs().maxCoeff() <= x_bound);
    CHECK((gather(model, state.v) - fine.states[s].tail(n)).cwiseAbs().maxCoeff() <= v_bound);
    CHECK(x_bound < 1e-8);
    CHECK(v_bound < 1e-7);
  }
}

TEST_CASE("stiff springs approach the hard chain in proportion to their compliance") {
  std::vector<double> times;
  for (int i = 1; i <= 200; ++i) times.push_back(0.005 * i);
  const std::vector<Bob> bobs{{1, 0.5, 1}, {0.5, 0.4, 0.6}, {1, 0.3, 0.2}};
  const Trajectory hard = ode(hung(bobs), times);
  std::vector<double> distances;
  for (const double compliance : {1e-5, 1e-6}) {
    const Trajectory soft = ode(hung(bobs, compliance), times);
    REQUIRE(soft.outcome == Outcome::ok);
    double distance = 0;
    for (std::size_t s = 0; s < times.size(); ++s)
      distance = std::max(distance, (soft.samples[s].x - hard.samples[s].x).colwise().norm().maxCoeff());
    distances.push_back(distance);
  }
  CHECK(distances[0] / distances[1] == Approx(10).epsilon(0.2));
}

TEST_CASE("scenes that are no planar hung chain are refused with the reason") {
  const std::vector<Bob> three{{1, 1, 0.5}, {1, 1, 0.2}, {1, 1, 0}};
  const Scene chain = hung(three);
  const auto links = [](Scene& scene) -> Distance& { return std::get<Distance>(scene.effects[1]); };
  const auto add_link = [&](Scene& scene, int a, int b) {
    links(scene).node.push_back({a, b});
    links(scene).rest_length.push_back((scene.initial.x.col(a) - scene.initial.x.col(b)).norm());
    links(scene).compliance.push_back(0);
  };
  REQUIRE(hung_chain(chain).node == std::vector{0, 1, 2, 3});

  Scene scene = chain;
  links(scene).compliance[1] = 1e-3;
  check_refused(scene, "effects[1]: got a compliant link among hard ones");
  scene = chain;
  scene.effects.emplace_back(Anchor{{3}, {Vec3::Zero()}, {1}});
  check_refused(scene, "effects[2]: got another effect than links");
  scene = chain;
  add_link(scene, 1, 3);
  check_refused(scene, "node 1: got 3 links");
  scene = chain;
  add_link(scene, 0, 2);
  check_refused(scene, "node 0: got 2 links");
  scene = chain;
  add_node(scene, Vec3(5, 0, 0), 1);
  check_refused(scene, "node 4: got no link");
  scene = chain;
  for (int i = 0; i < 3; ++i) add_node(scene, Vec3(std::cos(i), 0, std::sin(i)), 1);
  add_link(scene, 4, 5), add_link(scene, 5, 6), add_link(scene, 6, 4);
  check_refused(scene, "3 nodes hung from the support");
  scene = chain;
  scene.mass[0] = 1;
  check_refused(scene, "mass: got finite masses alone");
  scene = chain;
  scene.mass[3] = infinity;
  check_refused(scene, "node 3: got another node of infinite mass");
  scene = chain;
  scene.initial.v.colwise() += Vec3(1, 0, 0);
  check_refused(scene, "node 0: got a moving support");
  scene = chain;
  links(scene).rest_length[1] = 1.001;
  check_refused(scene, "link above node 2: got -0.001 m longer than its rest length");
  scene = chain;
  scene.initial.v.col(3) = Vec3(0, 0, -0.5);
  check_refused(scene, "link above node 3: got 0.5 m/s of lengthening");
  for (const double sideways : {1.0, 1e-9}) {
    scene = chain;
    scene.initial.v.col(3) = Vec3(1, sideways, 0);
    check_refused(scene, "out of a plane");
  }
  scene = chain;
  scene.effects[0] = Gravity{Vec3(0, 1, -9)};
  check_refused(scene, "out of a plane");
  scene = chain;
  scene.mass[1] = -1;
  check_refused(scene, "mass[1]");
}
