#include "scenes/choices.h"

#include <algorithm>
#include <numeric>

#include "error.h"
#include "linear/linear_names.h"
#include "names.h"
#include "outer/outer_names.h"
#include "rivals/rival.h"
#include "rows/laws.h"
#include "scene.h"
#include "step/integrators.h"

namespace pbdcheck {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

template <std::size_t... I>
std::vector<std::string> alternative_names(std::index_sequence<I...>) {
  return {std::string(std::variant_alternative_t<I, pbd::Effect>::name)...};
}

}  // namespace

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  std::string nearest;
  std::size_t smallest = std::string::npos;
  for (const auto& candidate : candidates) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < smallest && distance <= std::max(name.size(), candidate.size()) / 3 + 1) {
      smallest = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string joined(std::span<const std::string> names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string allowed_names(std::string_view name, std::span<const std::string> candidates) {
  if (candidates.empty()) return "none, there are no names of this kind";
  const std::string nearest = nearest_name(name, candidates);
  return (candidates.size() == 1 ? "only " : "one of ") + joined(candidates) +
         (nearest.empty() ? "" : "; did you mean `" + nearest + "`?");
}

void require_name(std::string_view where, std::string_view name, std::span<const std::string> candidates) {
  if (std::find(candidates.begin(), candidates.end(), name) == candidates.end())
    throw pbd::SetupError(where, "`" + std::string(name) + "`", allowed_names(name, candidates));
}

std::vector<std::string> strings(std::span<const std::string_view> names) {
  return {names.begin(), names.end()};
}

std::vector<std::string> effect_names() {
  return alternative_names(std::make_index_sequence<std::variant_size_v<pbd::Effect>>());
}
std::vector<std::string> integrator_choices() {
  return strings(pbd::names(pbd::integrators()));
}
std::vector<std::string> outer_choices() {
  return strings(pbd::names(pbd::outer_names()));
}
std::vector<std::string> relaxation_choices() {
  return strings(pbd::linear_solver_names());
}
std::vector<std::string> friction_choices() {
  return strings(pbd::friction_names);
}
std::vector<std::string> rival_names() {
  return strings(pbd::names(pbd::rivals::rivals()));
}

}  // namespace pbdcheck
