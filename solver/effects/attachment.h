// c = x_node - x - s, s = R p; J = [-1, [s]x R/r, 1]. Damped ones have the same vector in the body's frame,
// R^T c, whose rate is none where the node turns with the body.
#pragma once

#include "effects/joint_parts.h"

namespace pbd {

template <>
struct Constraint<Attachment> : JointConstraint<Attachment, 3, 1, 1> {
  static void evaluate(const Attachment& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const Attachment& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

std::unique_ptr<Source> make_source(const Scene& scene, const Attachment& effect);

}  // namespace pbd
