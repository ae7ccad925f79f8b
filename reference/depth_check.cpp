#include <algorithm>
#include <cmath>

#include "contact_check.h"
#include "mesh_depth.h"
#include "surface_depth.h"
#include "touching_sides.h"
#include "ways_apart.h"

namespace pbd::reference {
namespace {

class Depths {
 public:
  Depths(const StepClaim& claim, const Contact& contact, double level, double overlooked, Findings& findings)
      : claim_(claim),
        contact_(contact),
        sides_(claim, contact),
        level_(level),
        overlooked_(overlooked),
        findings_(findings) {}

  void check_all();
  const WaysOut& refuted() const { return refuted_; }
  std::vector<PressedPair> pressed() const;

 private:
  template <class Look>
  void each_pair(Look&& look) const;
  bool may_be_deep(int i, int j) const;
  void check(int i, int j);
  void check_triangles();
  void check_surfaces();
  void check_triangle(int i, const std::array<int, 3>& nodes);
  bool leaves_out(const ContactLaw& law);
  DistanceBounds over_triangle(int i, const std::array<int, 3>& nodes, const State& state) const;
  bool far(int i, int j, const PlacedShape& a, const PlacedShape& b) const;
  double allowed(int i, int j, double before) const;
  Parting parting(int i, int j, const State& state, double enough) const;

  const StepClaim& claim_;
  const Contact& contact_;
  Sides sides_;
  double level_, overlooked_;
  Findings& findings_;
  WaysOut refuted_;
};

/// Quick: the balls around both do not touch.
bool Depths::far(int i, int j, const PlacedShape& a, const PlacedShape& b) const {
  const double reach = size_of(*a.shape).outer + size_of(*b.shape).outer;
  if (std::isfinite(reach)) return (a.frame.origin - b.frame.origin).norm() > reach;
  if (std::isinf(size_of(*a.shape).outer) && std::isinf(size_of(*b.shape).outer)) return true;
  return i == j;
}

/// Whether shapes may be deep by their law, for which no bound is known.
bool Depths::leaves_out(const ContactLaw& law) {
  const bool yields = law.compliance > 0, bounces = law.restitution > 0 && !is_euler_step(claim_);
  if (yields)
    findings_.leave_out("depth: where shapes give way");
  else if (bounces)
    findings_.leave_out("depth: where shapes bounce, by this integrator");
  return yields || bounces;
}

/// What a pair may be deep, `before` where the step begins.
double Depths::allowed(int i, int j, double before) const {
  const Size one = size_of(*sides_.placed(i, claim_.end).shape),
             two = size_of(*sides_.placed(j, claim_.end).shape);
  const double round =
      std::min(sides_.is_node(i) ? infinity : one.round, sides_.is_node(j) ? infinity : two.round);
  const auto reach = [](const Size& size) { return std::isfinite(size.outer) ? size.outer : 0.0; };
  const bool at_start = explicit_forces(claim_);
  const double inverse = sides_.inverse_mass(i, at_start ? sides_.longest_lever(i, j) : reach(one)) +
                         sides_.inverse_mass(j, at_start ? sides_.longest_lever(j, i) : reach(two));
  const double size = claim_.end.x.cwiseAbs().maxCoeff() + reach(one) + reach(two);
  return std::max(before, std::isfinite(round) ? overlooked_ * round : 0.0) +
         (1 + sides_.law(i, j).friction) * level_ * std::sqrt(inverse) * claim_.h + step_rounding * size;
}

/// What parts a pair soonest; one of `enough` (m) needs no better one.
Parting Depths::parting(int i, int j, const State& state, double enough) const {
  const PlacedShape a = sides_.placed(i, state), b = sides_.placed(j, state);
  std::vector<Vec3> ways;
  if (!is_half_space(*a.shape) && !is_half_space(*b.shape))
    for (const ClaimedContact& claimed : claim_.contacts) {
      if (claimed.collider == std::array{i, j}) ways.push_back(claimed.normal);
      if (claimed.collider == std::array{j, i}) ways.emplace_back(-claimed.normal);
    }
  if (const double told = separation(a, b, ways); told >= enough) return {told};
  for (const Vec3& way : ways_apart(a, b)) ways.push_back(way);
  return least_parting(a, b, ways);
}

bool Depths::may_be_deep(int i, int j) const {
  return !far(i, j, sides_.placed(i, claim_.end), sides_.placed(j, claim_.end)) &&
         sides_.inverse_mass(i, 1) + sides_.inverse_mass(j, 1) > 0 &&
         may_touch(claim_.scene, contact_, sides_.side(i), sides_.side(j));
}

void Depths::check(int i, int j) {
  if (!may_be_deep(i, j) || leaves_out(sides_.law(i, j))) return;
  const PlacedShape a = sides_.placed(i, claim_.end), b = sides_.placed(j, claim_.end);
  double most = allowed(i, j, 0);
  const bool half_space = is_half_space(*a.shape) || is_half_space(*b.shape);
  if (!(is_convex(*a.shape) && is_convex(*b.shape)) && !half_space) {
    const double depth = proved_depth(a, b, most);
    const bool deep = depth > most && proved_depth(sides_.placed(i, claim_.start),
                                                   sides_.placed(j, claim_.start), most) > most;
    if (deep) return findings_.leave_out("depth: closed meshes that begin in something");
    return findings_.require("depth", name_of(i, j) + ", m", depth, most);
  }
  const Parting end = parting(i, j, claim_.end, -most);
  if (end.apart < -most) most = allowed(i, j, -parting(i, j, claim_.start, 0).apart);
  findings_.require("depth", name_of(i, j) + ", m", -end.apart, most);
  if (!(end.apart >= -most)) refuted_[{i, j}] = {end.along};
}

/// Of collider i over the triangle's middle plane; of a half space the least of its nodes; of a closed mesh
/// what it leaves of half the thickness.
DistanceBounds Depths::over_triangle(int i, const std::array<int, 3>& nodes, const State& state) const {
  const PlacedShape shape = sides_.placed(i, state);
  std::array<Vec3, 3> corner;
  for (const std::size_t k : {0, 1, 2}) corner[k] = state.x.col(nodes[k]);
  if (std::holds_alternative<ClosedMesh>(*shape.shape)) {
    const double radius = contact_.thickness / 2, left = radius - proved_depth(shape, corner, radius);
    return {left, left};
  }
  if (!is_half_space(*shape.shape)) return distance(shape, corner);
  double least = infinity;
  for (const Vec3& x : corner)
    least = std::min(least, shape.frame.rotation.col(2).dot(x - shape.frame.origin));
  return {least, least};
}

/// Half the surfaces' thickness is kept free; what begins with the triangle cut has no depth.
void Depths::check_triangle(int i, const std::array<int, 3>& nodes) {
  const double radius = contact_.thickness / 2;
  const PlacedShape shape = sides_.placed(i, claim_.end);
  const double outer = size_of(*shape.shape).outer;
  const Vec3 first = claim_.end.x.col(nodes[0]);
  const double side =
      std::max((claim_.end.x.col(nodes[1]) - first).norm(), (claim_.end.x.col(nodes[2]) - first).norm());
  if ((shape.frame.origin - first).norm() > outer + side + radius) return;
  const ContactLaw& law = sides_.law(i, sides_.of_node(nodes[0]));
  if (leaves_out(law)) return;
  const DistanceBounds end = over_triangle(i, nodes, claim_.end);
  if (end.found >= radius) return findings_.require("depth", "of a triangle, m", radius - end.found, 0);
  const DistanceBounds start = over_triangle(i, nodes, claim_.start);
  if (!(start.proved > 0)) return findings_.leave_out("depth: triangles that are cut as a step begins");
  const double reach = (first - claim_.end.x.col(sides_.side(i).node)).norm() + side;
  const double round = size_of(*shape.shape).round;
  const double inverse = sides_.inverse_mass(i, reach) + sides_.inverse_mass(sides_.of_node(nodes[0]), 0);
  const double size = claim_.end.x.cwiseAbs().maxCoeff() + (std::isfinite(outer) ? outer : 0.0);
  const double most =
      std::max(std::max(0.0, radius - start.proved), std::isfinite(round) ? overlooked_ * round : 0.0) +
      (1 + law.friction) * level_ * std::sqrt(inverse) * claim_.h + step_rounding * size;
  findings_.require("depth",
                    (sides_.is_node(i) ? "sphere " : "collider ") + std::to_string(i) +
                        " in the triangle of nodes " + std::to_string(nodes[0]) + ", " +
                        std::to_string(nodes[1]) + " and " + std::to_string(nodes[2]) + ", m",
                    radius - end.found, most);
}

/// Surfaces are round by half their thickness.
void Depths::check_surfaces() {
  if (!contact_.surfaces_touch) return;
  const double inverse = sides_.inverse_mass(sides_.of_node(contact_.triangle[0][0]), 0);
  const auto missed_by = [&](double friction) {
    return (1 + friction) * level_ * std::sqrt(inverse) * claim_.h +
           step_rounding * claim_.end.x.cwiseAbs().maxCoeff();
  };
  ++findings_.compared;
  for (const SurfaceOverlap& found :
       surface_overlaps(contact_.triangle, claim_.end.x, contact_.thickness, missed_by(0))) {
    const ContactLaw& law = sides_.law(sides_.of_node(found.node[0]), sides_.of_node(found.node[2]));
    const double missed = missed_by(law.friction);
    if (!(found.depth > missed) || leaves_out(law)) continue;
    if (found.crease) {
      findings_.leave_out("depth: surfaces beside their creases");
      continue;
    }
    const double before = depth_of(found, claim_.start.x, contact_.thickness);
    if (found.kind == SurfaceOverlap::Kind::through && before > 0) {
      findings_.leave_out("depth: surfaces that begin through each other");
      continue;
    }
    findings_.require("depth", found.name() + ", m", found.depth,
                      std::max(before, overlooked_ * contact_.thickness / 2) + missed);
  }
}

void Depths::check_triangles() {
  if (contact_.triangle.empty()) return;
  check_surfaces();
  AxisBox all;
  for (const auto& nodes : contact_.triangle)
    for (const int node : nodes) all.extend(Vec3(claim_.end.x.col(node)));
  for (int i = 0; i < sides_.count(); ++i) {
    const PlacedShape shape = sides_.placed(i, claim_.end);
    const double reach = size_of(*shape.shape).outer + contact_.thickness / 2;
    if (all.squaredExteriorDistance(shape.frame.origin) > reach * reach) continue;
    for (const std::size_t k : free_triangles(claim_.scene, contact_, sides_.side(i)))
      check_triangle(i, contact_.triangle[k]);
  }
}

template <class Look>
void Depths::each_pair(Look&& look) const {
  const auto colliders = static_cast<int>(contact_.collider.size());
  for (int i = 0; i < (contact_.nodes_touch ? sides_.count() : colliders); ++i)
    for (int j = i + 1; j < sides_.count(); ++j) look(i, j);
}

void Depths::check_all() {
  each_pair([&](int i, int j) { check(i, j); });
  check_triangles();
}

std::vector<PressedPair> Depths::pressed() const {
  std::vector<PressedPair> found;
  each_pair([&](int i, int j) {
    if (!(sides_.law(i, j).compliance > 0) || !may_be_deep(i, j)) return;
    const PlacedShape a = sides_.placed(i, claim_.end), b = sides_.placed(j, claim_.end);
    const bool convex = is_convex(*a.shape) && is_convex(*b.shape);
    const double least = allowed(i, j, 0);
    const double depth = convex || is_half_space(*a.shape) || is_half_space(*b.shape)
                             ? -parting(i, j, claim_.end, -least).apart
                             : proved_depth(a, b, least);
    if (depth > least) found.push_back({{i, j}, depth - least});
  });
  return found;
}

}  // namespace

WaysOut check_depths(const StepClaim& claim, const Contact& contact, double level, double overlooked,
                     Findings& findings) {
  Depths depths(claim, contact, level, overlooked, findings);
  depths.check_all();
  return depths.refuted();
}

std::vector<PressedPair> pressed_pairs(const StepClaim& claim, const Contact& contact, double overlooked) {
  Findings none;
  return Depths(claim, contact, 0, overlooked, none).pressed();
}

}  // namespace pbd::reference
