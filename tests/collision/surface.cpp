// Contact of deformable surfaces against distances by brute force.
#include "collision/surface_search.h"

#include <catch2/catch.hpp>

#include "contact_shapes.h"
#include "mesh.h"

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

TEST_CASE("what surfaces pass on straight ways is told by the side from which it came") {
  const Kind kind = GENERATE(Kind::node_triangle, Kind::edge_edge);
  const bool triangle = kind == Kind::node_triangle;
  const std::vector<std::array<int, 3>> triangles =
      triangle ? std::vector<std::array<int, 3>>{{0, 4, 5}, {1, 2, 3}}
               : std::vector<std::array<int, 3>>{{0, 1, 4}, {2, 3, 5}};
  Random random(41);
  int passed = 0, wrong = 0;
  for (int number = 0; number < 3000; ++number) {
    Points from(3, 6), to(3, 6);
    for (int k = 0; k < 4; ++k) {
      from.col(k) = random.vector();
      to.col(k) = random.vector();
    }
    for (const int k : {4, 5}) from.col(k) = to.col(k) = Vec3(100 * k, 0, 0);
    // By steps: how often the sign changes where the nearest points lie on both.
    SurfaceContact contact{.node = {0, 1, 2, 3}, .kind = kind};
    constexpr int steps = 4000;
    const auto side_at = [&](int k) { return touching(contact, from + double(k) / steps * (to - from)); };
    int net = 0;
    SurfaceTouching before = side_at(0);
    bool grazes = false;
    for (int k = 1; k <= steps; ++k) {
      const SurfaceTouching after = side_at(k);
      if ((before.gap < 0) != (after.gap < 0)) {
        const bool on_before = within(before, kind), on_after = within(after, kind);
        grazes = grazes || on_before != on_after || std::abs(after.gap - before.gap) > 0.1;
        if (on_before) net += before.gap < 0 ? -1 : 1;
      }
      before = after;
    }
    if (grazes) continue;
    std::vector<PassedContact> found;
    SurfaceSearch(triangles, 0).find_passed(1, from, to, 1e-9, found);
    const auto told = std::find_if(found.begin(), found.end(), [&](const PassedContact& each) {
      return each.contact.kind == kind && each.contact.node == contact.node;
    });
    const bool ends_there = net != 0 && (side_at(steps).gap < 0) != (net < 0);
    passed += ends_there;
    wrong += (told != found.end()) != ends_there || (ends_there && told->contact.side * net < 0);
  }
  CHECK(passed > 100);
  CHECK(wrong == 0);
}

// Of a contact that asks for more than its features were apart, the rest takes energy.
TEST_CASE("what surfaces pass asks for little more than it began with, or is stated where it met") {
  const Kind kind = GENERATE(Kind::node_triangle, Kind::edge_edge);
  const std::vector<std::array<int, 3>> triangles =
      kind == Kind::node_triangle ? std::vector<std::array<int, 3>>{{0, 4, 5}, {1, 2, 3}}
                                  : std::vector<std::array<int, 3>>{{0, 1, 4}, {2, 3, 5}};
  constexpr double thickness = 0.3, lifted = 0.1 * thickness, rounding = 1e-8;
  Random random(43);
  int met = 0, lets = 0, wrong = 0;
  for (int number = 0; number < 3000; ++number) {
    Points from(3, 6), to(3, 6);
    for (int k = 0; k < 4; ++k) {
      from.col(k) = random.vector();
      to.col(k) = random.vector();
    }
    for (const int k : {4, 5}) from.col(k) = to.col(k) = Vec3(100 * k, 0, 0);
    std::vector<PassedContact> found;
    SurfaceSearch(triangles, thickness).find_passed(1, from, to, 1e-9, found);
    for (const auto& [contact, target] : found) {
      if (contact.kind != kind) continue;
      const double before = touching(contact, from).gap;
      ++(contact.met ? met : lets);
      if (before < target - (contact.met ? rounding : lifted)) ++wrong;
      if (!contact.met) continue;
      // They touch by the points and along the normal of the contact where these are so far apart on the way.
      const double end = touching(contact, to).gap, share = (before - target) / (before - end);
      const Points there = from + share * (to - from);
      const SurfaceTouching nearest = nearest_touching(contact, places(contact, there));
      if (!(share >= -rounding && share <= 1) || std::abs(nearest.gap - target) > rounding ||
          (nearest.normal - contact.toward).norm() > 1e-5)
        ++wrong;
    }
  }
  INFO("met " << met << ", asked where they end " << lets);
  CHECK(met > 100);
  CHECK(lets > 100);
  CHECK(wrong == 0);
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

// What was found to be far apart is not searched again before it may have come near.
TEST_CASE("what was far apart is found where it comes near as by a first search") {
  constexpr int cells = 4, steps = 200;
  double down = GENERATE(0.003, 0.2);  // m a step
  constexpr double thickness = 0.01;
  TriangleMesh sheet = grid_sheet({cells, cells}, {0.4, 0.4});
  const auto nodes = static_cast<int>(sheet.x.cols());
  std::vector<std::array<int, 3>> triangles = sheet.triangles;
  for (const auto& [a, b, c] : sheet.triangles) triangles.push_back({a + nodes, b + nodes, c + nodes});
  Random random(71);
  Points x(3, 2 * nodes);
  x.leftCols(nodes) = sheet.x;
  x.rightCols(nodes) = sheet.x.colwise() + Vec3(0.03, 0.02, 0.3);
  SurfaceSearch knows(triangles, thickness);
  SurfaceReach reach(triangles, knows.nodes());
  int none = 0, some = 0, wrong = 0;
  for (int k = 0; k < steps; ++k) {
    Points to = x.colwise() + random.vector();
    to.rightCols(nodes).row(2).array() -= down;  // it comes, passes, leaves and comes back
    const double above = to(2, nodes) - to(2, 0);
    if (std::abs(above) > 0.3) down = std::copysign(down, above);
    for (int node = 0; node < 2 * nodes; ++node) to.col(node) += 3e-4 * random.vector();
    reach.set_out(x, to, to, 0);
    const auto found = [&](SurfaceSearch& search) {
      std::pair<std::vector<SurfaceContact>, std::vector<PassedContact>> both;
      search.find(1, x, reach, both.first);
      search.find_passed(1, x, to, 1e-6, both.second);
      return both;
    };
    SurfaceSearch first(triangles, thickness);
    const auto [near, passed] = found(knows);
    const auto [near_first, passed_first] = found(first);
    ++(near.empty() && passed.empty() ? none : some);
    const auto same = [](const SurfaceContact& a, const SurfaceContact& b) { return a.same_features(b); };
    const auto same_passed = [&](const PassedContact& a, const PassedContact& b) {
      return same(a.contact, b.contact) && a.target == b.target;
    };
    wrong += !std::equal(near.begin(), near.end(), near_first.begin(), near_first.end(), same) ||
             !std::equal(passed.begin(), passed.end(), passed_first.begin(), passed_first.end(), same_passed);
    x = to;
  }
  CHECK(none > steps / 4);
  CHECK(some > steps / 20);
  CHECK(wrong == 0);
}
