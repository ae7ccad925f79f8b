// Tables of joints between rigid bodies, and of nodes that bodies hold. Places and axes are given in the
// world as the scene starts. A kind adds a constraint to one effect of the solver or to two of them; each
// effect stands where the first joint that adds to it does.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <tuple>

#include "builder.h"
#include "choices.h"

namespace pbdcheck {
namespace {

using pbd::Vec3;

constexpr std::array<std::string_view, 8> joint_kinds{"ball",      "hinge",    "weld",  "slider",
                                                      "universal", "distance", "angle", "slide"};

template <class Effect>
struct Slot {
  Effect effect;
  int line = 0;
};

/// The effects that joints make.
struct JointEffects {
  std::tuple<Slot<pbd::PointJoint>, Slot<pbd::AxisJoint>, Slot<pbd::PerpendicularJoint>,
             Slot<pbd::RotationJoint>, Slot<pbd::LineJoint>, Slot<pbd::BodyDistance>, Slot<pbd::AngleJoint>,
             Slot<pbd::SlideJoint>>
      slots;

  void place(Builder& builder) {
    const auto add = [&](auto& slot) {
      if (!slot.effect.body.empty()) builder.add(slot.line, std::move(slot.effect));
    };
    std::apply([&](auto&... slot) { (add(slot), ...); }, slots);
  }
};

Vec3 read_axis(Keys& keys, std::string_view key) {
  const Vec3 axis = keys.vector(key);
  if (axis.isZero(0)) keys.refuse(key, "the zero vector", "a direction of any length");
  return axis.stableNormalized();
}

class JointReader {
 public:
  JointReader(Keys& keys, Builder& builder, JointEffects& effects)
      : keys_(keys), builder_(builder), effects_(effects) {
    const auto names = keys.texts("bodies", 2);
    for (std::size_t k = 0; k < 2; ++k) body_[k] = builder.body(keys, "bodies", names[k]);
    if (body_[0] == body_[1]) keys.refuse("bodies", "`" + names[0] + "` twice", "two different bodies");
    if (!builder.moves(body_[0]) && !builder.moves(body_[1]))
      keys.refuse("bodies", "two bodies that nothing moves", "a body with held = \"free\"");
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& initial = builder.scene.initial;
      const auto index = static_cast<std::size_t>(body_[k]);
      orientation_[k] = initial.orientation[index];
      centre_[k] = initial.x.col(builder.scene.bodies[index].node);
    }
    joint_.body = body_[1];
    joint_.where = keys.where();
  }

  NamedJoint read(const std::string& kind) {
    if (keys_.has("name")) joint_.name = read_name(keys_);
    damping_ = read_damping(keys_);
    if (kind == "distance") {
      add_distance();
    } else if (kind == "slide") {
      add_slide();
    } else if (kind == "angle") {
      add_angle();
    } else {
      read_point();
      if (kind == "slider")
        add_line();
      else
        add<pbd::PointJoint>(positions()).point.push_back(point_);
      if (kind == "hinge") add_axes(add<pbd::AxisJoint>(rotations()), "axis", "axis");
      if (kind == "universal") add_axes(add<pbd::PerpendicularJoint>(rotations()), "axis", "second_axis");
      if (kind == "weld" || kind == "slider")
        add<pbd::RotationJoint>(rotations())
            .rest.push_back((orientation_[0].conjugate() * orientation_[1]).normalized());
    }
    keys_.refuse_unknown();
    return joint_;
  }

 private:
  double positions() { return read_compliance(keys_); }
  double rotations() { return read_compliance(keys_, "compliance_rad_per_n_m", "stiffness_n_m_per_rad"); }

  /// A direction of the world, and a place in it, in the frame of body k.
  Vec3 own(std::size_t k, const Vec3& direction) const { return orientation_[k].conjugate() * direction; }
  Vec3 own_point(std::size_t k, const Vec3& place) const { return own(k, place - centre_[k]); }

  /// A constraint of `Effect` with all that every joint states.
  template <class Effect>
  Effect& add(double compliance) {
    auto& [effect, line] = std::get<Slot<Effect>>(effects_.slots);
    if (effect.body.empty()) line = keys_.line();
    joint_.parts.push_back({pbd::Effect(Effect{}).index(), effect.body.size()});
    effect.body.push_back(body_);
    effect.compliance.push_back(compliance);
    set_damping(effect, effect.body.size() - 1, damping_);
    joint_.compliant = joint_.compliant || compliance > 0;
    return effect;
  }

  /// Bounds of the last constraint's force; an effect without any stays without.
  template <class Effect>
  void set_bounds(Effect& effect, const pbd::ForceBounds& bounds) {
    constexpr pbd::ForceBounds none{-pbd::infinity, pbd::infinity};
    joint_.bounded = joint_.bounded || bounds != none;
    if (bounds == none && effect.bounds.empty()) return;
    effect.bounds.resize(effect.body.size(), none);
    effect.bounds.back() = bounds;
  }

  void read_point() {
    const Vec3 place = keys_.vector("point_m");
    point_ = {own_point(0, place), own_point(1, place)};
    joint_.point = point_[1];
  }

  /// A constraint of rest value `rest`() whose force is at most `strength`, or, if `min_` or `max_` of the
  /// `quantity` stand there, one a limit, whose force acts from one side; `add`(value, bounds) makes one.
  template <class Rest, class Add>
  void add_limited(const std::string& quantity, std::string_view strength, Range range,
                   std::initializer_list<std::string_view> of_rest, Rest rest, Add add) {
    const std::string lowest = "min_" + quantity, highest = "max_" + quantity;
    const bool below = keys_.has(lowest), above = keys_.has(highest);
    if (!below && !above) {
      const double most = keys_.number_or(strength, pbd::infinity, Range::positive_or_infinite);
      return add(rest(), {-most, most});
    }
    for (const auto key : of_rest)
      if (keys_.has(key))
        keys_.refuse(key, fmt::format("{} and limits", key), "limits alone; a joint of its own for the rest");
    if (below) add(keys_.number(lowest, range), {0, pbd::infinity});
    if (above) add(keys_.number(highest, range), {-pbd::infinity, 0});
    if (below && above && !(keys_.number(lowest, range) < keys_.number(highest, range)))
      keys_.refuse(highest, "a number above " + lowest);
  }

  /// The distance vector of the two places.
  Vec3 read_points() {
    const auto places = keys_.vectors("points_m");
    if (places.size() != 2) keys_.refuse("points_m", "a place of the first body and one of the second");
    point_ = {own_point(0, places[0]), own_point(1, places[1])};
    joint_.point = point_[1];
    return places[1] - places[0];
  }

  void add_line() {
    auto& effect = add<pbd::LineJoint>(positions());
    effect.point.push_back(point_);
    effect.axis.push_back(own(0, read_axis(keys_, "axis")));
  }

  template <class Effect>
  void add_axes(Effect& effect, std::string_view first, std::string_view second) {
    const Vec3 a = read_axis(keys_, first), b = read_axis(keys_, second);
    constexpr double slack = 1e-6;  // rad
    if (first != second && std::abs(a.dot(b)) > slack)
      keys_.refuse(second, "a direction at right angles to axis");
    effect.axis.push_back({own(0, a), own(1, b)});
  }

  /// A motor's rate, and its factor over time.
  std::optional<Course> read_rate(std::string_view key, std::vector<double>& rates) {
    rates.push_back(keys_.number_or(key, 0, Range::finite));
    auto course = read_course(keys_);
    if (course && !keys_.has(key))
      keys_.refuse("over_time", "a course without a rate", fmt::format("{}, which it multiplies", key));
    return course;
  }

  void add_distance() {
    const double initial = read_points().norm(), compliance = positions();
    const auto rest = [&] {
      const double length = keys_.number_or("rest_length_m", initial, Range::not_negative);
      if (length == 0 && compliance == 0)
        throw pbd::SetupError(keys_.where(), "a hard distance of rest length 0",
                              "a rest length or compliance > 0, or a ball");
      return length;
    };
    add_limited("length_m", "max_force_n", Range::positive, {"rest_length_m", "max_force_n"}, rest,
                [&](double length, const pbd::ForceBounds& bounds) {
                  auto& effect = add<pbd::BodyDistance>(compliance);
                  effect.point.push_back(point_);
                  effect.rest_length.push_back(length);
                  set_bounds(effect, bounds);
                });
  }

  void add_slide() {
    const Vec3 gap = read_points(), axis = read_axis(keys_, "axis");
    const auto rest = [&] { return keys_.number_or("rest_position_m", axis.dot(gap), Range::finite); };
    add_limited("position_m", "max_force_n", Range::finite,
                {"rest_position_m", "rate_m_s", "over_time", "max_force_n"}, rest,
                [&](double position, const pbd::ForceBounds& bounds) {
                  auto& effect = add<pbd::SlideJoint>(positions());
                  effect.point.push_back(point_);
                  effect.axis.push_back(own(0, axis));
                  effect.rest_position.push_back(position);
                  if (const auto course = read_rate("rate_m_s", effect.rate))
                    builder_.script.slide(effect.rate.size() - 1, *course);
                  set_bounds(effect, bounds);
                });
  }

  /// The angle is zero at the start. A limit knows it modulo 2 pi, within half a turn of itself.
  void add_angle() {
    const Vec3 axis = read_axis(keys_, "axis"), reference = axis.unitOrthogonal();
    const auto rest = [&] { return keys_.number_or("rest_angle_rad", 0, Range::finite); };
    for (const auto* limit : {"min_angle_rad", "max_angle_rad"})
      if (keys_.has(limit) && std::abs(keys_.number(limit, Range::finite)) >= std::numbers::pi)
        keys_.refuse(limit, "an angle between -pi and pi: it is known modulo 2 pi");
    add_limited("angle_rad", "max_torque_n_m", Range::finite,
                {"rest_angle_rad", "rate_rad_s", "over_time", "max_torque_n_m"}, rest,
                [&](double angle, const pbd::ForceBounds& bounds) {
                  auto& effect = add<pbd::AngleJoint>(rotations());
                  effect.axis.push_back(own(0, axis));
                  effect.reference.push_back({own(0, reference), own(1, reference)});
                  effect.rest_angle.push_back(angle);
                  if (const auto course = read_rate("rate_rad_s", effect.rate))
                    builder_.script.angle(effect.rate.size() - 1, *course);
                  set_bounds(effect, bounds);
                });
    if (keys_.has("min_angle_rad") && keys_.has("max_angle_rad") &&
        keys_.number("max_angle_rad", Range::finite) - keys_.number("min_angle_rad", Range::finite) >=
            std::numbers::pi)
      keys_.refuse("max_angle_rad", "an angle less than half a turn, pi, above min_angle_rad");
  }

  Keys& keys_;
  Builder& builder_;
  JointEffects& effects_;
  NamedJoint joint_;
  std::array<int, 2> body_{};
  std::array<Eigen::Quaterniond, 2> orientation_;
  std::array<Vec3, 2> centre_, point_;
  double damping_ = 0;
};

}  // namespace

void read_joints(Keys& root, Builder& builder) {
  JointEffects effects;
  for (auto& keys : root.tables("joint")) {
    const auto kind = keys.choice("kind", strings(joint_kinds));
    auto joint = JointReader(keys, builder, effects).read(kind);
    for (const auto& other : builder.joints)
      if (!joint.name.empty() && joint.name == other.name)
        keys.refuse("name", "`" + joint.name + "` twice", "a name of its own for each joint");
    builder.joints.push_back(std::move(joint));
  }
  effects.place(builder);
}

void read_attachments(Keys& root, Builder& builder) {
  auto tables = root.tables("attachment");
  if (tables.empty()) return;
  pbd::Attachment effect;
  std::set<std::array<int, 2>> known;
  for (auto& keys : tables) {
    const int body = builder.body(keys, "body");
    const double compliance = read_compliance(keys), damping = read_damping(keys);
    const auto& scene = builder.scene;
    const auto index = static_cast<std::size_t>(body);
    const std::size_t first = effect.node.size();
    for (const int node : select_nodes(keys, scene, numbered_nodes(scene))) {
      if (!known.insert({body, node}).second)
        throw pbd::SetupError(keys.where(), fmt::format("node {} attached twice to one body", node), "once");
      if (!builder.moves(body) && scene.mass[static_cast<std::size_t>(node)] == pbd::infinity)
        throw pbd::SetupError(keys.where(), fmt::format("node {} and a body that nothing moves", node),
                              "a node of finite mass or a body with held = \"free\"");
      effect.body.push_back(body);
      effect.node.push_back(node);
      effect.point.push_back(scene.initial.orientation[index].conjugate() *
                             (scene.initial.x.col(node) - scene.initial.x.col(scene.bodies[index].node)));
      effect.compliance.push_back(compliance);
    }
    set_damping(effect, first, damping);
    keys.refuse_unknown();
  }
  builder.add(tables[0].line(), std::move(effect));
}

}  // namespace pbdcheck
