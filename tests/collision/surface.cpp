// Contact of deformable surfaces against distances by brute force.
#include "collision/surface_search.h"

#include <catch2/catch.hpp>

#include "contact_shapes.h"
#include "surface_features.h"

using namespace pbd;
using namespace pbd::test;

namespace {

using Kind = SurfaceContact::Kind;

Points random_points(Random& random) {
  Points x(3, 4);
  for (int k = 0; k < 4; ++k) x.col(k) = random.vector();
  return x;
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
  const std::vector<std::array<int, 3>> triangles{{0, 1, 4}, {2, 3, 5}};
  SurfaceSearch search(triangles, 1e-3);
  SurfaceReach reach(triangles, search.nodes());
  reach.set_out(x, x, x.array() + 1e-2, 0);
  std::vector<SurfaceContact> found;
  search.find(1, x, reach, found);
  CHECK(std::none_of(found.begin(), found.end(), [](const SurfaceContact& contact) {
    return contact.kind == SurfaceContact::Kind::edge_edge && contact.node == std::array{0, 1, 2, 3};
  }));
}

TEST_CASE("surfaces come no nearer than their reach tells") {
  Random random(67);
  const auto way = [&](const Points& x, double course, double beside) {
    Points to = x;
    for (const int first : {0, 3}) {
      const Vec3 together = course * random.vector();
      for (int k = first; k < first + 3; ++k) to.col(k) += together + beside * random.vector();
    }
    return to;
  };
  SurfaceReach reach({{0, 1, 2}, {3, 4, 5}}, {0, 1, 2, 3, 4, 5});
  double worst = -1;
  int grown = 0, apart = 0;
  for (int number = 0; number < 10000; ++number) {
    Points x(3, 6);
    for (int k = 0; k < 6; ++k) x.col(k) = random.vector();
    const Points straight = way(x, 1, 0), free = way(straight, 0, 0.1);
    reach.set_out(x, straight, free, 0);
    const Points end = number % 2 == 0 ? free : way(free, 0, 0.1);
    grown += reach.extend(x, end, 0.25);
    const auto of = [](const Points& at, const std::array<int, 4>& nodes) {
      return to_triangle(at.col(nodes[0]), at.col(nodes[1]), at.col(nodes[2]), at.col(nodes[3]));
    };
    const std::array nodes{0, 3, 4, 5};
    worst = larger(worst, of(x, nodes) - of(end, nodes) - reach.of(nodes));
    const double margin = of(end, nodes) / 2;
    apart += !reach.box(std::array{0}, x, margin).intersects(reach.box(std::array{3, 4, 5}, x, margin));
  }
  CHECK(worst < accuracy);
  // On every second way each node goes on at random, farther with a probability above 1/2: one of six above
  // 1 - 2^-6. On the others none does.
  CHECK(grown > 4800);
  CHECK(grown <= 5000);
  CHECK(apart == 0);

  Points x = Points::Zero(3, 6), straight = x, free = x;  // straight at each other: as near as that
  for (int k = 0; k < 6; ++k) {
    const double towards = k < 3 ? 1 : -1;
    straight(2, k) = 3 * towards;
    free(2, k) = 5 * towards;
  }
  const Vec3 together(1000, -2000, 3000);
  for (const Vec3& boost : {Vec3(0, 0, 0), together}) {
    reach.set_out(x, straight.colwise() + boost, free.colwise() + boost, 0);
    const double rounding = 1e-8 * (5 + boost.norm());  // a few times what is added for it
    CHECK(std::abs(reach.of({0, 3, 4, 5}) - 2 * 5) < rounding);
    CHECK(std::abs(reach.of({0, 0, 1, 2}) - 2 * (5 - 3)) < rounding);  // of one piece
    constexpr double room = 0.25;                                      // of 3 m
    reach.set_out(x, straight.colwise() + boost, free.colwise() + boost, room);
    CHECK(std::abs(reach.of({0, 0, 1, 2}) - 2 * (5 - 3 + room * 3)) < rounding);
  }
}

TEST_CASE("threads find what one finds, in its order") {
  constexpr int side = 24;
  constexpr double thickness = 0.3;  // of an edge's length: many touch
  std::vector<std::array<int, 3>> triangles;
  const auto node = [](int i, int j) { return i * side + j; };
  for (int i = 0; i + 1 < side; ++i)
    for (int j = 0; j + 1 < side; ++j) {
      triangles.push_back({node(i, j), node(i + 1, j), node(i, j + 1)});
      triangles.push_back({node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  Random random(68);
  Points x(3, side * side), to = x;
  for (int k = 0; k < side * side; ++k) {
    x.col(k) = Vec3(k % side, (k / side) % 8, 0) + random.vector();  // folded
    to.col(k) = x.col(k) + random.vector();
  }
  SurfaceSearch search(triangles, thickness);
  SurfaceReach reach(triangles, search.nodes());
  reach.set_out(x, x, x.array() + 0.1, 0);
  const auto found = [&](int threads) {
    std::pair<std::vector<SurfaceContact>, std::vector<PassedContact>> both;
    search.find(threads, x, reach, both.first);
    search.find_passed(threads, x, to, 1e-9, both.second);
    return both;
  };
  const auto same = [](const SurfaceContact& a, const SurfaceContact& b) {
    return a.same_features(b) && a.side == b.side && a.toward == b.toward;
  };
  const auto [near, passed] = found(1);
  std::array<int, 3> of_kind{};
  std::vector<std::array<int, 2>> ends;  // of nodes that touch each other
  for (const SurfaceContact& contact : near) {
    ++of_kind[static_cast<std::size_t>(contact.kind)];
    if (contact.kind != Kind::node_edge) continue;
    const auto weight = touching(contact, x).weight;
    for (const int k : {2, 3})
      if (weight[k] < -0.999) {
        const int node = contact.node[0], end = contact.node[static_cast<std::size_t>(k)];
        ends.push_back({std::min(node, end), std::max(node, end)});
      }
  }
  CHECK(*std::min_element(of_kind.begin(), of_kind.end()) > 100);
  CHECK(passed.size() > 100);
  CHECK(ends.size() > 10);
  std::sort(ends.begin(), ends.end());
  CHECK(std::adjacent_find(ends.begin(), ends.end()) == ends.end());
  for (const int threads : {2, 5}) {
    const auto [near_too, passed_too] = found(threads);
    CHECK(std::equal(near.begin(), near.end(), near_too.begin(), near_too.end(), same));
    CHECK(std::equal(passed.begin(), passed.end(), passed_too.begin(), passed_too.end(),
                     [&](const PassedContact& a, const PassedContact& b) {
                       return same(a.contact, b.contact) && a.target == b.target;
                     }));
  }
}
