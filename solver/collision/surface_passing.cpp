// What deformable surfaces pass, or come nearer to than they may, on straight ways.
#include <algorithm>
#include <cmath>

#include "collision/surface_search.h"

namespace pbd {
namespace {

using Kind = SurfaceContact::Kind;

/// The volume that four nodes span on straight ways: a cubic in the share t of the way, positive where a
/// contact's side is 1 (provot1997collision).
class Volume {
 public:
  Volume(Kind kind, const NodePlaces& from, const NodePlaces& to) {
    const bool triangle = kind == Kind::node_triangle;
    const auto along = [&](std::size_t i, std::size_t j) {
      const Vec3 begin = from[j] - from[i], end = to[j] - to[i];
      return std::array<Vec3, 2>{begin, end - begin};
    };
    const auto [p, dp] = along(triangle ? 1 : 2, 0);
    const auto [q, dq] = triangle ? along(1, 2) : along(0, 1);
    const auto [r, dr] = triangle ? along(1, 3) : along(2, 3);
    const Vec3 none = q.cross(r), once = q.cross(dr) + dq.cross(r), twice = dq.cross(dr);
    coefficient_ = {p.dot(none), p.dot(once) + dp.dot(none), p.dot(twice) + dp.dot(once), dp.dot(twice)};
  }

  double at(double t) const {
    const auto& [a, b, c, d] = coefficient_;
    return a + t * (b + t * (c + t * d));
  }

  /// visit(t, sign before t) for each share of the way at which the sign changes.
  template <class Visit>
  void each_change(Visit&& visit) const {
    const auto& [a, b, c, d] = coefficient_;
    const std::array<double, 4> bound{a, a + b / 3, a + (2 * b + c) / 3, a + b + c + d};  // of Bernstein's
    const auto [least, most] = std::minmax_element(bound.begin(), bound.end());
    if (*least > 0 || *most < 0) return;
    std::array<double, 4> end{0, 1, 1, 1};  // of parts on which it rises or falls
    std::size_t parts = 1;
    if (const double root = c * c - 3 * b * d; root > 0) {
      const double sum = -(c + std::copysign(std::sqrt(root), c));
      std::array<double, 2> turning{sum / (3 * d), b / sum};
      std::sort(turning.begin(), turning.end());
      for (const double t : turning)
        if (t > 0 && t < 1) end[parts++] = t;
      end[parts] = 1;
    }
    for (std::size_t k = 0; k < parts; ++k) {
      const bool negative = at(end[k]) < 0;
      if (negative != (at(end[k + 1]) < 0)) visit(change(end[k], end[k + 1]), negative ? -1 : 1);
    }
  }

 private:
  double change(double before, double after) const {
    constexpr int halvings = 52;  // of a way: to rounding
    const bool negative = at(before) < 0;
    for (int k = 0; k < halvings; ++k) {
      const double middle = (before + after) / 2;
      ((at(middle) < 0) == negative ? before : after) = middle;
    }
    return after;
  }

  std::array<double, 4> coefficient_{};
};

/// At a share of straight ways.
NodePlaces on_way(const NodePlaces& from, const NodePlaces& to, double share) {
  NodePlaces x;
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = from[k] + share * (to[k] - from[k]);
  return x;
}

/// m, negative where features began in each other's thickness.
double begun(const SurfaceContact& contact, const NodePlaces& from) {
  return std::min(0.0, nearest_touching(contact, from).gap);
}

/// Sets how features met that are nearer than `begun` (m) at share `near` of their ways: where they last came
/// to be so.
void meet_on_way(SurfaceContact& contact, const NodePlaces& from, const NodePlaces& to, double near,
                 double begun) {
  constexpr double nearest = 1.0 / 64;  // what grazes in less of the way is not looked for
  constexpr int halvings = 30;          // to a billionth of the way
  const auto is_apart = [&](double share) {
    return !(nearest_touching(contact, on_way(from, to, share)).gap < begun);
  };
  double apart = 0, within = near;
  for (double back = nearest; back < 1; back *= 2) {
    const double share = near * (1 - back);
    if (is_apart(share)) {
      apart = share;
      break;
    }
    within = share;
  }
  for (int k = 0; k < halvings; ++k) {
    const double middle = (apart + within) / 2;
    (is_apart(middle) ? apart : within) = middle;
  }
  const SurfaceTouching met = nearest_touching(contact, on_way(from, to, apart));
  if (met.normal.isZero(0)) return;
  contact.toward = met.normal;
  contact.met = {met.weight[0], met.weight[1], met.weight[2], met.weight[3]};
}

/// True if a contact's features have a normal at x, and their nearest points lie on them.
bool meets(const SurfaceContact& contact, const NodePlaces& x) {
  const bool triangle = contact.kind == Kind::node_triangle;
  const Vec3 e = triangle ? x[2] - x[1] : x[1] - x[0];
  const Vec3 f = triangle ? x[3] - x[1] : x[3] - x[2];
  return crossed(e, f) && on_features(touching(contact, x), contact.kind, between_features);
}

/// A contact with its side and target, if its features pass each other on these ways, or overlap where the
/// ways end, by more than where they begin and `slack`.
std::optional<PassedContact> passed(SurfaceContact contact, const NodePlaces& from, const NodePlaces& to,
                                    double slack) {
  const Volume volume(contact.kind, from, to);
  int crossings = 0;
  double near = 1;
  volume.each_change([&](double t, int before) {
    if (!meets(contact, on_way(from, to, t))) return;
    crossings += before;
    near = std::min(near, t);
  });
  if (crossings == 0) near = 1;
  const double ends = crossings != 0 ? crossings : volume.at(1);
  contact.side = ends < 0 ? -1 : 1;
  const SurfaceTouching end = touching(contact, to);
  if (crossings == 0 && !(end.gap < -slack && meets(contact, to))) return std::nullopt;
  const double target = begun(contact, from);
  if (!(end.gap < target - slack)) return std::nullopt;
  if (target - touching(contact, from).gap > parted * contact.thickness)
    meet_on_way(contact, from, to, near, target);
  return PassedContact{contact, target};
}

}  // namespace

void SurfaceSearch::find_passed(int threads, const Points& from, const Points& to, double slack,
                                std::vector<PassedContact>& out) {
  if (clear_gap_ > 2 * std::max(moved_since_clear(from), moved_since_clear(to))) return;
  const Vec3 shared = course(from, to);
  const auto around = [&](const auto& nodes, double margin) {
    AxisBox box;
    for (const int node : nodes) box.extend(Vec3(from.col(node))).extend(Vec3(to.col(node) - shared));
    const Vec3 around_box = Vec3::Constant(margin);
    return AxisBox(box.min() - around_box, box.max() + around_box);
  };
  search(
      threads, around,
      [&](const SurfaceContact& contact) {
        return passed(contact, places(contact, from), places(contact, to), slack);
      },
      [&](const Point& point, int edge) { return beside(point, edge, to, 0); });
  out.insert(out.end(), met_.begin(), met_.end());
  for (const Beside& each : beside_) {
    const SurfaceContact& contact = each.contact;
    const double target = begun(contact, places(contact, from));
    if (touching(contact, to).gap < target - slack) out.push_back({contact, target});
  }
}

}  // namespace pbd
