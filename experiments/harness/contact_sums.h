// What the contacts of a step do together.
#pragma once

#include <optional>
#include <vector>

#include "scenes/contacts.h"
#include "step/step.h"

namespace pbdcheck {

/// Sums over contacts: their forces, and of these the parts across the normals, N.
struct ContactForceSum {
  pbd::Vec3 force = pbd::Vec3::Zero();
  pbd::Vec3 friction = pbd::Vec3::Zero();
};

/// On a body by all that touch it, or by the body `other` alone if that is not negative.
ContactForceSum contact_force(const pbd::Contact& contact, const std::vector<pbd::ContactForce>& found,
                              int body, int other);

/// How many contacts exert a force.
std::int64_t pressing(const std::vector<pbd::ContactForce>& found);

/// Of those found, m; nothing where none is near.
std::optional<double> least_gap(const std::vector<pbd::ContactForce>& found);

}  // namespace pbdcheck
