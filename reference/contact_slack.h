// A claimed contact and what its residual leaves open (contact_check.h).
#pragma once

#include "touching_sides.h"

namespace pbd::reference {

struct ContactSlack {
  const ContactLaw& law;
  double normal;             // F_n, N
  Vec3 friction;             // F_t, N
  double impulse, velocity;  // e (N s) and s (m/s)
  Vec3 slip;                 // u_t, m/s, with `conveyed`; zero on deformable surfaces
  Vec3 conveyed;             // m/s, of it what surfaces do that move along themselves
};

/// `level` in sqrt(J).
ContactSlack slack_of(const StepClaim& claim, const ClaimedContact& contact, const Sides& sides,
                      double level);

}  // namespace pbd::reference
