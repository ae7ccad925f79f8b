#include "collision/broad_phase.h"

#include <catch2/catch.hpp>

#include "contact_shapes.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("the broad phase finds the pairs that comparing all with all finds") {
  Random random(3);
  BroadPhase broad;
  for (const int count : {0, 1, 2, 30, 400})
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::vector<MovingBox> boxes;
      for (int i = 0; i < count; ++i) {
        const Vec3 centre = 4 * random.vector(), half = random.vector().cwiseAbs();
        AxisBox box(centre - half, centre + half);
        if (i % 10 == 0) box.max().z() = infinity;  // a half space's, and one of nothing
        if (i % 10 == 1) box.setEmpty();
        boxes.push_back({box, random.uniform(0, 1) < 0.7, i % 7 == 0 ? 0 : i});
      }
      std::vector<std::array<int, 2>> expected;
      for (int i = 0; i < count; ++i)
        for (int j = i + 1; j < count; ++j) {
          const auto &a = boxes[static_cast<std::size_t>(i)], &b = boxes[static_cast<std::size_t>(j)];
          if ((a.moves || b.moves) && a.group != b.group &&
              (a.box.min().array() <= b.box.max().array()).all() &&
              (b.box.min().array() <= a.box.max().array()).all())
            expected.push_back({i, j});
        }
      CHECK(broad.pairs(boxes) == expected);
      if (count == 400) CHECK(expected.size() > 100);
    }
}
