#include "collision/generate.h"

#include "collision/convex_convex.h"
#include "collision/convex_cylinder.h"
#include "collision/convex_mesh.h"
#include "collision/cylinder_cylinder.h"
#include "collision/cylinder_mesh.h"
#include "collision/half_space.h"
#include "collision/mesh_mesh.h"

namespace pbd {
namespace {

/// What is a point, a segment or a convex polyhedron with a radius.
template <class S>
concept Convex =
    !std::same_as<S, ClosedMesh> && requires(RoundedPolyhedron solid, const S& shape, const Frame& at) {
  solid.place(shape, at);
};

/// Frame a as it is placed in frame b.
Frame within(const Frame& a, const Frame& b) {
  return {b.rotation.transpose() * (a.origin - b.origin), b.rotation.transpose() * a.rotation};
}

/// The table of pairs of shapes: a generator for each, in one of their two orders. There is no default, so
/// that a shape without its rows does not compile.
struct Pairs {
  const Frame& at_a;
  const Frame& at_b;
  bool swapped;
  const Reach& reach;
  CollisionScratch& scratch;
  std::vector<ContactPoint>& found;

  void operator()(const Convex auto& a, const Convex auto& b) const {
    scratch.b.place(b, at_b);
    convex_convex(placed(a, at_a), scratch.b, in_world(), scratch);
  }
  void operator()(const Convex auto& a, const Cylinder& b) const {
    convex_cylinder(placed(a, at_a), b, in_world());
  }
  void operator()(const Cylinder& a, const Cylinder& b) const { cylinder_cylinder(a, b, in_world()); }

  void operator()(const Convex auto& a, const ClosedMesh& b) const {
    const Frame a_in_b = within(at_a, at_b), own;
    convex_mesh(placed(a, a_in_b), b, writer(a_in_b, own, swapped), scratch);
  }
  void operator()(const Cylinder& a, const ClosedMesh& b) const {
    const Frame a_in_b = within(at_a, at_b), own;
    cylinder_mesh(a, b, writer(a_in_b, own, swapped), scratch);
  }
  void operator()(const ClosedMesh& a, const ClosedMesh& b) const {
    const Frame a_in_b = within(at_a, at_b), b_in_a = within(at_b, at_a), own;
    mesh_mesh(a, b, writer(a_in_b, own, swapped), writer(b_in_a, own, !swapped), scratch);
  }

  void operator()(const Convex auto& a, const HalfSpace&) const {
    polyhedron_half_space(placed(a, at_a), in_world());
  }
  void operator()(const Cylinder& a, const HalfSpace&) const { cylinder_half_space(a, in_world()); }
  void operator()(const ClosedMesh& a, const HalfSpace&) const {
    polyhedron_half_space(placed(a, at_a), in_world());
  }

  /// Two of them overlap wherever they are, unless they are parallel; and no shape touches nothing.
  void operator()(const HalfSpace&, const HalfSpace&) const {}
  void operator()(std::monostate, const auto&) const {}

 private:
  ContactWriter writer(const Frame& a, const Frame& b, bool exchanged) const {
    return {a, b, exchanged, reach, found, found.size()};
  }
  ContactWriter in_world() const { return writer(at_a, at_b, swapped); }

  const RoundedPolyhedron& placed(const auto& shape, const Frame& at) const {
    scratch.a.place(shape, at);
    return scratch.a;
  }
};

template <class A, class B>
concept Listed = requires(const Pairs& pairs, const A& a, const B& b) {
  pairs(a, b);
};

}  // namespace

void generate(const Shape& shape_a, const Frame& at_a, const Shape& shape_b, const Frame& at_b,
              const Reach& reach, CollisionScratch& scratch, std::vector<ContactPoint>& found) {
  std::visit(
      [&]<class A, class B>(const A& a, const B& b) {
        static_assert(Listed<A, B> || Listed<B, A>, "a pair of shapes that the table `Pairs` does not list");
        if constexpr (Listed<A, B>)
          Pairs{at_a, at_b, false, reach, scratch, found}(a, b);
        else if constexpr (Listed<B, A>)
          Pairs{at_b, at_a, true, reach, scratch, found}(b, a);
      },
      shape_a, shape_b);
}

void generate(const RoundedTriangle& a, const Shape& shape_b, const Frame& at_b, const Reach& reach,
              CollisionScratch& scratch, std::vector<ContactPoint>& found) {
  const Frame world;
  std::visit(
      [&]<class B>(const B& b) {
        if constexpr (!std::same_as<B, std::monostate>)
          Pairs{world, at_b, false, reach, scratch, found}(a, b);
      },
      shape_b);
}

bool is_at(const Shape& shape, const Frame& at, const Vec3& place, double distance, CollisionScratch& scratch,
           std::vector<ContactPoint>& found) {
  if (const auto* mesh = std::get_if<ClosedMesh>(&shape)) {
    MeshPlace nearest;
    return nearest_of_mesh(*mesh, at.rotation.transpose() * (place - at.origin), distance, nearest);
  }
  found.clear();
  generate(shape, at, Sphere{distance}, {place, Eigen::Matrix3d::Identity()}, {.margin = 0}, scratch, found);
  return !found.empty();
}

}  // namespace pbd
