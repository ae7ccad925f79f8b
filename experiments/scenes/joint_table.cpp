#include "scenes/joint_table.h"

#include <fmt/format.h>

namespace pbdcheck {

JointTable::JointTable(Keys& table, Builder& scene, JointEffects& made)
    : keys(table), builder(scene), effects(made) {
  const auto names = keys.texts("bodies", 2);
  for (std::size_t k = 0; k < 2; ++k) body[k] = builder.body(keys, "bodies", names[k]);
  if (body[0] == body[1]) keys.refuse("bodies", "`" + names[0] + "` twice", "two different bodies");
  if (!builder.moves(body[0]) && !builder.moves(body[1]))
    keys.refuse("bodies", "two bodies that nothing moves", "a body with held = \"free\"");
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& initial = builder.scene.initial;
    const auto index = static_cast<std::size_t>(body[k]);
    orientation[k] = initial.orientation[index];
    centre[k] = initial.x.col(builder.scene.bodies[index].node);
  }
  joint.body = body[1];
  joint.where = keys.where();
}

void JointTable::read_point() {
  if (keys.has("points_m")) {
    if (keys.has("point_m"))
      keys.refuse("points_m", "one place and two", "point_m, or points_m with close_s");
    closing = {own(0, read_points()), keys.number("close_s", Range::positive)};
    return;
  }
  const pbd::Vec3 place = keys.vector("point_m");
  point = {own_point(0, place), own_point(1, place)};
  joint.point = point[1];
}

pbd::Vec3 JointTable::read_points() {
  const auto places = keys.vectors("points_m");
  if (places.size() != 2) keys.refuse("points_m", "a place of the first body and one of the second");
  point = {own_point(0, places[0]), own_point(1, places[1])};
  joint.point = point[1];
  return places[1] - places[0];
}

std::optional<Course> JointTable::read_rate(std::string_view key, std::vector<double>& rates) {
  rates.push_back(keys.number_or(key, 0, Range::finite));
  auto course = read_course(keys);
  if (course && !keys.has(key))
    keys.refuse("over_time", "a course without a rate", fmt::format("{}, which it multiplies", key));
  return course;
}

}  // namespace pbdcheck
