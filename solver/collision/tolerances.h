// What counts as rounding, and what as parallel, in all of the contact geometry. Both are pure numbers:
// lengths are compared with `rounding` times the sizes of the shapes, so that shapes of millimetres and of
// kilometres touch alike.
#pragma once

namespace pbd {

/// Lengths up to this part of the sizes are rounding: differences of coordinates of that size are known to
/// 2e-16 of it, so that a direction taken from a longer one is wrong by less than 1e-6 rad.
inline constexpr double rounding = 1e-9;

/// The sine of the least angle of edges that make a crossing (0.1 rad): below, where they cross depends on
/// the angle ten times as much as on the edges' places.
inline constexpr double crossing_sine = 0.1;

/// Faces that are tilted by less touch with all their corners (rad, as that of a crossing).
inline constexpr double tilted = crossing_sine;

/// The sine of the angle of a rim's tangent and an edge or another rim's up to which they are parallel: their
/// product tells no normal of them.
inline constexpr double parallel_to_rim = 1e-3;

/// Up to this part of the sizes a node lies on a face of a closed mesh, also where it is beside the face or
/// an edge of it by that much: it touches the face that its own surface lies above. The least depth
/// that a search of contacts may overlook, and more than a step's tolerance leaves open.
inline constexpr double flush_part = 1e-6;

}  // namespace pbd
