// Names of the outer iterations.
#pragma once

#include <string_view>
#include <vector>

namespace pbd {

struct OuterName {
  std::string_view name;
  bool solves_step;  // its fixed points are the solutions of the step
};

/// All of them.
std::vector<OuterName> outer_names();

}  // namespace pbd
