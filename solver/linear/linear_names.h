// Names of the linear solvers.
#pragma once

#include <string_view>
#include <vector>

namespace pbd {

/// All of them.
std::vector<std::string_view> linear_solver_names();

/// Those that solve any rows, by themselves and from any start: `solves_any_rows` of their types. Not what
/// goes over the rows of another one in another order (`Reordered`).
std::vector<std::string_view> general_solver_names();

}  // namespace pbd
