#include "touching_sides.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace pbd::reference {

namespace {

bool has(const auto& nodes, int node) {
  return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}

/// True if some element has both nodes.
bool share_element(const Scene& scene, int a, int b) {
  const auto has_both = [&]<class E>(const E& own) {
    if constexpr (requires { own.node[0][1]; })
      return std::any_of(own.node.begin(), own.node.end(),
                         [&](const auto& nodes) { return has(nodes, a) && has(nodes, b); });
    return false;
  };
  return std::any_of(scene.effects.begin(), scene.effects.end(),
                     [&](const Effect& effect) { return std::visit(has_both, effect); });
}

}  // namespace

bool may_touch(const Scene& scene, const Contact& contact, const Side& a, const Side& b) {
  if (a.node == b.node) return false;
  if (a.body < 0 && b.body < 0) return contact.nodes_touch && !share_element(scene, a.node, b.node);
  const auto both = [&](const std::array<int, 2>& pair) {
    return pair == std::array{a.body, b.body} || pair == std::array{b.body, a.body};
  };
  if (std::any_of(contact.apart.begin(), contact.apart.end(), both)) return false;
  for (const Effect& effect : scene.effects) {
    const bool connects = std::visit(
        [&]<class E>(const E& own) {
          if constexpr (std::is_same_v<E, Attachment>) {
            for (std::size_t i = 0; i < own.node.size(); ++i)
              if ((own.node[i] == a.node && own.body[i] == b.body) ||
                  (own.node[i] == b.node && own.body[i] == a.body))
                return true;
          } else if constexpr (requires { own.body[0][1]; }) {
            return std::any_of(own.body.begin(), own.body.end(), both);
          }
          return false;
        },
        effect);
    if (connects) return false;
  }
  return true;
}

std::vector<std::size_t> free_triangles(const Scene& scene, const Contact& contact, const Side& side) {
  const auto has_side = [&](const auto& triangle) { return side.body < 0 && has(triangle, side.node); };
  if (std::any_of(contact.triangle.begin(), contact.triangle.end(), has_side)) return {};
  std::set<int> kept;
  const auto keep = [&]<class E>(const E& own) {
    if constexpr (std::is_same_v<E, Attachment>) {
      for (std::size_t i = 0; i < own.node.size(); ++i)
        if (own.body[i] == side.body) kept.insert(own.node[i]);
    } else if constexpr (requires { own.node[0][1]; }) {
      for (const auto& nodes : own.node)
        if (side.body < 0 && has(nodes, side.node)) kept.insert(nodes.begin(), nodes.end());
    }
  };
  for (const Effect& effect : scene.effects) std::visit(keep, effect);
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < contact.triangle.size(); ++i) {
    const auto& nodes = contact.triangle[i];
    if (std::none_of(nodes.begin(), nodes.end(), [&](int node) { return kept.contains(node); }))
      free.push_back(i);
  }
  return free;
}

Sides::Sides(const StepClaim& claim, const Contact& contact) : claim_(claim), contact_(contact) {
  for (const Collider& collider : contact.collider) shapes_.push_back(collider.shape);
  for (const double radius : contact.radius) shapes_.emplace_back(Sphere{radius});
  surface_material_.resize(claim.scene.mass.size());
  for (std::size_t i = 0; i < contact.triangle.size(); ++i)
    for (const int node : contact.triangle[i]) {
      surface_material_[static_cast<std::size_t>(node)] = contact.material(shapes_.size() + i);
      const double inverse = 1 / claim.scene.mass[static_cast<std::size_t>(node)];
      surface_inverse_mass_ = std::max(surface_inverse_mass_, inverse);
      least_surface_inverse_mass_ = std::min(least_surface_inverse_mass_, inverse);
    }
}

Side Sides::side(int k) const {
  if (k >= count()) return {};
  const auto index = static_cast<std::size_t>(k);
  if (is_node(k)) return {-1, contact_.node[index - contact_.collider.size()]};
  const int body = contact_.collider[index].body;
  return {body, claim_.scene.bodies[static_cast<std::size_t>(body)].node};
}

PlacedShape Sides::placed(int k, Frame carrier) const {
  const auto index = static_cast<std::size_t>(k);
  if (!is_node(k)) {
    const Frame& inner = contact_.collider[index].frame;
    carrier = {carrier.place(inner.origin), carrier.rotation * inner.rotation};
  }
  return {&shapes_[index], carrier};
}

PlacedShape Sides::placed(int k, const State& state) const {
  const Side own = side(k);
  Frame carrier{state.x.col(own.node)};
  if (own.body >= 0)
    carrier.rotation = state.orientation[static_cast<std::size_t>(own.body)].toRotationMatrix();
  return placed(k, carrier);
}

PlacedShape Sides::placed_as_met(const ClaimedContact& contact, std::size_t side) const {
  return placed(contact.collider[side], Frame{-contact.met->arm[side], contact.met->rotation[side]});
}

Vec3 Sides::velocity(const ClaimedContact& contact, std::size_t side, const State& state) const {
  const Side own = this->side(contact.collider[side]);
  Vec3 v = state.v.col(own.node);
  if (own.body < 0) return v;
  const Vec3 spin = state.spin.col(own.body);
  if (contact.met) return v + (contact.met->rotation[side] * spin).cross(contact.met->arm[side]);
  const auto& orientation = claim_.end.orientation[static_cast<std::size_t>(own.body)];
  return v + (orientation * spin).cross(contact.point - claim_.end.x.col(own.node));
}

Vec3 Sides::surface_velocity(const ClaimedContact& contact, std::size_t side) const {
  const int k = contact.collider[side];
  if (k >= count() || is_node(k)) return Vec3::Zero();
  const PlacedShape shape = contact.met ? placed_as_met(contact, side) : placed(k, claim_.end);
  return shape.frame.rotation * contact_.collider[static_cast<std::size_t>(k)].surface_velocity;
}

double Sides::lever(const ClaimedContact& contact, std::size_t side) const {
  const Side own = this->side(contact.collider[side]);
  if (own.body < 0) return 0;
  return contact.met ? contact.met->arm[side].norm() : (contact.point - claim_.end.x.col(own.node)).norm();
}

double Sides::longest_lever(int k, int other) const {
  const Side own = side(k);
  if (own.body < 0) return 0;
  double longest = 0;
  if (other >= count())  // a surface: any of its nodes
    for (const auto& triangle : contact_.triangle)
      for (const int node : triangle)
        longest = std::max(longest, (claim_.start.x.col(node) - claim_.start.x.col(own.node)).norm());
  for (const int each : {k, other}) {
    if (each >= count()) continue;
    const PlacedShape shape = placed(each, claim_.start);
    const double outer = size_of(*shape.shape).outer;
    if (std::isfinite(outer))
      longest = std::max(longest, (shape.frame.origin - claim_.start.x.col(own.node)).norm() + outer);
  }
  return longest;
}

double Sides::inverse_mass(int k, double lever) const {
  const Side own = side(k);
  if (own.of_surface()) return 2 * surface_inverse_mass_;  // weights of at most 1 whose squares sum to 2
  double inverse = 1 / claim_.scene.mass[static_cast<std::size_t>(own.node)];
  if (own.body >= 0 && lever > 0)
    inverse += lever * lever / claim_.scene.bodies[static_cast<std::size_t>(own.body)].inertia.minCoeff();
  return inverse;
}

double Sides::least_inverse_mass(int k) const {
  return side(k).of_surface() ? least_surface_inverse_mass_ : inverse_mass(k, 0);
}

const ContactLaw& Sides::law(int a, int b) const {
  const auto material = [&](int k) {
    return k < count() ? contact_.material(static_cast<std::size_t>(k))
                       : surface_material_[static_cast<std::size_t>(k - count())];
  };
  return contact_.of_materials(material(a), material(b));
}

}  // namespace pbd::reference
