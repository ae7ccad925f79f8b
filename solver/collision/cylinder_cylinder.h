// Two cylinders: rims and points of caps on caps and sides, and sides that cross.
#pragma once

#include "collision/contact_writer.h"
#include "shapes.h"

namespace pbd {

void cylinder_cylinder(const Cylinder& first, const Cylinder& second, const ContactWriter& writer);

}  // namespace pbd
