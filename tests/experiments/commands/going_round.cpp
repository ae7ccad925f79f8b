// What falls on a cylinder's rim, and a ball that goes over an edge: solved steps end where the judge's do.
#include <fmt/format.h>
#include <algorithm>
#include <catch2/catch.hpp>

#include "results.h"

using namespace pbdcheck::test;

namespace {

/// Falls on the rim of a fixed cylinder of 0.1 m from beside it, turning.
constexpr const char* on_rim = R"(
[[rigid_body]]
name="post"
shape="cylinder"
radius_m=0.1
length_m=0.3
held="fixed"
[[rigid_body]]
name="falls"
{}
mass_kg=1
{}
[gravity]
[contact]
friction={}
[step]
step_s=0.01
duration_s=0.15
[method]
integrator="implicit_euler"
tolerance=1e-9
)";

constexpr const char* from_aside = R"(
position_m=[0.195,{},0.24]
rotation_rad=[0.7,-1.1,0.4]
velocity_m_s=[-1.6,-0.3,-1.4]
angular_velocity_rad_s=[3,-2,5]
)";

/// A cylinder of 0.04 x 0.07 m whose rim comes to dip below the cap that it touched.
constexpr const char* dipping = R"(
position_m=[-0.19659,0.01956,0.24756]
rotation_rad=[0.3446,-0.7804,-2.9840]
velocity_m_s=[1.5767,-0.3821,-1.3867]
angular_velocity_rad_s=[-7.4466,1.4600,-0.8351]
)";

/// A ball of 0.05 m touches a fixed base's edge, goes over its face at 0.1 m/s and stays there.
constexpr const char* over_edge = R"(
[[rigid_body]]
name="base"
{}
held="fixed"
[[rigid_body]]
name="ball"
shape="sphere"
radius_m=0.05
mass_kg=1
position_m=[0.20499167083234143,0,0.14975020826390129]
velocity_m_s=[-0.09950041652780259,0,0.009983341664682815]
[gravity]
[contact]
friction=0
[step]
step_s=0.01
duration_s=0.1
[method]
tolerance=1e-9
)";

/// Checks the steps before the first one that misses: what that leaves overlapping the judge parts otherwise.
/// Returns how many of them do not move freely, for the judge.
int check_judged(const TemporaryFolder& folder) {
  run_program({"simulate", folder.path / "scene.toml", "--judge", "every=1", "-o", folder.path / "out"});
  const auto judged = rows_of(folder.path / "out" / "judged.csv");
  REQUIRE(judged.size() > 10);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(judged[0].begin(), judged[0].end(), name) - judged[0].begin());
  };
  const std::size_t solved = column("solver_status"), outcome = column("status"),
                    error = column("nearest_error_of_scale"), rounds = column("reference_iterations");
  int touching = 0;
  for (std::size_t i = 1; i < judged.size() && judged[i][solved] == "ok"; ++i) {
    if (judged[i][outcome] != "ok") continue;
    INFO("step " << i);
    CHECK(std::stod(judged[i][error]) <= 1e-6);
    touching += std::stoi(judged[i][rounds]) > 2;
  }
  return touching;
}

}  // namespace

TEST_CASE("what falls on a cylinder's rim ends each step where the judge does") {
  const std::string shape = GENERATE(
      as<std::string>(), "shape=\"sphere\"\nradius_m=0.03", "shape=\"capsule\"\nradius_m=0.03\nlength_m=0.1",
      "shape=\"box\"\nsize_m=[0.08,0.06,0.05]", "shape=\"cylinder\"\nradius_m=0.04\nlength_m=0.07");
  const TemporaryFolder folder;
  int touching = 0;
  for (const double aside : {-0.05, 0.0, 0.03})
    for (const double friction : {0.0, 0.3}) {
      INFO(shape << " aside " << aside << " friction " << friction);
      folder.write("scene.toml", fmt::format(on_rim, shape, fmt::format(from_aside, aside), friction));
      touching += check_judged(folder);
    }
  CHECK(touching > 5);
}

TEST_CASE("a rim that dips below the cap that it touched is not borne by the cap") {
  const TemporaryFolder folder;
  folder.write("scene.toml",
               fmt::format(on_rim, "shape=\"cylinder\"\nradius_m=0.04\nlength_m=0.07", dipping, 0.3));
  CHECK(check_judged(folder) > 2);
}

TEST_CASE("a ball that goes from an edge over a face is borne by the face") {
  const std::string shape = GENERATE(as<std::string>(), "shape=\"box\"\nsize_m=[0.4,0.4,0.2]",
                                     "shape=\"cylinder\"\nradius_m=0.2\nlength_m=0.2");
  INFO(shape);
  const TemporaryFolder folder;
  folder.write("scene.toml", fmt::format(over_edge, shape));
  CHECK(check_judged(folder) > 2);
}
