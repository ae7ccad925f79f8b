#include "contact/generate.h"

#include "contact/pairs.h"

namespace pbd {
namespace {

/// Frame a as it is placed in frame b.
Frame within(const Frame& a, const Frame& b) {
  return {b.rotation.transpose() * (a.origin - b.origin), b.rotation.transpose() * a.rotation};
}

/// One shape against another whose kind comes later in the list: point, segment or polyhedron; cylinder;
/// mesh; half space.
struct Generate {
  const Shape& a;
  const Shape& b;
  const Frame& at_a;
  const Frame& at_b;
  double margin;
  std::vector<ContactPoint>& out;
  bool swapped;

  /// False where they come the other way round.
  bool write() const {
    thread_local Core core_a, core_b;
    const Roles roles{at_a, at_b, swapped, margin, out, out.size()};
    const bool core = core_a.place(a, at_a);
    const auto *cylinder_a = std::get_if<Cylinder>(&a), *cylinder_b = std::get_if<Cylinder>(&b);
    const auto *mesh_a = std::get_if<ClosedMesh>(&a), *mesh_b = std::get_if<ClosedMesh>(&b);
    if (mesh_b != nullptr) {
      const Frame a_in_b = within(at_a, at_b), b_in_a = within(at_b, at_a), own;
      const Roles in_b{a_in_b, own, swapped, margin, out, out.size()};
      const Roles in_a{b_in_a, own, !swapped, margin, out, out.size()};
      if (core_a.place(a, a_in_b)) {
        core_mesh(core_a, *mesh_b, in_b);
      } else if (cylinder_a != nullptr) {
        cylinder_mesh(*cylinder_a, *mesh_b, in_b);
      } else if (mesh_a != nullptr) {
        core_a.place(mesh_a->solid, Vec3::Ones(), 0, a_in_b);
        core_b.place(mesh_b->solid, Vec3::Ones(), 0, b_in_a);
        mesh_mesh(core_a, *mesh_a, core_b, *mesh_b, in_b, in_a);
      } else {
        return false;
      }
      return true;
    }
    if (std::holds_alternative<HalfSpace>(b)) {
      if (mesh_a != nullptr) core_a.place(mesh_a->solid, Vec3::Ones(), 0, at_a);
      if (core || mesh_a != nullptr) core_plane(core_a, roles);
      if (cylinder_a != nullptr) cylinder_plane(*cylinder_a, roles);
      return true;
    }
    if (core && core_b.place(b, at_b)) {
      core_core(core_a, core_b, roles);
    } else if (cylinder_b != nullptr && (core || cylinder_a != nullptr)) {
      if (core)
        cylinder_core(core_a, *cylinder_b, roles);
      else
        cylinder_cylinder(*cylinder_a, *cylinder_b, roles);
    } else {
      return false;
    }
    return true;
  }
};

}  // namespace

void generate(const Shape& a, const Frame& at_a, const Shape& b, const Frame& at_b, double margin,
              std::vector<ContactPoint>& out) {
  if (!Generate{a, b, at_a, at_b, margin, out, false}.write())
    Generate{b, a, at_b, at_a, margin, out, true}.write();
}

}  // namespace pbd
