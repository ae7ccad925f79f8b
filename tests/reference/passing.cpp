// Features that pass each other through or beside themselves.
#include "passing.h"

#include <catch2/catch.hpp>

using namespace pbd;
using namespace pbd::reference;

namespace {

/// Of a corner and a face, or of two edges, whose nodes follow each other from 0.
FeaturePair pair_of(int of_a) {
  FeaturePair pair;
  pair.a.count = of_a;
  pair.b.count = 4 - of_a;
  int node = 0;
  for (ContactFeature* own : {&pair.a, &pair.b})
    for (int k = 0; k < own->count; ++k)
      own->corner[static_cast<std::size_t>(k)] = {-1, node++, Vec3::Zero()};
  return pair;
}

bool passes(int of_a, const Points& start, const Points& end) {
  Placement from, to;
  from.x = start;
  to.x = end;
  const bool found = passes_beside(pair_of(of_a), from, to);
  CHECK(passes_beside(pair_of(of_a), to, from) == found);
  return found;
}

/// Of the four points, the first by `way`.
Points moved(Points x, const Vec3& way) {
  x.col(0) += way;
  return x;
}

}  // namespace

TEST_CASE("a corner passes the plane of a face beside the face, or through it") {
  Points x(3, 4);
  x << Vec3(0.2, 0.3, 0.1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0);
  const Vec3 down(0, 0, -0.3);
  CHECK_FALSE(passes(1, x, moved(x, down / 4)));        // it stays above
  CHECK_FALSE(passes(1, x, moved(x, down)));            // through it
  CHECK(passes(1, x, moved(x, {2, 0, -0.3})));          // where x + y > 1, by a third of its way
  CHECK_FALSE(passes(1, x, moved(x, {0.3, 0, -0.3})));  // at (0.3, 0.3)
  x.col(0).x() = -0.2;
  CHECK(passes(1, x, moved(x, down)));
}

TEST_CASE("two lines pass each other beside their edges, or where both are") {
  Points x(3, 4);
  x << Vec3(0.3, -1, 0.1), Vec3(0.3, 1, 0.1), Vec3(0, 0, 0), Vec3(1, 0, 0);
  const auto sunk = [](Points at) {
    at.leftCols<2>().row(2).array() -= 0.2;
    return at;
  };
  CHECK_FALSE(passes(2, x, x));
  CHECK_FALSE(passes(2, x, sunk(x)));
  Points beside = x;
  beside.leftCols<2>().row(0).array() += 1;
  CHECK(passes(2, beside, sunk(beside)));
  beside = x;
  beside.leftCols<2>().row(1).array() += 1.5;
  CHECK(passes(2, beside, sunk(beside)));
}

// The line turns in its plane z = 0.1 past the other one's direction, and is above it before and behind.
TEST_CASE("the product of two lines changes its sign where one turns past the other, and neither side does") {
  Points x(3, 4), turned;
  x << Vec3(0, -0.1, 0.1), Vec3(1, 0.1, 0.1), Vec3(0, 0, 0), Vec3(1, 0, 0);
  turned = x;
  turned(1, 0) = 0.1, turned(1, 1) = -0.1;
  CHECK(passes(2, x, turned));
}

TEST_CASE("passing beside it and back is no passing") {
  Points x(3, 4), end;
  // The plane of the face turns about the y axis, past the point beside it and, by half a turn, again.
  x << Vec3(-0.5, 0.2, 0.1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0);
  end = x;
  end.col(2) = Vec3(-1, 0, 1);  // it is (1 - 2t, 0, t), in the point's plane where t/(1 - 2t) = -0.2
  CHECK_FALSE(passes(1, x, end));
}
