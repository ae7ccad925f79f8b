// What deformable surfaces pass on straight ways, and what they are known not to, against brute force.
#include <catch2/catch.hpp>

#include "collision/surface_search.h"
#include "contact_shapes.h"
#include "mesh.h"
#include "surface_features.h"

using namespace pbd;
using namespace pbd::test;

namespace {

using Kind = SurfaceContact::Kind;

/// A triangle and a node, or two edges, of nodes 0 to 3; the others are elsewhere.
std::vector<std::array<int, 3>> triangles_of(Kind kind) {
  if (kind == Kind::node_triangle) return {{0, 4, 5}, {1, 2, 3}};
  return {{0, 1, 4}, {2, 3, 5}};
}

std::pair<Points, Points> random_ways(Random& random) {
  Points from(3, 6), to(3, 6);
  for (int k = 0; k < 4; ++k) {
    from.col(k) = random.vector();
    to.col(k) = random.vector();
  }
  for (const int k : {4, 5}) from.col(k) = to.col(k) = Vec3(100 * k, 0, 0);
  return {from, to};
}

}  // namespace

TEST_CASE("what surfaces pass on straight ways is told by the side from which it came") {
  const Kind kind = GENERATE(Kind::node_triangle, Kind::edge_edge);
  const auto triangles = triangles_of(kind);
  Random random(41);
  int passed = 0, wrong = 0;
  for (int number = 0; number < 3000; ++number) {
    const auto [from, to] = random_ways(random);
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
  const auto triangles = triangles_of(kind);
  constexpr double thickness = 0.3, lifted = 0.1 * thickness, rounding = 1e-8;
  Random random(43);
  int met = 0, lets = 0, wrong = 0;
  for (int number = 0; number < 3000; ++number) {
    const auto [from, to] = random_ways(random);
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
      Points there(3, 4);
      Vec3 apart = Vec3::Zero();
      for (int n = 0; n < 4; ++n) {
        const int node = contact.node[static_cast<std::size_t>(n)];
        there.col(n) = from.col(node) + share * (to.col(node) - from.col(node));
        apart += (*contact.met)[static_cast<std::size_t>(n)] * there.col(n);
      }
      const double least = distance(there, kind);
      if (!(share >= -rounding && share <= 1) || std::abs(least - thickness - target) > rounding ||
          (apart - least * contact.toward).norm() > 1e-5 * thickness)
        ++wrong;
    }
  }
  INFO("met " << met << ", asked where they end " << lets);
  CHECK(met > 100);
  CHECK(lets > 100);
  CHECK(wrong == 0);
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
