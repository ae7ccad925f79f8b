// Laws of friction by name; what they say is in rows/laws.h.
#pragma once

#include <array>
#include <string_view>

namespace pbd {

enum class Friction { coulomb, cone, box, disc };
inline constexpr std::array<std::string_view, 4> friction_names{"coulomb", "cone", "box", "disc"};

/// The law of that name; throws SetupError listing the allowed ones.
Friction friction_by_name(std::string_view name);

}  // namespace pbd
