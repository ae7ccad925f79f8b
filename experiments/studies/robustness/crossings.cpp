#include "studies/robustness/crossings.h"

#include <algorithm>
#include <limits>

#include "mesh.h"
#include "scenes/body_shapes.h"
#include "scenes/contacts.h"

namespace pbdcheck {

using namespace pbd;

namespace {

using Triangle = std::array<int, 3>;
using Edge = std::array<int, 2>;

double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// True if the edge from p to q goes through the triangle a, b, c.
bool pierces(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  // A volume of edges as long as `size` errs by size^2 times what places err by, which is rounding of the
  // largest coordinate.
  double size = 0, largest = 0;  // m
  for (const Vec3* place : {&p, &q, &a, &b, &c}) {
    size = std::max(size, (*place - a).norm());
    largest = std::max(largest, place->cwiseAbs().maxCoeff());
  }
  const double rounding = 64 * std::numeric_limits<double>::epsilon() * largest * size * size;
  const auto side = [&](double of) { return of > rounding ? 1 : of < -rounding ? -1 : 0; };
  if (side(volume(a, b, c, p)) * side(volume(a, b, c, q)) >= 0) return false;
  const int first = side(volume(p, q, a, b));
  return first != 0 && side(volume(p, q, b, c)) == first && side(volume(p, q, c, a)) == first;
}

Eigen::AlignedBox3d box_of(const Points& x, const Triangle& triangle) {
  Eigen::AlignedBox3d box;
  for (const int node : triangle) box.extend(Vec3(x.col(node)));
  return box;
}

bool shares_node(const Edge& edge, const Triangle& triangle) {
  return std::any_of(edge.begin(), edge.end(), [&](int node) {
    return std::find(triangle.begin(), triangle.end(), node) != triangle.end();
  });
}

/// True if one of the edges, with ends `y`, goes through the triangle with corners `x`; `own`: they are
/// numbered alike.
bool crossed(const Points& x, const Triangle& triangle, const Points& y, const std::vector<Edge>& edges,
             bool own) {
  const Eigen::AlignedBox3d box = box_of(x, triangle);
  return std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
    const Vec3 p = y.col(edge[0]), q = y.col(edge[1]);
    if ((p.cwiseMin(q).array() > box.max().array()).any() ||
        (p.cwiseMax(q).array() < box.min().array()).any())
      return false;
    return !(own && shares_node(edge, triangle)) &&
           pierces(p, q, x.col(triangle[0]), x.col(triangle[1]), x.col(triangle[2]));
  });
}

}  // namespace

Crossings::Crossings(const Scene& scene) : scene_(scene) {
  const Contact& contact = *contact_of(scene);
  if (contact.triangle.empty()) return;
  own_ = contact.surfaces_touch;
  soft_.triangle = contact.triangle;
  soft_.edge = edges(TriangleMesh{{}, contact.triangle});
  for (const Collider& collider : contact.collider) {
    if (std::holds_alternative<std::monostate>(collider.shape)) continue;
    Part part{collider.body, std::holds_alternative<HalfSpace>(collider.shape), collider.frame};
    if (!part.plane) {
      TriangleMesh surface = surface_of(collider.shape);
      part.edge = edges(surface);
      part.triangle = std::move(surface.triangles);
      part.x = std::move(surface.x);
    }
    shapes_.push_back(std::move(part));
  }
}

Points Crossings::places(const Part& part, const State& state) const {
  const auto body = static_cast<std::size_t>(part.body);
  const Points in_body = (part.frame.rotation * part.x).colwise() + part.frame.origin;
  return (state.orientation[body].toRotationMatrix() * in_body).colwise() +
         state.x.col(scene_.bodies[body].node);
}

double Crossings::count(const State& state) const {
  std::vector<bool> crossing(soft_.triangle.size(), false);
  const auto mark = [&](const auto& crosses) {
    for (std::size_t i = 0; i < crossing.size(); ++i)
      if (!crossing[i] && crosses(soft_.triangle[i])) crossing[i] = true;
  };
  if (own_) mark([&](const Triangle& own) { return crossed(state.x, own, state.x, soft_.edge, true); });
  for (const Part& part : shapes_) {
    if (part.plane) {
      const auto body = static_cast<std::size_t>(part.body);
      const Vec3 normal = state.orientation[body] * Vec3(part.frame.rotation.col(2));
      const Vec3 origin = state.x.col(scene_.bodies[body].node) + state.orientation[body] * part.frame.origin;
      mark([&](const Triangle& own) {
        return std::any_of(own.begin(), own.end(),
                           [&](int node) { return normal.dot(state.x.col(node) - origin) < 0; });
      });
      continue;
    }
    const Points y = places(part, state);
    mark([&](const Triangle& own) {
      if (crossed(state.x, own, y, part.edge, false)) return true;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<Edge> side{{own[k], own[(k + 1) % 3]}};
        if (std::any_of(part.triangle.begin(), part.triangle.end(),
                        [&](const Triangle& its) { return crossed(y, its, state.x, side, false); }))
          return true;
      }
      return false;
    });
  }
  return static_cast<double>(std::count(crossing.begin(), crossing.end(), true));
}

}  // namespace pbdcheck
