// Contact of deformable surfaces against distances by brute force.
#include "collision/surface_contact.h"

#include <catch2/catch.hpp>

#include "contact_shapes.h"

using namespace pbd;
using namespace pbd::test;

namespace {

using Kind = SurfaceContact::Kind;

Points random_points(Random& random) {
  Points x(3, 4);
  for (int k = 0; k < 4; ++k) x.col(k) = random.vector();
  return x;
}

/// That the contact's points lie within its features.
bool within(const SurfaceTouching& t, Kind kind) {
  const auto& w = t.weight;
  return kind != Kind::node_triangle ? w[0] >= 0 && w[1] >= 0 && w[2] <= 0 && w[3] <= 0
                                     : w[1] <= 0 && w[2] <= 0 && w[3] <= 0;
}

double distance(const Points& x, Kind kind) {
  const auto at = [&](int k) -> Vec3 { return x.col(k); };
  if (kind == Kind::node_edge) return between_segments({at(0), at(0)}, {at(2), at(3)});
  return kind == Kind::edge_edge ? between_segments({at(0), at(1)}, {at(2), at(3)})
                                 : to_triangle(at(0), at(1), at(2), at(3));
}

}  // namespace

TEST_CASE("nodes over triangles and beside edges, and edges that cross, are as far as their nearest points") {
  const Kind kind = GENERATE(Kind::node_triangle, Kind::edge_edge, Kind::node_edge);
  Random random(19);
  double worst = 0, worst_normal = 0, worst_sum = 0, worst_rate = 0;
  int seen = 0;
  for (int number = 0; number < 10000; ++number) {
    Points x = random_points(random);
    SurfaceContact contact{
        .node = {0, kind == Kind::node_edge ? 0 : 1, 2, 3}, .kind = kind, .thickness = 0.01};
    contact.side = number % 2 == 0 ? 1.0 : -1.0;
    const SurfaceTouching t = touching(contact, x);
    worst_normal = larger(worst_normal, std::abs(t.normal.norm() - 1));
    worst_sum = larger(worst_sum, std::abs(t.weight.sum()) / t.weight.lpNorm<1>());
    worst_normal = larger(worst_normal, std::abs((x * t.weight).dot(t.normal) - t.gap - contact.thickness) /
                                            t.weight.lpNorm<1>());
    if (!within(t, kind)) continue;
    ++seen;
    worst = larger(worst, std::abs(std::abs(t.gap + contact.thickness) - distance(x, kind)));
    const Points along = random_points(random);
    constexpr double h = 1e-6;
    const double after = touching(contact, x + h * along).gap, before = touching(contact, x - h * along).gap;
    const bool edges = kind != Kind::node_triangle;
    const Vec3 e = x.col(1) - x.col(0), f = x.col(edges ? 3 : 2) - x.col(edges ? 2 : 1);
    if (e.cross(f).norm() < 0.3 * e.norm() * f.norm()) continue;  // where the normal turns fast
    worst_rate = larger(worst_rate, std::abs((after - before) / (2 * h) - t.normal.dot(along * t.weight)));
  }
  INFO("kind " << static_cast<int>(kind) << " seen " << seen << " off by " << worst << " normal "
               << worst_normal << " sum " << worst_sum << " rate " << worst_rate);
  CHECK(seen > 500);
  CHECK(worst < accuracy);
  CHECK(worst_normal < 1e-12);
  CHECK(worst_sum < 1e-14);
  CHECK(worst_rate < 1e-7);
}

TEST_CASE("edges that are parallel have no normal, and are no contact but by their ends") {
  const Vec3 edge(1.0 / 1024, 1.0 / 32, 1.0 / 32), beside(0, 1.0 / 32, 0);  // their products are exact
  Points x(3, 6);
  x << Vec3::Zero(), edge, beside, beside + edge, Vec3(-1, 0, 0), Vec3(1, 0, 0);
  std::vector<SurfaceContact> found;
  SurfaceSearch({{0, 1, 4}, {2, 3, 5}}).find(x, std::vector<double>(6, 1e-2), 1e-3, found);
  CHECK(std::none_of(found.begin(), found.end(), [](const SurfaceContact& contact) {
    return contact.kind == SurfaceContact::Kind::edge_edge && contact.node == std::array{0, 1, 2, 3};
  }));
}
