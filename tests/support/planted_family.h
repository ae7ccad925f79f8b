// Planted contact problems by their family's name.
#pragma once

#include <algorithm>
#include <stdexcept>

#include "planted_cones.h"

namespace pbdcheck::test {

inline pbd::reference::PlantedCone draw_planted(std::string_view family, pbd::reference::FrictionLaw law,
                                                int seed) {
  using namespace pbd::reference;
  const auto families = planted_families();
  const auto found = std::ranges::find(families, family, &PlantedFamily::name);
  if (found == families.end()) throw std::logic_error("no such family");
  return found->draw(law, static_cast<std::uint64_t>(seed));
}

/// Two cubes on each other: W is singular.
inline pbd::reference::PlantedCone stack_problem() {
  return draw_planted("two_boxes", pbd::reference::FrictionLaw::coulomb, 2);
}

}  // namespace pbdcheck::test
