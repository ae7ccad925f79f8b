// Every node, end and rim of a shape a that is near a half space b.
#pragma once

#include "collision/contact_writer.h"
#include "collision/rounded_polyhedron.h"

namespace pbd {

void polyhedron_half_space(const RoundedPolyhedron& a, const ContactWriter& writer);
void cylinder_half_space(const Cylinder& a, const ContactWriter& writer);

}  // namespace pbd
