#include "collision/contact_writer.h"

#include <algorithm>

namespace pbd {
namespace {

constexpr int kind_bits = 3, number_bits = 29;

FeatureName name_in(std::uint64_t kind, std::uint64_t number) {
  constexpr std::uint64_t one = 1;
  return {static_cast<Feature>(kind & ((one << kind_bits) - 1)),
          static_cast<int>(number & ((one << number_bits) - 1))};
}

ContactPoint contact_point(ContactPoint::Kind kind, const Vec3& point_a, double radius_a, const Vec3& point_b,
                           double radius_b) {
  ContactPoint contact;
  contact.kind = kind;
  contact.point_a = point_a;
  contact.point_b = point_b;
  contact.radius_a = radius_a;
  contact.radius_b = radius_b;
  return contact;
}

}  // namespace

std::uint64_t key_of(const FeatureName& first, const FeatureName& second) {
  std::uint64_t key =
      static_cast<std::uint64_t>(first.of) << kind_bits | static_cast<std::uint64_t>(second.of);
  key = key << number_bits | static_cast<std::uint64_t>(first.i);
  return key << number_bits | static_cast<std::uint64_t>(second.i);
}

FeatureName first_of(std::uint64_t key) {
  return name_in(key >> (2 * number_bits + kind_bits), key >> number_bits);
}

FeatureName second_of(std::uint64_t key) {
  return name_in(key >> 2 * number_bits, key);
}

std::uint64_t ContactWriter::key(Feature of_a, int i, Feature of_b, int j) const {
  return swapped ? key_of({of_b, j}, {of_a, i}) : key_of({of_a, i}, {of_b, j});
}

void ContactWriter::write(ContactPoint contact, std::uint64_t key, double gap) const {
  const auto from = out.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto same = [&](const ContactPoint& other) { return other.key == key; };
  if (!(gap < reach.margin) || std::any_of(from, out.end(), same)) return;
  contact.swapped = swapped;
  contact.key = key;
  contact.point_a = frame_a.rotation.transpose() * (contact.point_a - frame_a.origin);
  contact.point_b = frame_b.rotation.transpose() * (contact.point_b - frame_b.origin);
  contact.direction_a = frame_a.rotation.transpose() * contact.direction_a;
  contact.direction_b = frame_b.rotation.transpose() * contact.direction_b;
  contact.across_a = frame_a.rotation.transpose() * contact.across_a;
  out.push_back(contact);
}

void ContactWriter::rewrite(const ContactPoint& contact, std::uint64_t key, double gap) const {
  const auto from = out.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto same = [&](const ContactPoint& other) { return other.key == key; };
  out.erase(std::remove_if(from, out.end(), same), out.end());
  write(contact, key, gap);
}

double ContactWriter::gap_of(const ContactPoint& contact) const {
  const bool same = contact.swapped == swapped;
  return touching(contact, same ? frame_a : frame_b, same ? frame_b : frame_a).gap;
}

double ContactWriter::least() const {
  double gap = infinity;
  for (std::size_t i = begin; i < out.size(); ++i) gap = std::min(gap, gap_of(out[i]));
  return gap;
}

void ContactWriter::drop_deeper(double gap) const {
  const auto from = out.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto deeper = [&](const ContactPoint& contact) { return gap_of(contact) < gap; };
  out.erase(std::remove_if(from, out.end(), deeper), out.end());
}

ContactPoint on_point(const Vec3& point_a, double radius_a, const Vec3& point_b, double radius_b) {
  return contact_point(ContactPoint::Kind::point, point_a, radius_a, point_b, radius_b);
}

ContactPoint on_face(const Vec3& point_a, double radius_a, const Vec3& point_b, const Vec3& normal,
                     double radius_b) {
  ContactPoint contact = contact_point(ContactPoint::Kind::face, point_a, radius_a, point_b, radius_b);
  contact.direction_b = normal;
  return contact;
}

ContactPoint on_line(const Vec3& point_a, double radius_a, const Vec3& point_b, const Vec3& along,
                     double radius_b) {
  ContactPoint contact = contact_point(ContactPoint::Kind::line, point_a, radius_a, point_b, radius_b);
  contact.direction_b = along;
  return contact;
}

ContactPoint on_edges(const Vec3& point_a, const Vec3& along_a, double radius_a, const Vec3& point_b,
                      const Vec3& along_b, double radius_b, const Vec3& normal) {
  ContactPoint contact = contact_point(ContactPoint::Kind::edges, point_a, radius_a, point_b, radius_b);
  contact.direction_a = along_a;
  contact.direction_b = along_b;
  contact.side = along_a.cross(along_b).dot(normal) < 0 ? -1 : 1;
  return contact;
}

}  // namespace pbd
