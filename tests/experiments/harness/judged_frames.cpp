// Sampled steps: which of them are judged, and what is told of the others.
#include "harness/judged_frames.h"

#include <catch2/catch.hpp>

#include "results.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

TEST_CASE("sampled steps that miss their tolerance are counted, and are not compared with the judge's") {
  const TemporaryFolder folder;
  Context context(folder.path, Tier::quick, 1);
  context.begin(2);
  JudgedFrames frames(context, "frames");
  SampledSteps solved, spent;
  frames.run({"incline", 0.2, 10}, 1e-8, solved);
  frames.run({"incline", 0.2, 10, {"method.max_outer=1", "method.max_sweeps=1", "method.warm_start=false"}},
             1e-12, spent);
  frames.close();
  CHECK(solved.sampled == 2);
  CHECK(solved.compared() == 2);
  CHECK(solved.nearest.value() <= 1e-6);  // as `judged_frames` asks at this tolerance
  CHECK(spent.sampled == 2);
  CHECK(spent.missed == 2);
  CHECK(spent.quantity() ==
        "distance over the step's scale, of 0 of 2 sampled steps; 2 missed their tolerance");
  CHECK(std::isnan(spent.nearest.value()));  // no verdict holds on nothing
  CHECK(rows_of(folder.path / "frames.csv").size() == 5);
}
