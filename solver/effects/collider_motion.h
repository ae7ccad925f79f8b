// How far what may touch goes in a step: a body's shape, a node's sphere, or a triangle of a surface.
#pragma once

#include "shapes.h"

namespace pbd {

enum class Carrier : std::uint8_t { body, node, triangle };

struct ColliderMotion {
  Shape node_shape;    // of a node
  const Shape* shape;  // in `frame`; of a triangle none
  Frame frame;         // in the world
  Carrier kind = Carrier::body;
  int carrier = -1;            // body, node or triangle
  bool moves = false;          // by impulses
  Vec3 centre;                 // m, of the body; of a triangle the mean of its nodes
  double radius = 0;           // m, of the farthest point about it; infinite for a half space
  double round = 0;            // m, radius of what is round of the shape
  Vec3 course = Vec3::Zero();  // m, where its velocity takes it
  double beside = 0;           // m, that its points go beside its course, as far as is known
  double travel = 0;   // m, that its points move at most beside its course; of a half space, its centre
  double turn = 0;     // rad, that it turns at most
  bool grown = false;  // it goes farther than it was searched for
  double height = 0;   // m, the least one of a triangle
};

struct Displacement {
  double shift, turn;  // m, rad
};

/// Of the points of the collider, beside its course; of a half space, of its body's centre. m
double farthest_travel(const ColliderMotion& motion, const Displacement& moved);

/// By how much a gap between two falls at most, m.
double travel_between(const ColliderMotion& one, const ColliderMotion& two);

/// The smaller one, m; nodes touch by planes, and have none that counts, nor do triangles.
double round_radius_of(const ColliderMotion& one, const ColliderMotion& two);

}  // namespace pbd
