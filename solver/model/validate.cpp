#include "validate.h"

#include <cmath>

#include "error.h"
#include "mesh.h"
#include "validate_effect.h"
#include "validate_texts.h"

namespace pbd {
namespace {

/// Elements whose volume is below this multiple of their longest edge cubed cannot be told from flat ones.
constexpr double degenerate_ratio = 1e-12;

template <int K>
double longest_edge(const Eigen::Matrix<double, 3, K>& rest) {
  double longest = 0;
  for (int a = 0; a < K; ++a)
    for (int b = a + 1; b < K; ++b) longest = std::max(longest, (rest.col(a) - rest.col(b)).norm());
  return longest;
}

/// The bodies, before any effect refers to them.
void validate_bodies(const Scene& scene) {
  const std::size_t count = scene.bodies.size();
  REQUIRE(scene.initial.orientation.size() == count, "initial orientation",
          text(scene.initial.orientation.size()) + " entries", "one per rigid body, " + text(count));
  REQUIRE(scene.initial.spin.cols() == static_cast<Eigen::Index>(count), "initial spin",
          text(scene.initial.spin.cols()) + " columns", "one per rigid body, " + text(count));
  std::vector<bool> taken(scene.mass.size(), false);
  for (std::size_t b = 0; b < count; ++b) {
    const auto& [node, inertia] = scene.bodies[b];
    const auto where = [&](const char* field) { return "bodies[" + text(b) + "] " + field; };
    REQUIRE(node >= 0 && node < scene.nodes() && !taken[node], where("node"), text(node),
            "a node's index, a different one for each body");
    taken[node] = true;
    const bool turns = inertia.allFinite() && inertia.minCoeff() > 0;
    const bool kept = inertia.minCoeff() == infinity;
    REQUIRE(turns || kept, where("inertia"), text(inertia),
            "three principal moments > 0, kg m^2 (all inf for a body that keeps its angular velocity)");
    constexpr double slack = 1e-9;  // of the largest
    REQUIRE(kept || 2 * inertia.maxCoeff() <= (1 + slack) * inertia.sum(), where("inertia"), text(inertia),
            "no moment larger than the sum of the other two: no mass has such");
    const auto& orientation = scene.initial.orientation[b];
    REQUIRE(is_unit(orientation), where("orientation"), norm_of(orientation), "norm 1");
    const Vec3 spin = scene.initial.spin.col(b);
    REQUIRE(spin.allFinite(), where("spin"), text(spin), "finite numbers");
  }
}

}  // namespace

void require_proper(const Eigen::Matrix<double, 3, 4>& rest, std::string_view what, std::size_t index) {
  const double volume = tet_volume(rest);
  const double longest = longest_edge(rest);
  REQUIRE(volume > degenerate_ratio * std::pow(longest, 3), std::string(what) + text(index),
          "volume " + text(volume) + " m^3, longest edge " + text(longest) + " m",
          "a positive volume, above 1e-12 of the edge's cube: nodes ordered so that ((x1-x0) x (x2-x0)) . "
          "(x3-x0) > 0, and not flat");
}

void require_proper(const Eigen::Matrix3d& rest, std::string_view what, std::size_t index) {
  const double area = triangle_area(rest);
  const double longest = longest_edge<3>(rest);
  REQUIRE(area > degenerate_ratio * std::pow(longest, 2), std::string(what) + text(index),
          "area " + text(area) + " m^2, longest edge " + text(longest) + " m",
          "a positive area, above 1e-12 of the edge's square");
}

void validate(const Scene& scene) {
  const auto size_of = [](const Points& points) { return text(points.cols()) + " columns"; };
  const auto one_per_node = "one column per node, " + text(scene.nodes());
  REQUIRE(scene.initial.x.cols() == scene.nodes(), "initial x", size_of(scene.initial.x), one_per_node);
  REQUIRE(scene.initial.v.cols() == scene.nodes(), "initial v", size_of(scene.initial.v), one_per_node);
  for (int node = 0; node < scene.nodes(); ++node) {
    const double mass = scene.mass[node];
    const auto where = [&](const char* field) { return std::string(field) + "[" + text(node) + "]"; };
    REQUIRE(mass >= least_mass, where("mass"), text(mass),
            "a number from " + text(least_mass) + " on, kg (inf for a node that keeps its velocity)");
    REQUIRE(scene.initial.x.col(node).allFinite(), where("position"), text(Vec3(scene.initial.x.col(node))),
            "finite numbers");
    const Vec3 velocity = scene.initial.v.col(node);
    REQUIRE(velocity.norm() <= most_speed, where("velocity"), text(velocity),
            "a speed up to " + text(most_speed) + " m/s");
  }
  double lightest = infinity, heaviest = 0;
  for (const double mass : scene.mass)
    if (std::isfinite(mass)) lightest = std::min(lightest, mass), heaviest = std::max(heaviest, mass);
  REQUIRE(heaviest <= most_mass_ratio * lightest, "mass", text(lightest) + " beside " + text(heaviest),
          "masses within a factor of " + text(most_mass_ratio));
  validate_bodies(scene);
  for (std::size_t i = 0; i < scene.effects.size(); ++i) validate_effect(scene, i);
}

void validate(const Scene& scene, double h, const State& state) {
  REQUIRE(h >= least_step && std::isfinite(h), "h", text(h), "a finite step above 0 s, of 1e-75 s or more");
  const auto require_count = [](const char* what, std::ptrdiff_t found, std::ptrdiff_t wanted) {
    REQUIRE(found == wanted, what, text(found) + " entries", "as many as the scene has, " + text(wanted));
  };
  require_count("state.x", state.x.cols(), scene.nodes());
  require_count("state.v", state.v.cols(), scene.nodes());
  require_count("state.orientation", std::ssize(state.orientation), std::ssize(scene.bodies));
  require_count("state.spin", state.spin.cols(), std::ssize(scene.bodies));
  for (std::size_t b = 0; b < state.orientation.size(); ++b)
    REQUIRE(is_unit(state.orientation[b]), "state.orientation[" + text(b) + "]",
            norm_of(state.orientation[b]), "norm 1");
}

}  // namespace pbd
