// Tables of joints between rigid bodies. Places and axes are given in the
// world as the scene starts. A kind adds a constraint to one effect of the solver or to two of them; each
// effect stands where the first joint that adds to it does.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scenes/choices.h"
#include "scenes/joint_table.h"

namespace pbdcheck {
namespace {

using pbd::Vec3;

constexpr std::array<std::string_view, 8> joint_kinds{"ball",      "hinge",    "weld",  "slider",
                                                      "universal", "distance", "angle", "slide"};

Vec3 read_axis(Keys& keys, std::string_view key) {
  const Vec3 axis = keys.vector(key);
  if (axis.isZero(0)) keys.refuse(key, "the zero vector", "a direction of any length");
  return axis.stableNormalized();
}

/// A constraint of rest value `rest`() whose force is at most `strength`, or, if `min_` or `max_` of the
/// `quantity` stand there, one a limit, whose force acts from one side; `add`(value, bounds) makes one.
template <class Rest, class Add>
void add_limited(JointTable& table, const std::string& quantity, std::string_view strength, Range range,
                 std::initializer_list<std::string_view> of_rest, Rest rest, Add add) {
  const std::string lowest = "min_" + quantity, highest = "max_" + quantity;
  const bool below = table.keys.has(lowest), above = table.keys.has(highest);
  if (!below && !above) {
    const double most = table.keys.number_or(strength, pbd::infinity, Range::positive_or_infinite);
    return add(rest(), {-most, most});
  }
  for (const auto key : of_rest)
    if (table.keys.has(key))
      table.keys.refuse(key, fmt::format("{} and limits", key),
                        "limits alone; a joint of its own for the rest");
  if (below) add(table.keys.number(lowest, range), {0, pbd::infinity});
  if (above) add(table.keys.number(highest, range), {-pbd::infinity, 0});
  if (below && above && !(table.keys.number(lowest, range) < table.keys.number(highest, range)))
    table.keys.refuse(highest, "a number above " + lowest);
}

void add_line(JointTable& table) {
  auto& effect = table.add<pbd::LineJoint>(table.positions());
  effect.point.push_back(table.point);
  effect.axis.push_back(table.own(0, read_axis(table.keys, "axis")));
  if (table.closing) table.builder.script.line(effect.body.size() - 1, *table.closing);
}

void add_point(JointTable& table) {
  auto& effect = table.add<pbd::PointJoint>(table.positions());
  effect.point.push_back(table.point);
  if (table.closing) table.builder.script.point(effect.body.size() - 1, *table.closing);
}

template <class Effect>
void add_axes(const JointTable& table, Effect& effect, std::string_view first, std::string_view second) {
  const Vec3 a = read_axis(table.keys, first), b = read_axis(table.keys, second);
  constexpr double slack = 1e-6;  // rad
  if (first != second && std::abs(a.dot(b)) > slack)
    table.keys.refuse(second, "a direction at right angles to axis");
  effect.axis.push_back({table.own(0, a), table.own(1, b)});
}

void add_distance(JointTable& table) {
  const double initial = table.read_points().norm(), compliance = table.positions();
  const auto rest = [&] {
    const double length = table.keys.number_or("rest_length_m", initial, Range::not_negative);
    if (length == 0 && compliance == 0)
      throw pbd::SetupError(table.keys.where(), "a hard distance of rest length 0",
                            "a rest length or compliance > 0, or a ball");
    return length;
  };
  add_limited(table, "length_m", "max_force_n", Range::positive, {"rest_length_m", "max_force_n", "close_s"},
              rest, [&](double length, const pbd::ForceBounds& bounds) {
                auto& effect = table.add<pbd::BodyDistance>(compliance);
                effect.point.push_back(table.point);
                effect.rest_length.push_back(length);
                if (table.keys.has("close_s"))
                  table.builder.script.length(
                      effect.body.size() - 1,
                      {initial - length, table.keys.number("close_s", Range::positive)});
                table.set_bounds(effect, bounds);
              });
}

void add_slide(JointTable& table) {
  const Vec3 gap = table.read_points(), axis = read_axis(table.keys, "axis");
  const auto rest = [&] { return table.keys.number_or("rest_position_m", axis.dot(gap), Range::finite); };
  add_limited(table, "position_m", "max_force_n", Range::finite,
              {"rest_position_m", "rate_m_s", "over_time", "max_force_n"}, rest,
              [&](double position, const pbd::ForceBounds& bounds) {
                auto& effect = table.add<pbd::SlideJoint>(table.positions());
                effect.point.push_back(table.point);
                effect.axis.push_back(table.own(0, axis));
                effect.rest_position.push_back(position);
                if (const auto course = table.read_rate("rate_m_s", effect.rate))
                  table.builder.script.slide(effect.rate.size() - 1, *course);
                table.set_bounds(effect, bounds);
              });
}

/// The angle is zero at the start. A limit knows it modulo 2 pi, within half a turn of itself.
void add_angle(JointTable& table) {
  const Vec3 axis = table.own(0, read_axis(table.keys, "axis")), reference = axis.unitOrthogonal();
  const auto rest = [&] { return table.keys.number_or("rest_angle_rad", 0, Range::finite); };
  for (const auto* limit : {"min_angle_rad", "max_angle_rad"})
    if (table.keys.has(limit) && std::abs(table.keys.number(limit, Range::finite)) >= std::numbers::pi)
      table.keys.refuse(limit, "an angle between -pi and pi: it is known modulo 2 pi");
  add_limited(table, "angle_rad", "max_torque_n_m", Range::finite,
              {"rest_angle_rad", "rate_rad_s", "over_time", "max_torque_n_m"}, rest,
              [&](double angle, const pbd::ForceBounds& bounds) {
                auto& effect = table.add<pbd::AngleJoint>(table.rotations());
                effect.axis.push_back(axis);
                effect.reference.push_back({reference, table.own(1, table.orientation[0] * reference)});
                effect.rest_angle.push_back(angle);
                if (const auto course = table.read_rate("rate_rad_s", effect.rate))
                  table.builder.script.angle(effect.rate.size() - 1, *course);
                table.set_bounds(effect, bounds);
              });
  if (table.keys.has("min_angle_rad") && table.keys.has("max_angle_rad") &&
      table.keys.number("max_angle_rad", Range::finite) - table.keys.number("min_angle_rad", Range::finite) >=
          std::numbers::pi)
    table.keys.refuse("max_angle_rad", "an angle less than half a turn, pi, above min_angle_rad");
}

NamedJoint read_joint(JointTable& table, const std::string& kind) {
  if (table.keys.has("name")) table.joint.name = read_name(table.keys);
  table.damping = read_damping(table.keys);
  if (kind == "distance") {
    add_distance(table);
  } else if (kind == "slide") {
    add_slide(table);
  } else if (kind == "angle") {
    add_angle(table);
  } else {
    table.read_point();
    if (kind == "slider")
      add_line(table);
    else
      add_point(table);
    if (kind == "hinge") add_axes(table, table.add<pbd::AxisJoint>(table.rotations()), "axis", "axis");
    if (kind == "universal")
      add_axes(table, table.add<pbd::PerpendicularJoint>(table.rotations()), "axis", "second_axis");
    if (kind == "weld" || kind == "slider")
      table.add<pbd::RotationJoint>(table.rotations())
          .rest.push_back((table.orientation[0].conjugate() * table.orientation[1]).normalized());
  }
  table.keys.refuse_unknown();
  return table.joint;
}

}  // namespace

void read_joints(Keys& root, Builder& builder) {
  JointEffects effects;
  for (auto& keys : root.tables("joint")) {
    const auto kind = keys.choice("kind", strings(joint_kinds));
    JointTable table(keys, builder, effects);
    auto joint = read_joint(table, kind);
    for (const auto& other : builder.joints)
      if (!joint.name.empty() && joint.name == other.name)
        keys.refuse("name", "`" + joint.name + "` twice", "a name of its own for each joint");
    builder.joints.push_back(std::move(joint));
  }
  effects.place(builder);
}

}  // namespace pbdcheck
