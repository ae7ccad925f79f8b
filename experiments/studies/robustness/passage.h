// Whether two things pass through each other in a step, by distances of their cores: code that shares nothing
// with the solver's search of contacts.
//
// A core is the part of a shape that is drawn in to `core_share` of it about the origin of its frame, from
// which all of the shape must be seen, in convex pieces rounded by a radius: points, segments, polyhedra, of
// cylinders a prism inside, of closed meshes their triangles; of a surface the triangles without their
// thickness. Things pass through each other where cores meet on the way from a step's begin to its end,
// nodes and centres of bodies on straight ways, bodies turning steadily about one axis: of the turns that
// lead to where they end by the one that is nearest to what the end's spin makes of the time. Beside a half
// space the end alone counts: who ends above it has not passed.
//
// The way is walked by what its distance proves: cores g apart along n are apart until
// they have come g nearer along n,
//   rate = max over both of (-n . velocity against each other) + |turn| times the radius about the centres.
#pragma once

#include <array>
#include <vector>

#include "scene.h"

namespace pbdcheck {

inline constexpr double core_share = 0.9;

/// Convex pieces of one thing, carried by a body, in its frame, or by nodes of the scene.
struct Core {
  int body = -1;                         // -1: nodes carry it
  std::vector<pbd::Points> piece{};      // m, of a body
  std::vector<std::vector<int>> node{};  // a piece each
  double radius = 0;                     // m
  bool plane = false;                    // a half space below the only piece, of one point, along `normal`
  pbd::Vec3 normal = pbd::Vec3::UnitZ();

  std::size_t pieces() const { return body < 0 ? node.size() : piece.size(); }
};

/// Of a collider's shape, drawn in to that share of it: 1 is all of it, of a cylinder the prism about it.
Core core_of(const pbd::Collider& collider, double share);

/// Of nodes with a radius (m), drawn in to that share; of triangles.
Core core_of(int node, double radius, double share);
Core core_of(const std::vector<std::array<int, 3>>& triangles);

/// How far the two are apart in a state at least, m; 0 where they meet, and where one is below a half space.
double apart(const pbd::Scene& scene, const Core& a, const Core& b, const pbd::State& at);

/// True if they meet on the way from one state to the other. They are apart where it begins.
bool pass_through(const pbd::Scene& scene, const Core& a, const Core& b, const pbd::State& from,
                  const pbd::State& to);

}  // namespace pbdcheck
