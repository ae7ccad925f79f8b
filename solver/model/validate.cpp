#include "validate.h"

#include <cmath>
#include <sstream>

#include "error.h"
#include "mesh.h"

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

template <class T>
std::string text(const T& value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

std::string text(const Vec3& value) {
  return "(" + text(value.x()) + ", " + text(value.y()) + ", " + text(value.z()) + ")";
}

void require(bool holds, const std::string& where, const std::string& value, std::string_view allowed) {
  if (!holds) throw SetupError(where, value, allowed);
}

/// Checks of one effect; `name` is its position and kind in the scene, as in "effects[2] distance".
struct EffectCheck {
  const Scene& scene;
  std::string name;

  std::string at(std::size_t i, std::string_view field) const {
    return name + " " + std::string(field) + "[" + text(i) + "]";
  }

  template <class Entries>
  void same_size(std::size_t expected, const Entries& entries, std::string_view field) const {
    require(entries.size() == expected, name + " " + std::string(field), text(entries.size()) + " entries",
            "one entry per constraint, " + text(expected));
  }

  void node_index(int node, const std::string& where) const {
    require(node >= 0 && node < scene.nodes(), where, text(node),
            "a node index from 0 to " + text(scene.nodes() - 1));
  }

  template <std::size_t K>
  void node_indices(const std::vector<std::array<int, K>>& node) const {
    for (std::size_t i = 0; i < node.size(); ++i)
      for (std::size_t a = 0; a < K; ++a) {
        node_index(node[i][a], at(i, "node"));
        for (std::size_t b = 0; b < a; ++b)
          require(node[i][a] != node[i][b], at(i, "node"), text(node[i][a]) + " twice", "different nodes");
      }
  }

  void node_indices(const std::vector<int>& node) const {
    for (std::size_t i = 0; i < node.size(); ++i) node_index(node[i], at(i, "node"));
  }

  void not_negative(const std::vector<double>& values, std::string_view field) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      require(values[i] >= 0 && std::isfinite(values[i]), at(i, field), text(values[i]),
              "a finite number >= 0");
  }

  void finite(const std::vector<double>& values, std::string_view field) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      require(std::isfinite(values[i]), at(i, field), text(values[i]), "a finite number");
  }

  void finite(const std::vector<Vec3>& values, std::string_view field) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      require(values[i].allFinite(), at(i, field), text(values[i]), "finite numbers");
  }

  void material(const Material& m, bool may_be_rigid) const {
    require(m.young > 0 && (may_be_rigid || std::isfinite(m.young)), name + " young", text(m.young),
            may_be_rigid ? "a number > 0, Pa (inf for a rigid one)" : "a finite number > 0, Pa");
    require(m.poisson > -1 && m.poisson < 0.5, name + " poisson", text(m.poisson), "-1 < poisson < 0.5");
  }

  void retardation_times(std::size_t constraints, const std::vector<double>& damping) const {
    if (damping.empty()) return;
    same_size(constraints, damping, "damping");
    not_negative(damping, "damping");
  }

  void viscosity(const std::optional<Material>& damping, const Material& elastic) const {
    if (!damping) return;
    EffectCheck{scene, name + " damping"}.material(*damping, false);
    require(std::isfinite(elastic.young), name + " damping", "moduli of a rigid material",
            "damping of a finite young");
  }

  void operator()(const Gravity& effect) const {
    require(effect.acceleration.allFinite(), name + " acceleration", text(effect.acceleration),
            "finite numbers");
  }

  void operator()(const ExternalForce& effect) const {
    same_size(effect.node.size(), effect.force, "force");
    node_indices(effect.node);
    finite(effect.force, "force");
  }

  void operator()(const Anchor& effect) const {
    same_size(effect.node.size(), effect.target, "target");
    same_size(effect.node.size(), effect.compliance, "compliance");
    node_indices(effect.node);
    for (std::size_t i = 0; i < effect.node.size(); ++i)
      require(std::isfinite(scene.mass[static_cast<std::size_t>(effect.node[i])]), at(i, "node"),
              text(effect.node[i]) + ", of infinite mass", "a node of finite mass, which an anchor can hold");
    finite(effect.target, "target");
    not_negative(effect.compliance, "compliance");
    retardation_times(effect.node.size(), effect.damping);
  }

  void operator()(const Distance& effect) const {
    same_size(effect.node.size(), effect.rest_length, "rest_length");
    same_size(effect.node.size(), effect.compliance, "compliance");
    node_indices(effect.node);
    not_negative(effect.rest_length, "rest_length");
    not_negative(effect.compliance, "compliance");
    retardation_times(effect.node.size(), effect.damping);
    for (std::size_t i = 0; i < effect.rest_length.size(); ++i)
      require(effect.rest_length[i] > 0 || effect.compliance[i] > 0, at(i, "rest_length"),
              "0 and compliance 0", "a rest length > 0 for a link without compliance");
  }

  void operator()(const Bending& effect) const {
    same_size(effect.node.size(), effect.rest_angle, "rest_angle");
    same_size(effect.node.size(), effect.compliance, "compliance");
    node_indices(effect.node);
    finite(effect.rest_angle, "rest_angle");
    not_negative(effect.compliance, "compliance");
    retardation_times(effect.node.size(), effect.damping);
  }

  void operator()(const TriangleStrain& effect) const {
    same_size(effect.node.size(), effect.rest, "rest");
    node_indices(effect.node);
    material(effect.material, true);
    viscosity(effect.damping, effect.material);
    require(effect.thickness > 0 && std::isfinite(effect.thickness), name + " thickness",
            text(effect.thickness), "a finite number > 0, m");
    for (std::size_t i = 0; i < effect.rest.size(); ++i)
      require_proper(effect.rest[i], name + " triangle " + text(i));
  }

  void operator()(const TetStrain& effect) const {
    same_size(effect.node.size(), effect.rest, "rest");
    node_indices(effect.node);
    material(effect.material, false);
    viscosity(effect.damping, effect.material);
    for (std::size_t i = 0; i < effect.rest.size(); ++i)
      require_proper(effect.rest[i], name + " tetrahedron " + text(i));
  }
};

}  // namespace

void require_proper(const Eigen::Matrix<double, 3, 4>& rest, const std::string& where) {
  const double volume = tet_volume(rest);
  require(volume > degenerate_ratio * std::pow(longest_edge(rest), 3), where,
          "volume " + text(volume) + " m^3",
          "a positive volume: nodes ordered so that ((x1-x0) x (x2-x0)) . (x3-x0) > 0, and not flat");
}

void require_proper(const Eigen::Matrix3d& rest, const std::string& where) {
  const double area = triangle_area(rest);
  require(area > degenerate_ratio * std::pow(longest_edge<3>(rest), 2), where, "area " + text(area) + " m^2",
          "a positive area");
}

void validate(const Scene& scene) {
  const auto size_of = [](const Points& points) { return text(points.cols()) + " columns"; };
  const auto one_per_node = "one column per node, " + text(scene.nodes());
  require(scene.initial.x.cols() == scene.nodes(), "initial x", size_of(scene.initial.x), one_per_node);
  require(scene.initial.v.cols() == scene.nodes(), "initial v", size_of(scene.initial.v), one_per_node);
  for (int node = 0; node < scene.nodes(); ++node) {
    const double mass = scene.mass[static_cast<std::size_t>(node)];
    const auto where = [&](const char* field) { return std::string(field) + "[" + text(node) + "]"; };
    require(mass > 0, where("mass"), text(mass), "a number > 0, kg (inf for a node that keeps its velocity)");
    require(scene.initial.x.col(node).allFinite(), where("position"), text(Vec3(scene.initial.x.col(node))),
            "finite numbers");
    require(scene.initial.v.col(node).allFinite(), where("velocity"), text(Vec3(scene.initial.v.col(node))),
            "finite numbers");
  }
  for (std::size_t i = 0; i < scene.effects.size(); ++i)
    std::visit(
        [&](const auto& effect) {
          EffectCheck{scene, "effects[" + text(i) + "] " + std::string(effect.name)}(effect);
        },
        scene.effects[i]);
}

}  // namespace pbd
