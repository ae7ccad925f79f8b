#include "contact/generate.h"

#include "contact/pairs.h"

namespace pbd {

void generate(const Shape& a, const Frame& at_a, const Shape& b, const Frame& at_b, double margin,
              std::vector<ContactPoint>& out) {
  thread_local Core core_a, core_b;
  const Roles roles{at_a, at_b, false, margin, out, out.size()};
  const bool a_core = core_a.place(a, at_a), b_core = core_b.place(b, at_b);
  if (a_core && b_core) return core_core(core_a, core_b, roles);
  if (a_core && std::holds_alternative<HalfSpace>(b)) return core_plane(core_a, roles);
  if (b_core && std::holds_alternative<HalfSpace>(a)) return core_plane(core_b, roles.exchanged());
  const auto *cylinder_a = std::get_if<Cylinder>(&a), *cylinder_b = std::get_if<Cylinder>(&b);
  if (cylinder_a && cylinder_b) return cylinder_cylinder(*cylinder_a, *cylinder_b, roles);
  if (a_core && cylinder_b) return cylinder_core(core_a, *cylinder_b, roles);
  if (b_core && cylinder_a) return cylinder_core(core_b, *cylinder_a, roles.exchanged());
  if (cylinder_a && std::holds_alternative<HalfSpace>(b)) return cylinder_plane(*cylinder_a, roles);
  if (cylinder_b && std::holds_alternative<HalfSpace>(a))
    return cylinder_plane(*cylinder_b, roles.exchanged());
}

}  // namespace pbd
