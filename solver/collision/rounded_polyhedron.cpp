#include "collision/rounded_polyhedron.h"

#include <Eigen/Geometry>

namespace pbd {
namespace {

Polyhedron edge_alone(const Points& x) {
  Polyhedron solid;
  solid.x = x;
  solid.edges.push_back({{0, static_cast<int>(x.cols()) - 1}, {-1, -1}});
  return solid;
}

const Polyhedron point = edge_alone(Points::Zero(3, 1));
const Polyhedron segment = edge_alone((Points(3, 2) << 0, 0, 0, 0, -0.5, 0.5).finished());
const Polyhedron cube = plane_faces(box_surface(Vec3::Ones()));

}  // namespace

void RoundedPolyhedron::place(const Sphere& shape, const Frame& at) {
  place(point, Vec3::Ones(), shape.radius, at);
}

void RoundedPolyhedron::place(const Capsule& shape, const Frame& at) {
  place(segment, Vec3(1, 1, shape.length), shape.radius, at);
}

void RoundedPolyhedron::place(const Box& shape, const Frame& at) {
  place(cube, shape.size, 0, at);
}

void RoundedPolyhedron::place(const ConvexHull& shape, const Frame& at) {
  place(shape.solid, Vec3::Ones(), 0, at);
}

void RoundedPolyhedron::place(const ClosedMesh& shape, const Frame& at) {
  place(shape.solid, Vec3::Ones(), 0, at);
}

void RoundedPolyhedron::place(const RoundedTriangle& shape, const Frame& at) {
  place(shape.solid, Vec3::Ones(), shape.radius, at);
}

void RoundedPolyhedron::place(const Polyhedron& polyhedron, const Vec3& scale, double rounded,
                              const Frame& at) {
  solid = &polyhedron;
  radius = rounded;
  x.clear();
  normal.clear();
  offset.clear();
  along.clear();
  length.clear();
  Vec3 low = Vec3::Constant(infinity), high = -low;
  for (Eigen::Index i = 0; i < solid->x.cols(); ++i) {
    const Vec3 own = scale.cwiseProduct(solid->x.col(i));
    x.push_back(at.place(own));
    low = low.cwiseMin(own);
    high = high.cwiseMax(own);
  }
  size = (high - low).norm();
  for (const auto& face : solid->faces) {
    normal.emplace_back(at.rotation * face.normal);  // a cube's stay when it is stretched along its axes
    offset.push_back(normal.back().dot(node(solid->corners[face.first])));
  }
  for (const auto& each : solid->edges) {
    const Vec3 whole = node(each.node[1]) - node(each.node[0]);
    length.push_back(whole.norm());
    along.push_back(length.back() > 0 ? Vec3(whole / length.back()) : Vec3::Zero());
  }
}

bool RoundedPolyhedron::above(int f, const Vec3& x, double slack) const {
  for (std::size_t i = 0; i < corners(f); ++i) {
    const int e = side(f, i);
    const Vec3 direction = along[e] * (edge(e).face[0] == f ? 1.0 : -1.0);
    if (direction.cross(face_normal(f)).dot(x - node(corner(f, i))) > slack) return false;
  }
  return true;
}

bool RoundedPolyhedron::rises_from(int node, const Vec3& normal, double slope) const {
  for (int e = 0; e < edge_count(); ++e) {
    const auto& ends = edge(e).node;
    if (ends[0] != node && ends[1] != node) continue;
    if ((ends[0] == node ? 1 : -1) * normal.dot(along[e]) < -slope) return false;
  }
  return true;
}

}  // namespace pbd
