#include "friction.h"

#include "names.h"

namespace pbd {

Friction friction_by_name(std::string_view name) {
  for (std::size_t i = 0; i < friction_names.size(); ++i)
    if (friction_names[i] == name) return static_cast<Friction>(i);
  throw unknown_name("friction", name, {friction_names.begin(), friction_names.end()});
}

}  // namespace pbd
