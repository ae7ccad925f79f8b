// Names the user may give: the nearest one to a misspelt name, and lists of them as text.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pbdcheck {

/// The candidate with the smallest edit distance (Levenshtein) to `name`, or an empty string if none is
/// closer than a third of the longer name's length plus one.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

/// "a, b, c".
std::string joined(std::span<const std::string> names);

/// "one of a, b, c; did you mean `b`?": what an error says is allowed in the place of `name`.
std::string allowed_names(std::string_view name, std::span<const std::string> candidates);

/// Throws SetupError at `where` unless `name` is one of the candidates.
void require_name(std::string_view where, std::string_view name, std::span<const std::string> candidates);

std::vector<std::string> strings(std::span<const std::string_view> names);

/// What a scene file and the command line may name.
std::vector<std::string> effect_names();
std::vector<std::string> integrator_choices();
std::vector<std::string> outer_choices();
std::vector<std::string> relaxation_choices();
std::vector<std::string> friction_choices();
std::vector<std::string> rival_names();

}  // namespace pbdcheck
