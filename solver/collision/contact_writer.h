// How generators write contact points down: in the frames of their shapes, each once, with a key that names
// the pair of features and is the same in every step.
#pragma once

#include "collision/contact_point.h"

namespace pbd {

/// What a feature is.
enum class Feature : std::uint8_t { node, edge, face, rim, axis, cap };

/// A feature of a shape by its number.
struct FeatureName {
  Feature of;
  int i;
};

/// What two features that touch are called, of the shape asked for first and of the second one: another
/// number for each pair of numbers i below 2^29.
std::uint64_t key_of(const FeatureName& first, const FeatureName& second);
FeatureName first_of(std::uint64_t key);
FeatureName second_of(std::uint64_t key);

/// How far shapes may come to meet: gaps below `margin` count, and what lies lowest when they have turned
/// against each other by `turn`.
struct Reach {
  double margin;    // m
  double turn = 0;  // rad
};

/// Two shapes in the roles a and b of a contact; `swapped` if a is the one asked for second.
struct ContactWriter {
  const Frame& frame_a;
  const Frame& frame_b;
  bool swapped;
  Reach reach;
  std::vector<ContactPoint>& out;
  std::size_t begin;  // of this pair's contacts in `out`

  ContactWriter exchanged() const { return {frame_b, frame_a, !swapped, reach, out, begin}; }

  /// The same number for the same pair of features, whichever shape is a.
  std::uint64_t key(Feature of_a, int i, Feature of_b, int j) const;

  /// Features in the frame that the writer's frames are placed in. Nothing is written twice, nor what is not
  /// within reach.
  void write(ContactPoint contact, std::uint64_t key, double gap) const;

  /// In the place of what has the key already.
  void rewrite(const ContactPoint& contact, std::uint64_t key, double gap) const;

  /// The least gap (m) of what is written; infinite if nothing is.
  double least() const;

  /// Drops what is written with a smaller gap (m): along another direction the shapes overlap less.
  void drop_deeper(double gap) const;

 private:
  double gap_of(const ContactPoint& contact) const;
};

/// Contact points by kind (contact_point.h), with the features' radii (m).
ContactPoint on_point(const Vec3& point_a, double radius_a, const Vec3& point_b, double radius_b);
ContactPoint on_face(const Vec3& point_a, double radius_a, const Vec3& point_b, const Vec3& normal,
                     double radius_b);
ContactPoint on_line(const Vec3& point_a, double radius_a, const Vec3& point_b, const Vec3& along,
                     double radius_b);
/// `normal` tells the side: from b to a.
ContactPoint on_edges(const Vec3& point_a, const Vec3& along_a, double radius_a, const Vec3& point_b,
                      const Vec3& along_b, double radius_b, const Vec3& normal);

}  // namespace pbd
