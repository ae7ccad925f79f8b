// Spheres, capsules, boxes and hulls against cylinders: nodes and edges on caps and sides, rims on faces.
#pragma once

#include "collision/contact_writer.h"
#include "collision/rounded_polyhedron.h"

namespace pbd {

void convex_cylinder(const RoundedPolyhedron& a, const Cylinder& cylinder, const ContactWriter& writer);

}  // namespace pbd
