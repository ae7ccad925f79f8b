#include "contact_slack.h"

#include <cmath>

namespace pbd::reference {

ContactSlack slack_of(const StepClaim& claim, const ClaimedContact& contact, const Sides& sides,
                      double level) {
  const auto& [a, b] = contact.collider;
  const ContactLaw& law = sides.law(a, b);
  const double normal = contact.force.dot(contact.normal);
  const double centres = sides.least_inverse_mass(a) + sides.least_inverse_mass(b);
  const auto inverse = [&](std::size_t side) {
    const int k = contact.collider[side];
    return sides.inverse_mass(k, explicit_forces(claim) ? sides.longest_lever(k, contact.collider[1 - side])
                                                        : sides.lever(contact, side));
  };
  const double all = inverse(0) + inverse(1) + 2 * law.compliance / (claim.h * claim.h);
  Vec3 slip = Vec3::Zero();
  if (a < sides.count() && b < sides.count())
    slip = sides.velocity(contact, 0, claim.end) - sides.velocity(contact, 1, claim.end);
  const auto across = [&](const Vec3& v) -> Vec3 { return v - contact.normal.dot(v) * contact.normal; };
  const Vec3 conveyed = across(sides.surface_velocity(contact, 0) - sides.surface_velocity(contact, 1));
  slip = across(slip) + conveyed;
  // The squares of a triangle's three weights sum to a third at least.
  constexpr double share = 1.0 / 3;
  return {law,
          normal,
          contact.force - normal * contact.normal,
          level / std::sqrt(share * centres),
          level * std::sqrt(all),
          slip,
          conveyed};
}

}  // namespace pbd::reference
