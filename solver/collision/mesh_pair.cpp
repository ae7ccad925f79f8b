#include "collision/mesh_pair.h"

#include <utility>

#include "collision/edge_minimum.h"
#include "collision/segments.h"

namespace pbd {
namespace {

Feature feature(MeshPlace::Feature of) {
  if (of == MeshPlace::Feature::face) return Feature::face;
  return of == MeshPlace::Feature::edge ? Feature::edge : Feature::node;
}

/// A sphere about y against a mesh's feature.
void write_place(const Vec3& y, double radius, int i, const ClosedMesh& mesh, const MeshPlace& at,
                 const ContactWriter& writer) {
  const auto key = writer.key(Feature::node, i, feature(at.feature), at.i);
  const double gap = at.distance - radius;
  if (at.feature == MeshPlace::Feature::face)
    return writer.write(on_face(y, radius, at.nearest, at.normal, 0), key, gap);
  if (at.distance > 0 && radius > 0) {
    if (at.feature == MeshPlace::Feature::node)
      return writer.write(on_point(y, radius, at.nearest, 0), key, gap);
    const auto& node = mesh.solid.edges[at.i].node;
    const Vec3 along = (mesh.surface.x.col(node[1]) - mesh.surface.x.col(node[0])).normalized();
    return writer.write(on_line(y, radius, at.nearest, along, 0), key, gap);
  }
  writer.write(on_face(y, radius, at.nearest, direction(mesh, at, y), 0), key, gap);
}

/// True of an edge within a plane: what crosses it is over its faces.
bool is_flat(const MeshEdge& edge) {
  constexpr double rounding = 1e-9;  // of a sine
  return edge.cosine > 0 && std::abs(edge.sine) <= rounding;
}

/// True if one of the edges from the node comes nearer to x than `distance`, m.
bool nearer_beside(const ClosedMesh& mesh, int node, const Vec3& x, double distance) {
  const Vec3 from = mesh.surface.x.col(node), to_x = x - from;
  const auto others = mesh.neighbours(node);
  return std::any_of(others.begin(), others.end(), [&](int other) {
    const Vec3 edge = mesh.surface.x.col(other) - from;
    const double arc = std::clamp(edge.dot(to_x) / edge.squaredNorm(), 0.0, 1.0);
    return (to_x - arc * edge).norm() < distance;
  });
}

}  // namespace

bool lowest_about(const ClosedMesh& mesh, int node, const Vec3& normal, double slope) {
  const Vec3 x = mesh.surface.x.col(node);
  const auto others = mesh.neighbours(node);
  return std::all_of(others.begin(), others.end(), [&](int other) {
    const Vec3 to = mesh.surface.x.col(other) - x;
    return normal.dot(to) >= -slope * to.norm();
  });
}

bool MeshPair::lies_above(int node, const Vec3& normal) const {
  if (mesh_a != nullptr)
    return lowest_about(*mesh_a, node, writer.frame_a.rotation.transpose() * normal, tilted + turn);
  return a.rises_from(node, normal, tilted + turn);
}

bool MeshPair::write_flush(int node) const {
  const Vec3& x = a.node(node);
  int best = -1;
  double gap = -infinity;
  const AxisBox box(x.array() - flush, x.array() + flush);
  b.tree.find(box, [&](int triangle) {
    const Vec3& normal = b.solid.faces[triangle].normal;
    const double here = normal.dot(x - b.surface.x.col(b.surface.triangles[triangle][0]));
    if (here <= gap + tiny || std::abs(nearest_of_triangle(b, triangle, x).distance) > flush) return;
    if (!lies_above(node, normal)) return;
    best = triangle;
    gap = here;
  });
  if (best < 0) return false;
  writer.write(on_face(x, 0, b.surface.x.col(b.surface.triangles[best][0]), b.solid.faces[best].normal, 0),
               writer.key(Feature::node, node, Feature::face, best), gap);
  return true;
}

void MeshPair::nodes() const {
  const auto write = [&](int i, const MeshPlace& at) {
    if (lies_above(i, direction(b, at, a.node(i)))) write_place(a.node(i), a.radius, i, b, at, writer);
  };
  for (int i = 0; i < a.node_count(); ++i) {
    MeshPlace nearest{};
    if (!nearest_of_mesh(b, a.node(i), limit, nearest)) continue;
    if (std::abs(nearest.distance) <= flush && write_flush(i)) continue;
    if (nearest.distance <= 0) {
      write(i, nearest);
    } else {
      minima_of_mesh(b, a.node(i), limit, scratch.minima);
      for (const MeshPlace& at : scratch.minima.found) write(i, at);
    }
  }
}

void MeshPair::nodes_inside() const {
  for (int i = 0; i < a.node_count(); ++i) {
    MeshPlace nearest{};
    if (nearest_of_mesh(b, a.node(i), limit, nearest) && nearest.distance < -flush)
      write_place(a.node(i), a.radius, i, b, nearest, writer);
  }
}

double MeshPair::depth_in_a(const Vec3& x, double farthest) const {
  MeshPlace place{};
  if (mesh_a != nullptr) {
    const Vec3 own = writer.frame_a.rotation.transpose() * (x - writer.frame_a.origin);
    return nearest_of_mesh(*mesh_a, own, farthest, place) ? -place.distance : -infinity;
  }
  double depth = a.face_count() > 0 ? infinity : -infinity;
  for (int f = 0; f < a.face_count(); ++f) depth = std::min(depth, a.offset[f] - a.face_normal(f).dot(x));
  return depth;
}

void MeshPair::crossing(int i, int j) const {
  const auto &of_a = a.edge(i), &of_b = b.solid.edges[j];
  const Vec3 from_b = b.surface.x.col(of_b.node[0]), &along_b = b.edge[j].along;
  const double length_b = b.edge[j].length;
  const Vec3 &along_a = a.along[i], &from_a = a.node(of_a.node[0]);
  const double length_a = a.length[i];
  if (!(length_a > 0)) return;
  const Nearest at = nearest({from_a, along_a, length_a}, {from_b, along_b, length_b});
  const double distance = at.apart.norm();
  const bool is_flush = distance <= flush, at_node = at.t <= 0 || at.t >= length_b;
  // Beside an end that is flat, what is deeper below the side than below the cap is the cap's.
  const double end = flat_ends ? std::max(tiny, a.radius - distance) : 0;
  const bool at_node_of_a = at.s <= end || at.s >= length_a - end;
  if ((at_node_of_a || at_node) && !is_flush) return;
  const Vec3 y_a = from_a + at.s * along_a, y_b = from_b + at.t * along_b;
  const auto normal_a = [&](int f) -> const Vec3& { return a.face_normal(f); };
  const auto normal_b = [&](int f) -> const Vec3& { return b.solid.faces[f].normal; };
  const Vec3 outward = normal_b(of_b.face[0]) + normal_b(of_b.face[1]);
  const Vec3 across = along_a.cross(along_b);
  const bool crossed = across.norm() >= crossing_sine, touches = distance <= tiny;
  if (!crossed && (at_node || at_node_of_a || (touches && across.norm() <= rounding))) return;
  Vec3 normal = crossed || touches ? Vec3(across.normalized()) : Vec3(at.apart / distance);
  if (normal.dot(outward) < 0) normal = -normal;
  const bool inside = normal.dot(at.apart) < 0;
  if (!inside && distance - a.radius > writer.reach.margin) return;
  if (is_flush && of_a.face[0] >= 0 && (normal_a(of_a.face[0]) + normal_a(of_a.face[1])).dot(normal) > 0)
    return;  // both shapes are on one side
  const double slope = is_flush ? std::max(turn, flush_part) : inside ? 0 : turn;
  if (!minimum(of_b, along_b, normal, slope, normal_b)) return;
  if (!minimum(of_a, along_a, -normal, slope, normal_a)) return;
  if (at_node_of_a && of_a.face[0] < 0 && !lies_above(of_a.node[at.s <= 0 ? 0 : 1], normal)) return;
  if (inside && !is_flush) {
    const auto below_faces = [](const auto& edge, const Vec3& apart, const auto& normal_of) {
      return std::min(-normal_of(edge.face[0]).dot(apart), -normal_of(edge.face[1]).dot(apart));
    };
    const double depth_b = below_faces(of_b, at.apart, normal_b);
    const double depth_a = of_a.face[0] >= 0 ? below_faces(of_a, -at.apart, normal_a) : -infinity;
    // Of sharp edges that cross, the point of one may be beside the other's faces.
    if (distance > tiny && std::max(depth_a, depth_b) <= tiny) return;
    MeshPlace place{};
    if (!nearest_of_mesh(b, y_a, distance, place) || -place.distance < depth_b - tiny) return;
    if (of_a.face[0] >= 0 && depth_in_a(y_b, distance) < depth_a - tiny) return;
  }
  const auto key = writer.key(Feature::edge, i, Feature::edge, j);
  const double gap = (inside ? -distance : distance) - a.radius;
  ContactPoint contact = on_face(y_a, a.radius, y_b, normal, 0);
  if (crossed)
    contact = on_edges(y_a, along_a, a.radius, y_b, along_b, 0, normal);
  else if (a.radius > 0 && !inside)
    contact = on_line(y_a, a.radius, y_b, along_b, 0);
  writer.write(contact, key, gap);
}

bool MeshPair::look_away(int i, const Vec3& normal, int j) const {
  constexpr double slack = 1e-9;  // of cosines
  if (mesh_a == nullptr) return false;
  const MeshEdge &of_a = mesh_a->edge[i], &of_b = b.edge[j];
  return of_a.cosine + of_b.cosine > slack &&
         normal.dot(of_b.normal) > of_a.sine * of_b.sine - of_a.cosine * of_b.cosine + slack;
}

void MeshPair::edges() const {
  scratch.met.assign(b.solid.edges.size(), -1);
  for (int i = 0; i < a.edge_count(); ++i) {
    if (mesh_a != nullptr && is_flat(mesh_a->edge[i])) continue;
    const Vec3 normal =
        mesh_a != nullptr ? Vec3(writer.frame_a.rotation * mesh_a->edge[i].normal) : Vec3::Zero();
    AxisBox box;
    for (const int node : a.edge(i).node) box.extend(a.node(node));
    box.min().array() -= limit;
    box.max().array() += limit;
    b.tree.find(box, [&](int triangle) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int j = b.solid.sides[3 * triangle + k];
        if (std::exchange(scratch.met[j], i) != i && !is_flat(b.edge[j]) && !look_away(i, normal, j))
          crossing(i, j);
      }
    });
  }
}

void MeshPair::nodes_of_mesh() const {
  AxisBox box;
  for (const Vec3& x : a.x) box.extend(x);
  box.min().array() -= limit;
  box.max().array() += limit;
  const ContactWriter exchanged = writer.exchanged();
  b.tree.find(box, [&](int triangle) {
    for (const int node : b.surface.triangles[triangle]) {
      const Vec3 y = b.surface.x.col(node);
      if (!box.contains(y)) continue;
      if (a.face_count() > 0) over_faces(y, node, exchanged);
      for (int e = 0; e < a.edge_count(); ++e) beside(y, node, e, exchanged);
    }
  });
}

void MeshPair::over_faces(const Vec3& y, int node, const ContactWriter& exchanged) const {
  const auto apart_from = [&](int f) { return a.face_normal(f).dot(y) - a.offset[f]; };
  double most = -infinity;
  for (int f = 0; f < a.face_count(); ++f) most = std::max(most, apart_from(f));
  if (most >= limit) return;
  int best = -1;
  double apart = -infinity;
  for (int f = 0; f < a.face_count(); ++f) {  // several where y is on an edge or a corner
    const double here = apart_from(f);
    if (here < most - flush || here <= apart || (here > 0 && !a.above(f, y, std::max(tiny, flush)))) continue;
    if (!lowest_about(b, node, a.face_normal(f), flat_slope + (here > 0 ? turn : 0))) continue;
    apart = here;
    best = f;
  }
  if (best < 0) return;
  exchanged.write(on_face(y, 0, a.node(a.corner(best, 0)), a.face_normal(best), a.radius),
                  exchanged.key(Feature::node, node, Feature::face, best), apart - a.radius);
}

void MeshPair::beside(const Vec3& y, int node, int e, const ContactWriter& exchanged) const {
  const Vec3 &along = a.along[e], &from = a.node(a.edge(e).node[0]);
  const double arc = along.dot(y - from), length = a.length[e];
  const Vec3 y_a = from + arc * along, apart = y - y_a;
  if (arc <= 0 || arc >= length || apart.dot(b.node_normals.col(node)) >= 0 || apart.norm() >= limit) return;
  if (!minimum(a.edge(e), along, apart, turn, [&](int f) -> const Vec3& { return a.face_normal(f); })) return;
  const double distance = apart.norm();
  if (a.radius == 0 && distance <= tiny) return;
  if (nearer_beside(b, node, y_a, distance - tiny)) return;
  MeshPlace nearest{};  // of the surface, the node must be nearest to the edge's point
  if (!nearest_of_mesh(b, y_a, distance, nearest) || nearest.distance < distance - tiny) return;
  const auto key = exchanged.key(Feature::node, node, Feature::edge, e);
  if (a.radius > 0)
    exchanged.write(on_line(y, 0, from, along, a.radius), key, distance - a.radius);
  else
    exchanged.write(on_face(y, 0, y_a, apart / distance, 0), key, distance);
}

}  // namespace pbd
