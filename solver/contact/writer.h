// How generators write contact points down, in the frames of their shapes and with keys.
#pragma once

#include <algorithm>
#include <cmath>

#include "contact/core.h"

namespace pbd {

/// What a feature is: the upper bits of a key.
enum class Feature : std::uint32_t { node, edge, face, rim, axis, cap };

/// The same number for the same pair of features, of the shape asked for first and of the second one.
inline std::uint32_t contact_key(Feature first, int i, Feature second, int j) {
  std::uint64_t bits = (static_cast<std::uint64_t>(first) << 3 | static_cast<std::uint64_t>(second)) << 58;
  bits |= static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 29 ^ static_cast<std::uint32_t>(j);
  bits *= 0x9e3779b97f4a7c15ULL;  // Fibonacci hashing
  return static_cast<std::uint32_t>(bits >> 32);
}

/// Two shapes in the roles a and b of a contact; `swapped` if a is the one asked for second.
struct Roles {
  const Frame& a;
  const Frame& b;
  bool swapped;
  double margin;  // m
  std::vector<ContactPoint>& out;
  std::size_t begin;  // of this pair's contacts in `out`

  Roles exchanged() const { return {b, a, !swapped, margin, out, begin}; }

  std::uint32_t key(Feature of_a, int i, Feature of_b, int j) const {
    return swapped ? contact_key(of_b, j, of_a, i) : contact_key(of_a, i, of_b, j);
  }
  bool written(std::uint32_t key) const {
    for (std::size_t i = begin; i < out.size(); ++i)
      if (out[i].key == key) return true;
    return false;
  }

  /// Features in the world's frame. Nothing is written twice, nor what is not below the margin.
  void write(ContactPoint contact, std::uint32_t key_, double gap) const {
    if (!(gap < margin) || written(key_)) return;
    contact.swapped = swapped;
    contact.key = key_;
    contact.point_a = a.rotation.transpose() * (contact.point_a - a.origin);
    contact.point_b = b.rotation.transpose() * (contact.point_b - b.origin);
    contact.direction_a = a.rotation.transpose() * contact.direction_a;
    contact.direction_b = b.rotation.transpose() * contact.direction_b;
    out.push_back(contact);
  }

  /// In the place of what has the key already.
  void rewrite(const ContactPoint& contact, std::uint32_t key_, double gap) const {
    const auto from = out.begin() + static_cast<std::ptrdiff_t>(begin);
    out.erase(std::remove_if(from, out.end(), [&](const auto& other) { return other.key == key_; }),
              out.end());
    write(contact, key_, gap);
  }

  /// Of what is written (m).
  double least() const {
    double gap = infinity;
    for (std::size_t i = begin; i < out.size(); ++i) {
      const bool same = out[i].swapped == swapped;
      gap = std::min(gap, touching(out[i], same ? a : b, same ? b : a).gap);
    }
    return gap;
  }
};

inline ContactPoint features(ContactPoint::Kind kind, const Vec3& point_a, double radius_a,
                             const Vec3& point_b, double radius_b) {
  ContactPoint contact;
  contact.kind = kind;
  contact.point_a = point_a;
  contact.point_b = point_b;
  contact.radius_a = radius_a;
  contact.radius_b = radius_b;
  return contact;
}

inline ContactPoint on_face(const Vec3& point_a, double radius_a, const Vec3& point_b, const Vec3& normal,
                            double radius_b) {
  ContactPoint contact = features(ContactPoint::Kind::face, point_a, radius_a, point_b, radius_b);
  contact.direction_b = normal;
  return contact;
}

inline ContactPoint on_line(const Vec3& point_a, double radius_a, const Vec3& point_b, const Vec3& along,
                            double radius_b) {
  ContactPoint contact = features(ContactPoint::Kind::line, point_a, radius_a, point_b, radius_b);
  contact.direction_b = along;
  return contact;
}

/// `normal` tells the side: from b to a.
inline ContactPoint on_edges(const Vec3& point_a, const Vec3& along_a, double radius_a, const Vec3& point_b,
                             const Vec3& along_b, double radius_b, const Vec3& normal) {
  ContactPoint contact = features(ContactPoint::Kind::edges, point_a, radius_a, point_b, radius_b);
  contact.direction_a = along_a;
  contact.direction_b = along_b;
  contact.side = along_a.cross(along_b).dot(normal) < 0 ? -1 : 1;
  return contact;
}

}  // namespace pbd
