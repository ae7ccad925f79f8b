#include "validate_contact_effect.h"

#include <algorithm>
#include <cmath>

#include "validate.h"
#include "validate_texts.h"

namespace pbd {
namespace {

void validate_laws(const EffectCheck& check, const Contact& effect) {
  REQUIRE(effect.materials > 0, check.name + " materials", text(effect.materials), "at least one");
  const auto materials = static_cast<std::size_t>(effect.materials);
  REQUIRE(effect.law.size() == materials * materials, check.name + " law",
          text(effect.law.size()) + " entries", "one per pair of materials, " + text(materials * materials));
  for (std::size_t i = 0; i < effect.law.size(); ++i) {
    const ContactLaw& law = effect.law[i];
    REQUIRE(law.friction >= 0 && law.friction <= most_friction, check.at(i, "friction"), text(law.friction),
            "0 to " + text(most_friction));
    REQUIRE(law.restitution >= 0 && law.restitution <= 1, check.at(i, "restitution"), text(law.restitution),
            "0 to 1");
    for (const auto& [field, value] : {std::pair{"compliance", law.compliance}, {"damping", law.damping}})
      REQUIRE(value >= 0 && std::isfinite(value), check.at(i, field), text(value), "a finite number >= 0");
    const std::size_t row = i / materials, column = i % materials;
    REQUIRE(law == effect.law[column * materials + row], check.at(i, "law"), "another one than its mirror's",
            "a symmetric table");
  }
}

/// What lengths of a shape may be. Meshes and hulls have been checked as they were made.
struct Lengths {
  const std::string where;

  void operator()(std::monostate) const {}
  void operator()(const HalfSpace&) const {}
  void operator()(const Sphere& shape) const { length("radius", shape.radius); }
  void operator()(const Box& shape) const {
    for (const double size : shape.size) length("size", size);
  }
  void operator()(const Cylinder& shape) const {
    length("radius", shape.radius), length("length", shape.length);
  }
  void operator()(const Capsule& shape) const {
    length("radius", shape.radius), length("length", shape.length);
  }
  void operator()(const ClosedMesh& shape) const { points(shape.surface); }
  void operator()(const ConvexHull& shape) const { points(shape.surface); }

 private:
  void length(const char* field, double value) const {
    REQUIRE(value > 0 && std::isfinite(value), where + " " + field, text(value), "a finite number > 0, m");
  }
  void points(const TriangleMesh& surface) const {
    REQUIRE(surface.x.allFinite(), where, "points that are not finite", "finite numbers");
  }
};

void validate_collider(const EffectCheck& check, const Collider& collider, std::size_t i) {
  check.body_index(collider.body, i);
  std::visit(Lengths{check.at(i, "shape")}, collider.shape);
  const auto& [origin, rotation] = collider.frame;
  REQUIRE(origin.allFinite(), check.at(i, "frame origin"), text(origin), "finite numbers");
  const double off = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  REQUIRE(rotation.allFinite() && off <= unit_slack && rotation.determinant() > 0,
          check.at(i, "frame rotation"), "a matrix of determinant " + text(rotation.determinant()),
          "a rotation: columns of length 1 at right angles");
  REQUIRE(collider.surface_velocity.allFinite(), check.at(i, "surface velocity"),
          text(collider.surface_velocity), "finite numbers, m/s");
}

void material_index(const EffectCheck& check, const Contact& effect, int material, std::size_t i,
                    std::string_view field) {
  REQUIRE(material >= 0 && material < effect.materials, check.at(i, field), text(material),
          "a material from 0 to " + text(effect.materials - 1));
}

/// A node's material is that of all of its triangles.
void validate_triangle_materials(const EffectCheck& check, const Contact& effect) {
  constexpr auto field = "triangle_material";
  if (effect.triangle_material.empty()) return;
  check.same_size(effect.triangle.size(), effect.triangle_material, field);
  std::vector<std::size_t> first(static_cast<std::size_t>(check.scene.nodes()), effect.triangle.size());
  for (std::size_t i = 0; i < effect.triangle.size(); ++i) {
    const int material = effect.triangle_material[i];
    material_index(check, effect, material, i, field);
    for (const int node : effect.triangle[i]) {
      std::size_t& known = first[static_cast<std::size_t>(node)];
      known = std::min(known, i);
      REQUIRE(material == effect.triangle_material[known], check.at(i, field), text(material),
              text(effect.triangle_material[known]) + ", that of triangle " + text(known) +
                  ", which has node " + text(node) + ", too");
    }
  }
}

}  // namespace

void validate(const EffectCheck& check, const Contact& effect) {
  check.only_one<Contact>();
  for (std::size_t i = 0; i < effect.collider.size(); ++i) {
    validate_collider(check, effect.collider[i], i);
    material_index(check, effect, effect.collider[i].material, i, "collider material");
  }
  check.same_size(effect.node.size(), effect.radius, "radius");
  check.same_size(effect.node.size(), effect.node_material, "node_material");
  check.node_indices(effect.node);
  check.not_negative(effect.radius, "radius");
  for (std::size_t i = 0; i < effect.node.size(); ++i)
    material_index(check, effect, effect.node_material[i], i, "node_material");
  check.node_indices(effect.triangle);
  validate_triangle_materials(check, effect);
  REQUIRE(effect.thickness >= 0 && std::isfinite(effect.thickness), check.name + " thickness",
          text(effect.thickness), "a finite number >= 0, m");
  const bool surfaces_alone = effect.collider.empty() && effect.node.empty();
  REQUIRE(effect.thickness > 0 || effect.triangle.empty() || surfaces_alone, check.name + " thickness",
          text(effect.thickness),
          "a number > 0, m, where surfaces touch bodies or nodes: a point has no side");
  validate_laws(check, effect);
  for (std::size_t i = 0; i < effect.apart.size(); ++i)
    for (const int body : effect.apart[i]) check.body_index(body, i);
  check.not_negative({effect.margin}, "margin");
  REQUIRE(effect.recovery >= 0, check.name + " recovery", text(effect.recovery), "a number >= 0, m/s");
}

}  // namespace pbd
