#include "scenes/builder.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"
#include "scenes/choices.h"
#include "scenes/lines.h"

namespace pbdcheck {
namespace {

const std::vector<std::string>& ways_to_choose() {
  static const std::vector<std::string> ways{"node", "nodes", "near_m", "box_m", "corners"};
  return ways;
}

std::vector<std::string> given_ways(Keys& keys) {
  std::vector<std::string> given;
  for (const auto& way : ways_to_choose())
    if (keys.has(way)) given.push_back(way);
  return given;
}

int nearest_node(const pbd::Scene& scene, const NodeRange& range, const pbd::Vec3& point) {
  Eigen::Index nearest = 0;
  (scene.initial.x.middleCols(range.first, range.count).colwise() - point)
      .colwise()
      .squaredNorm()
      .minCoeff(&nearest);
  return range.first + static_cast<int>(nearest);
}

std::vector<int> nodes_in_box(Keys& keys, const pbd::Scene& scene, const NodeRange& range) {
  const auto box = keys.vectors("box_m");
  if (box.size() != 2 || (box[0].array() > box[1].array()).any())
    keys.refuse("box_m", "[[lowest x, y, z], [highest x, y, z]]");
  std::vector<int> found;
  for (int node = range.first; node < range.first + range.count; ++node) {
    const auto x = scene.initial.x.col(node).array();
    if ((x >= box[0].array()).all() && (x <= box[1].array()).all()) found.push_back(node);
  }
  if (found.empty()) keys.refuse("box_m", "a box without nodes", "a box with at least one node");
  return found;
}

std::vector<int> corner_nodes(Keys& keys, const pbd::Scene& scene, const NodeRange& range) {
  const auto x = scene.initial.x.middleCols(range.first, range.count);
  const pbd::Vec3 lowest = x.rowwise().minCoeff();
  const pbd::Vec3 size = x.rowwise().maxCoeff() - lowest;
  std::vector<int> found;
  for (const auto& corner : keys.vectors("corners")) {
    if (corner.minCoeff() < 0 || corner.maxCoeff() > 1)
      keys.refuse("corners", "places from [0, 0, 0] to [1, 1, 1], the bounding box");
    found.push_back(nearest_node(scene, range, lowest + size.cwiseProduct(corner)));
  }
  return found;
}

std::vector<int> indexed_nodes(Keys& keys, const NodeRange& range, std::string_view key) {
  std::vector<int> found =
      key == "node" ? std::vector<int>{keys.integer_or("node", 0, 0)} : keys.integers("nodes", 0);
  for (int& node : found) {
    if (node >= range.count)
      keys.refuse(key, std::to_string(node), fmt::format("a node index from 0 to {}", range.count - 1));
    node += range.first;
  }
  return found;
}

}  // namespace

void Builder::reserve(const Keys& keys, std::string_view key, double count) {
  elements += count;
  if (elements > most_elements)
    keys.refuse(key, fmt::format("{:.0f} elements ({:.0f} in the scene so far)", count, elements),
                fmt::format("at most {:.0f} links, triangles and tetrahedra in a scene", most_elements));
}

void Builder::anchor(const Keys& keys, const std::vector<int>& nodes, double compliance,
                     pbd::Anchor& effect) {
  for (const int node : nodes) {
    if (!anchored.insert(node).second)
      throw pbd::SetupError(keys.where(), fmt::format("node {} anchored twice", node), "one anchor per node");
    if (scene.mass[static_cast<std::size_t>(node)] == pbd::infinity)
      throw pbd::SetupError(keys.where(), fmt::format("an anchor on node {}, which is fixed", node),
                            "anchors on nodes of finite mass");
    effect.node.push_back(node);
    effect.target.emplace_back(scene.initial.x.col(node));
    effect.compliance.push_back(compliance);
  }
}

std::vector<std::string> Builder::body_names() const {
  std::vector<std::string> names{"world"};
  for (const auto& body : bodies)
    if (body.name != "world") names.push_back(body.name);
  return names;
}

int Builder::body(Keys& keys, std::string_view key) {
  return body(keys, key, keys.choice(key, body_names()));
}

int Builder::body(const Keys& keys, std::string_view key, const std::string& name) {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].name == name) return static_cast<int>(i);
  if (name != "world") keys.refuse(key, "`" + name + "`", allowed_names(name, body_names()));
  bodies.push_back({name, {}, Eigen::Isometry3d::Identity()});
  return pbd::add_body(scene, pbd::Vec3::Zero(), pbd::infinity, pbd::Vec3::Constant(pbd::infinity));
}

bool Builder::moves(int body) const {
  const int node = scene.bodies[static_cast<std::size_t>(body)].node;
  return scene.mass[static_cast<std::size_t>(node)] != pbd::infinity;
}

pbd::Scene Builder::finish() {
  std::stable_sort(placed.begin(), placed.end(),
                   [](const Placed& a, const Placed& b) { return a.line < b.line; });
  for (auto& entry : placed) scene.effects.push_back(std::move(entry.effect));
  for (auto& joint : joints)
    for (auto& part : joint.parts)
      part.effect = static_cast<std::size_t>(
          std::find_if(scene.effects.begin(), scene.effects.end(),
                       [&](const pbd::Effect& effect) { return effect.index() == part.effect; }) -
          scene.effects.begin());
  return std::move(scene);
}

NodeRange numbered_nodes(const pbd::Scene& scene) {
  return {0, scene.bodies.empty() ? scene.nodes() : scene.bodies[0].node};
}

bool chooses_nodes(Keys& keys) {
  return !given_ways(keys).empty();
}

std::vector<int> select_nodes(Keys& keys, const pbd::Scene& scene, const NodeRange& range) {
  const auto given = given_ways(keys);
  const auto allowed = "exactly one of " + joined(ways_to_choose());
  if (given.empty()) {
    keys.refuse_unknown();  // a misspelt key explains more than a missing one
    throw pbd::SetupError(keys.where(), "no choice of nodes", allowed);
  }
  if (given.size() > 1) keys.refuse(given[1], "both " + joined(given), allowed);
  if (range.count == 0)
    keys.refuse(given[0], "a choice in a scene without nodes", "a scene with one; rigid bodies have names");

  const std::string& way = given[0];
  std::vector<int> found;
  if (way == "box_m")
    found = nodes_in_box(keys, scene, range);
  else if (way == "corners")
    found = corner_nodes(keys, scene, range);
  else if (way == "near_m")
    found = {nearest_node(scene, range, keys.vector("near_m"))};
  else
    found = indexed_nodes(keys, range, way);
  if (found.empty()) keys.refuse(way, "an empty list", "at least one node");
  auto sorted = found;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    keys.refuse(way, fmt::format("node {} twice", *twice - range.first), "each node once");
  return found;
}

double read_damping(Keys& keys) {
  return keys.number_or("damping_s", 0, Range::not_negative);
}

double read_compliance(Keys& keys, std::string_view compliance, std::string_view stiffness) {
  const bool soft = keys.has(compliance);
  if (!keys.has(stiffness)) return keys.number_or(compliance, 0, Range::not_negative);
  if (soft) keys.refuse(stiffness, "a stiffness and a compliance", "one of them");
  const double inverse = 1 / keys.number(stiffness, Range::positive_or_infinite);
  if (inverse > largest_number)
    keys.refuse(stiffness, fmt::format("a number >= {:g}, or inf", 1 / largest_number));
  return inverse;
}

std::optional<Course> read_course(Keys& keys) {
  if (!keys.has("over_time")) return std::nullopt;
  Course course;
  for (const auto& [time, value] : keys.pairs("over_time")) {
    if (!course.time.empty() && !(time > course.time.back()))
      keys.refuse("over_time", fmt::format("the time {} after {}", time, course.time.back()),
                  "times that grow");
    if (!course.time.empty() && !std::isfinite((value - course.value.back()) / (time - course.time.back())))
      keys.refuse(
          "over_time",
          fmt::format("{} after {} within {} s", value, course.value.back(), time - course.time.back()),
          "values that change at a finite rate");
    course.time.push_back(time);
    course.value.push_back(value);
  }
  if (course.time.empty()) keys.refuse("over_time", "an empty list", "at least one [time_s, factor]");
  return course;
}

std::string read_name(Keys& keys, std::string_view key) {
  std::string name = keys.text(key);
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::islower(c) || std::isdigit(c) || c == '_';
  });
  if (name.empty() || !plain) keys.refuse(key, "`" + name + "`", "lower case letters, digits and _");
  return name;
}

std::filesystem::path mesh_path(Keys& keys) {
  auto path = std::filesystem::path(keys.file()).parent_path() / keys.text("file");
  const auto reason = unreadable(path);
  if (!reason.empty())
    keys.refuse("file", path.string() + ", " + reason, "a mesh file, relative to the scene file");
  return path;
}

std::string mesh_name(Keys& keys) {
  return keys.has("file") ? keys.where() + ": " + keys.text("file") : keys.where();
}

Eigen::Matrix3d read_rotation(Keys& keys) {
  const pbd::Vec3 rotation = keys.vector_or("rotation_rad", pbd::Vec3::Zero());
  if (rotation.isZero(0)) return Eigen::Matrix3d::Identity();
  constexpr double known = 1e8;  // rad: a double tells no more than 1e-8 of the angle then
  if (!(rotation.stableNorm() <= known)) keys.refuse("rotation_rad", "at most 1e8 rad in all");
  return Eigen::AngleAxisd(rotation.stableNorm(), rotation.stableNormalized()).matrix();
}

}  // namespace pbdcheck
