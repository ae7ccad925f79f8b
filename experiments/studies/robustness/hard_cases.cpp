#include "studies/robustness/hard_cases.h"

#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "harness/experiment.h"
#include "mesh.h"
#include "scenes/standard.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double density = 1000;  // kg/m^3
constexpr double frame_s = 1.0 / 60;

/// Rope of `links` links of 1 m and 0.5 kg a node, the last one `ratio` times that, from a fixed node along
/// `direction`; every second link has the other compliance (m/N).
Scene rope(int links, double ratio, const Vec3& direction, double compliance = 0, double other = 0) {
  Scene scene;
  Distance effect;
  add_node(scene, Vec3::Zero(), infinity);
  for (int i = 1; i <= links; ++i) {
    add_node(scene, i * direction, i == links ? 0.5 * ratio : 0.5);
    effect.node.push_back({i - 1, i});
    effect.rest_length.push_back(1);
    effect.compliance.push_back(i % 2 ? compliance : other);
  }
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(std::move(effect));
  return scene;
}

void ropes(std::vector<HardCase>& all) {
  const Vec3 down = -Vec3::UnitZ(), across = Vec3::UnitX();
  all.push_back({"heavy rope, 20 links, 1800:1", rope(20, 1800, across), frame_s, 20});
  HardCase hanging{"hanging rope, 50 links, 200:1", rope(50, 200, down), frame_s, 50, infinity};
  hanging.tension = true;
  all.push_back(hanging);
  hanging = {"hanging rope, 100 links, 1000:1", rope(100, 1000, down), frame_s, 100, infinity};
  hanging.tension = true;
  all.push_back(hanging);
  // Ten soft springs in series, of 0.1 m/N together, carry 20 nodes of 0.5 kg: a rod's slowest motion.
  const double slowest = std::numbers::pi / 2 / std::sqrt(0.1 * 20 * 0.5);
  all.push_back({"links in series, 1e6:1", rope(20, 1, down, 1e-2, 1e-8), 0.2, 20, slowest});
}

/// Solid bar of 1 m hanging from its top, slabs of two materials in turn, Young's moduli `soft` and 1e6 soft.
HardCase slabs(int cells, double soft) {
  const TetMesh mesh = kuhn_grid({1, 1, cells}, Vec3(0.25, 0.25, 1), Vec3(0, 0, -1));
  HardCase each{"solids in series, 1e6:1", {}, 0.1, 1, std::sqrt(gravity)};  // a pendulum at the slowest
  add_solid(each.scene, mesh, density, {soft, 0.3}, Strain::corotational);
  auto& first = std::get<TetStrain>(each.scene.effects[0]);
  TetStrain second{.node = {}, .rest = {}, .material = {1e6 * soft, 0.3}, .strain = Strain::corotational};
  TetStrain kept = second;
  kept.material = first.material;
  for (std::size_t i = 0; i < first.node.size(); ++i) {
    TetStrain& to = i / 6 % 2 ? second : kept;
    to.node.push_back(first.node[i]);
    to.rest.push_back(first.rest[i]);
  }
  first = kept;
  each.scene.effects.emplace_back(std::move(second));
  each.scene.effects.emplace_back(Gravity{});
  for (int node = 0; node < each.scene.nodes(); ++node)
    if (each.scene.initial.x(2, node) == 0) each.scene.mass[static_cast<std::size_t>(node)] = infinity;
  return each;
}

/// cells x cells squares of hard links of 1 m, 1 kg a node, held at two corners of one edge.
HardCase joint_grid(int cells) {
  const TriangleMesh mesh =
      grid_sheet({cells, cells}, {static_cast<double>(cells), static_cast<double>(cells)});
  HardCase each{fmt::format("grid of {0} x {0} hard links", cells), {}, frame_s, 1.0 * cells};
  for (Eigen::Index i = 0; i < mesh.x.cols(); ++i) {
    const bool held = mesh.x(1, i) == 0 && (mesh.x(0, i) == 0 || mesh.x(0, i) == cells);
    add_node(each.scene, mesh.x.col(i), held ? infinity : 1);
  }
  Distance links;
  for (const auto& edge : edges(mesh))
    if ((mesh.x.col(edge[0]) - mesh.x.col(edge[1])).norm() < 1.2) {  // no diagonals
      links.node.push_back(edge);
      links.rest_length.push_back(1);
      links.compliance.push_back(0);
    }
  each.scene.effects.emplace_back(Gravity{});
  each.scene.effects.emplace_back(std::move(links));
  return each;
}

/// First bending frequency (rad/s) of a clamped beam of 1 x 1/4 x 1/4 m (Euler and Bernoulli), and no less
/// than that of a pendulum of its length: a soft one hangs.
double beam_frequency(double young) {
  return std::max(0.1615 * 2 * std::numbers::pi * 0.25 * std::sqrt(young / density), std::sqrt(gravity));
}

void stiffness_cases(std::vector<HardCase>& all, int cells) {
  for (const double young : {1e2, 1e4, 1e6, 1e8})
    all.push_back({fmt::format("Young's modulus {:.0e} Pa", young),
                   cantilever(cells, {young, 0.3}, Strain::corotational), 0.025, 1,
                   young < 1e4 ? 0 : beam_frequency(young)});
}

/// Rod of 1 x 1/4 x 1/4 m, E = 1e4 Pa, both ends held, twisted evenly by half a turn.
Scene twisted_rod(int cells) {
  Scene scene = cantilever(cells, {1e4, 0.3}, Strain::corotational);
  for (int node = 0; node < scene.nodes(); ++node) {
    auto x = scene.initial.x.col(node);
    if (x[0] == 1) scene.mass[static_cast<std::size_t>(node)] = infinity;
    const Vec3 middle(0, 0.125, 0.125);
    x = middle + Eigen::AngleAxisd(std::numbers::pi * x[0], Vec3::UnitX()) * (Vec3(x) - middle);
  }
  return scene;
}

void case_steps(std::vector<HardCase>& all, int cells) {
  const double slowest = std::sqrt(1e4 / density);  // slower than any wave over the rod's 1 m
  for (const double h : {0.002, 0.005, 0.01, 0.025, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0})
    all.push_back({fmt::format("twisted rod, step {:g} s", h), twisted_rod(cells), h, 1, slowest});
}

/// Moves the nodes of a unit cube from where they rest.
HardCase distorted(const std::string& name, int cells, Vec3 (*place)(const Vec3&, std::mt19937_64&)) {
  std::mt19937_64 random(seed);
  HardCase each{"cube from " + name, {}, 10, 1};
  add_solid(each.scene, kuhn_grid({cells, cells, cells}, Vec3::Ones()), density, {1e5, 0.3},
            Strain::corotational);
  each.rest = each.scene.initial.x;
  for (int node = 0; node < each.scene.nodes(); ++node)
    each.scene.initial.x.col(node) = place(each.rest.col(node), random);
  each.slowest = std::numbers::pi * std::sqrt(1e5 / (2 * 1.3 * density));  // a shear wave across
  return each;
}

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

void recoveries(std::vector<HardCase>& all, int cells) {
  using R = std::mt19937_64;
  all.push_back(distorted("random positions", cells, [](const Vec3&, R& r) {
    const double a = uniform(r), b = uniform(r), c = uniform(r);
    return Vec3(a, b, c);
  }));
  all.push_back(distorted("a plane", cells, [](const Vec3& x, R&) { return Vec3(x[0], x[1], 0); }));
  all.push_back(distorted("a line", cells, [](const Vec3& x, R&) { return Vec3(x[0], 0, 0); }));
  all.push_back(distorted("a point", cells, [](const Vec3&, R&) { return Vec3::Zero().eval(); }));
  all.push_back(
      distorted("its mirror image", cells, [](const Vec3& x, R&) { return Vec3(-x[0], x[1], x[2]); }));
}

/// Cook's membrane, 48 mm long and 44 to 60 mm high, 4 mm thick, as a solid; pulled up at its free end.
HardCase membrane(int cells, double poisson) {
  TetMesh mesh = kuhn_grid({cells, cells, 1}, Vec3(0.048, 1, 0.004));
  for (Eigen::Index i = 0; i < mesh.x.cols(); ++i) {
    const double across = mesh.x(0, i) / 0.048, up = mesh.x(1, i);
    mesh.x(1, i) = (1 - up) * 0.044 * across + up * (0.044 + 0.016 * across);
  }
  HardCase each{fmt::format("membrane, Poisson's ratio {:g}", poisson), {}, 0.05, 0.048};
  add_solid(each.scene, mesh, density, {1e5, poisson}, Strain::corotational);
  clamp_smallest_x(each.scene);
  ExternalForce pull;
  for (Eigen::Index i = 0; i < mesh.x.cols(); ++i)
    if (mesh.x(0, i) > 0.0479) {
      pull.node.push_back(static_cast<int>(i));
      pull.force.emplace_back(0, 0.5 / (2 * (cells + 1)), 0);
    }
  each.scene.effects.emplace_back(std::move(pull));
  // Out of its plane, where it is thin: a cantilever of its length and thickness.
  each.slowest = 0.1615 * 2 * std::numbers::pi * 0.004 / 0.048 / 0.048 * std::sqrt(1e5 / density);
  return each;
}

/// Cantilever whose second layer of bricks is `aspect` times thinner than wide.
HardCase slivers(int cells, double aspect) {
  TetMesh mesh = kuhn_grid({cells, cells / 4, cells / 4}, Vec3(1, 0.25, 0.25));
  const double width = 1.0 / cells, thin = width / aspect;
  for (Eigen::Index i = 0; i < mesh.x.cols(); ++i)
    if (mesh.x(0, i) > 1.5 * width) mesh.x(0, i) += thin - width;
  return {fmt::format("slivers of aspect {:g}", aspect),
          clamped_solid(mesh, {1e6, 0.3}, Strain::corotational), 0.025, 1, beam_frequency(1e6)};
}

/// Bar of St Venant-Kirchhoff material between two held faces at half its length, beyond the limit point of
/// 0.577; gravity across disturbs it.
HardCase compressed(int cells) {
  HardCase each{"St Venant-Kirchhoff bar at half its length", cantilever(cells, {1e5, 0.3}, Strain::green),
                0.01, 1};
  for (int node = 0; node < each.scene.nodes(); ++node) {
    if (each.scene.initial.x(0, node) == 1) each.scene.mass[static_cast<std::size_t>(node)] = infinity;
    each.scene.initial.x(0, node) *= 0.5;
  }
  return each;
}

}  // namespace

int settling_steps(const HardCase& each, double h) {
  if (each.slowest == 0) return -1;
  if (std::isinf(each.slowest)) return 0;
  const bool spins = each.rest.size() > 0;
  const double fall = std::log(1e6) * (spins ? 2 : 1);  // of the energy
  const double vibration = 2 * fall / std::log1p(std::pow(each.slowest * h, 2));
  const double spin = spins ? each.length / (8 * gravity * 1e-6 * h * h) : 0;
  return static_cast<int>(std::ceil(vibration + spin));
}

std::vector<HardCase> hard_cases(bool full) {
  const int beam = full ? 8 : 4;
  std::vector<HardCase> all;
  ropes(all);
  all.push_back(slabs(full ? 8 : 4, 1e4));
  all.push_back(joint_grid(full ? 24 : 6));
  stiffness_cases(all, beam);
  case_steps(all, beam);
  recoveries(all, full ? 3 : 2);
  for (const double poisson : {0.45, 0.49, 0.499, 0.4999, 0.49999})
    all.push_back(membrane(full ? 8 : 4, poisson));
  for (const double aspect : {1e2, 1e4, 1e6}) all.push_back(slivers(beam, aspect));
  all.push_back(compressed(beam));
  return all;
}

}  // namespace pbdcheck
