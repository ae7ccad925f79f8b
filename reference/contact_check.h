// What the laws of contact say of the forces and places that somebody claims for the end of a step.
//
// A contact's residual is below `level` (sqrt(J), step_check.h): a step -W r of its impulse p, r the velocity
// u_t of the surfaces across the normal and (gap)/h along it, the law takes back to p up to e = level
// sqrt(W). W is at most 1/(1/m_a + 1/m_b), and 1/W at most w = 1/m_a + 1/m_b + |lever|^2/I of both + 2 A/h^2.
// Hence, with s = level sqrt(w), the lever under explicit forces the longest one where the step begins, since
// their directions are taken there:
//   force    -F_n h <= e and (|F_t| - mu F_n) h <= (1 + mu) e; the box law allows sqrt(2) mu
//   open     where F_n h > e the gap is at most (1 + mu) s h; of the convex law it may be mu |u_t| h more
//   spring   what yields by A without a damper or rebound, and is pressed, has the gap told at -A F_n, within
//            what `open` allows and A e/h
//   rebound  where shapes may bounce, pressed ones that end apart do so at e times the speed, along the end's
//            normal, that they had where the step began: h |u_n1 + e u_n0| is at most that of `open`
//   sliding  a step that ends on the cone at q = p + O(e) leaves W r_t = -c q_t/|q_t| + O(e), c >= 0; then
//            |mu F_n u_t + |u_t| F_t| h <= 2 mu (F_n h + e) s + (1 + mu) |u_t| e
//   place    what acts on a deformable surface is no farther from one of its triangles than the thickness,
//            the gap told and the triangle's longest side, by which features may go on as planes and lines
//   meeting  what met on the way touched no farther from either shape than 3e-4 of the smaller round radius,
//            and than both are in each other along the normal
//   gap      told is at least what the shapes' support functions prove along its normal, less s h
//   depth    shapes are not deeper in each other than where the step begins or 1e-4 of the smaller round
//            radius (`round` of support.h), whichever is more, and (1 + mu) s h: with each
//            other and in triangles of surfaces, which keep half a thickness free on both sides. Convex
//            shapes and half spaces as support.h tells, closed meshes as far as mesh_depth.h proves it, where
//            they do not begin deeper than the rest of this
//
// Limits: of what met on the way the forces are judged and that it touched as it stood, not that the way led
// there: that was another iterate's. Under explicit forces the normal told is that of the step's begin, and
// no gap is proved along it; nor is the slip known there or on surfaces by which the convex law opens
// contacts; what touches and should have bounced is not told; sliding is not judged under explicit forces,
// whose directions are those of the step's begin, nor of blended directions, the box law and surfaces; depth
// not of compliant contacts, what bounces under other integrators, which place it by more than its velocity
// at the end, creases of surfaces, and triangles that a body or an edge cuts and closed meshes that are in
// something as a step begins.
#pragma once

#include <array>
#include <vector>

#include "step_claim.h"

namespace pbd::reference {

void check_contacts(const StepClaim& claim, const Contact& contact, double level, Findings& findings);

/// Depth of all pairs of colliders, and of nodes and triangles in colliders (depth_check.cpp). Depths
/// below `overlooked` times the smaller round radius pass. Returns, for each pair of colliders and nodes that
/// is too deep, the direction that parts it soonest.
WaysOut check_depths(const StepClaim& claim, const Contact& contact, double level, double overlooked,
                     Findings& findings);

/// Two colliders or spheres about nodes, by numbers as a claim's, that yield and are in each other.
struct PressedPair {
  std::array<int, 2> sides{};
  double depth = 0;  // m, where the step ends, at least
};

/// All that are deeper than `overlooked` times the smaller round radius, by which depths are told too small
/// (depth_check.cpp).
std::vector<PressedPair> pressed_pairs(const StepClaim& claim, const Contact& contact, double overlooked);

}  // namespace pbd::reference
