// Lists, and lists of lists, among the values of a table.
#include <fmt/format.h>

#include "error.h"
#include "scenes/keys.h"
#include "validate.h"

namespace pbdcheck {
namespace {

constexpr std::string_view vector_text = "a list of three finite numbers up to 1e100 in size";

}  // namespace

pbd::Vec3 Keys::checked_vector(const toml::node& node, std::string_view key) const {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 3)
    throw pbd::SetupError(where_of(&node, key), shown(node), vector_text);
  pbd::Vec3 vector;
  for (int i = 0; i < 3; ++i)
    vector[i] = checked_number((*array)[static_cast<std::size_t>(i)], key, Range::finite);
  if (key == "velocity_m_s" && vector.norm() > pbd::most_speed)  // a scene would refuse it without its line
    throw pbd::SetupError(where_of(&node, key), shown(node),
                          fmt::format("a speed up to {:g} m/s", pbd::most_speed));
  return vector;
}

std::vector<std::string> Keys::texts(std::string_view key, std::size_t size) {
  const auto allowed = fmt::format("a list of {} texts in quotes", size);
  const toml::array& array = need_array(key, allowed);
  if (array.size() != size || !array.is_homogeneous<std::string>()) refuse(key, allowed);
  std::vector<std::string> found;
  for (const auto& entry : array) found.push_back(*entry.value<std::string>());
  return found;
}

pbd::Vec3 Keys::vector(std::string_view key) {
  return checked_vector(need(key, vector_text), key);
}

pbd::Vec3 Keys::vector_or(std::string_view key, const pbd::Vec3& fallback) {
  return has(key) ? vector(key) : fallback;
}

const toml::array& Keys::need_array(std::string_view key, std::string_view allowed) {
  const toml::node& node = need(key, allowed);
  if (!node.is_array()) refuse(key, shown(node), allowed);
  return *node.as_array();
}

std::vector<pbd::Vec3> Keys::vectors(std::string_view key) {
  std::vector<pbd::Vec3> found;
  for (const auto& node : need_array(key, "a list of lists of three numbers"))
    found.push_back(checked_vector(node, key));
  return found;
}

std::vector<double> Keys::numbers(std::string_view key, std::size_t size, Range range) {
  const auto allowed = fmt::format("a list of {} numbers", size);
  const toml::array& array = need_array(key, allowed);
  if (array.size() != size) refuse(key, allowed);
  std::vector<double> found;
  for (const auto& entry : array) found.push_back(checked_number(entry, key, range));
  return found;
}

std::vector<double> Keys::numbers_or_one(std::string_view key, std::size_t size, Range range) {
  const toml::node& node = need(key, description(range));
  if (node.is_array()) return numbers(key, size, range);
  return std::vector<double>(size, checked_number(node, key, range));
}

std::vector<std::array<double, 2>> Keys::pairs(std::string_view key) {
  constexpr std::string_view allowed = "a list of lists of two numbers";
  std::vector<std::array<double, 2>> found;
  for (const auto& node : need_array(key, allowed)) {
    const toml::array* pair = node.as_array();
    if (pair == nullptr || pair->size() != 2)
      throw pbd::SetupError(where_of(&node, key), shown(node), allowed);
    found.push_back(
        {checked_number((*pair)[0], key, Range::finite), checked_number((*pair)[1], key, Range::finite)});
  }
  return found;
}

std::vector<int> Keys::integers(std::string_view key, int smallest) {
  std::vector<int> found;
  for (const auto& node : need_array(key, "a list of integers"))
    found.push_back(checked_integer(node, key, smallest));
  return found;
}

std::vector<std::vector<int>> Keys::integer_lists(std::string_view key, std::size_t width, int smallest) {
  const std::string allowed = fmt::format("a list of {0} integers, or a list of such lists", width);
  const toml::array& array = need_array(key, allowed);
  const auto read = [&](const toml::node& node) {
    if (!node.is_array() || node.as_array()->size() != width)
      throw pbd::SetupError(where_of(&node, key), shown(node), allowed);
    std::vector<int> list;
    for (const auto& entry : *node.as_array()) list.push_back(checked_integer(entry, key, smallest));
    return list;
  };
  if (array.empty() || !array[0].is_array()) return {read(array)};
  std::vector<std::vector<int>> found;
  for (const auto& node : array) found.push_back(read(node));
  return found;
}

}  // namespace pbdcheck
