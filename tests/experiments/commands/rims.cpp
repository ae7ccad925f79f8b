// What falls on a cylinder's rim and goes round it: solved steps end where the judge's do.
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
position_m=[0.195,{},0.24]
rotation_rad=[0.7,-1.1,0.4]
velocity_m_s=[-1.6,-0.3,-1.4]
angular_velocity_rad_s=[3,-2,5]
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

}  // namespace

TEST_CASE("what falls on a cylinder's rim ends each step where the judge does") {
  const std::string shape = GENERATE(
      as<std::string>(), "shape=\"sphere\"\nradius_m=0.03", "shape=\"capsule\"\nradius_m=0.03\nlength_m=0.1",
      "shape=\"box\"\nsize_m=[0.08,0.06,0.05]", "shape=\"cylinder\"\nradius_m=0.04\nlength_m=0.07");
  const TemporaryFolder folder;
  int touching = 0;
  for (const double aside : {-0.05, 0.0, 0.03})
    for (const double friction : {0.0, 0.3}) {
      folder.write("scene.toml", fmt::format(on_rim, shape, aside, friction));
      run_program({"simulate", folder.path / "scene.toml", "--judge", "every=1", "-o", folder.path / "out"});
      const auto judged = rows_of(folder.path / "out" / "judged.csv");
      REQUIRE(judged.size() > 15);
      const auto column = [&](const char* name) {
        return static_cast<std::size_t>(std::find(judged[0].begin(), judged[0].end(), name) -
                                        judged[0].begin());
      };
      const std::size_t solved = column("solver_status"), outcome = column("status"),
                        error = column("nearest_error_of_scale"), rounds = column("reference_iterations");
      for (std::size_t i = 1; i < judged.size(); ++i) {
        if (judged[i][solved] != "ok")
          break;  // what a missed step leaves overlapping the judge parts otherwise
        if (judged[i][outcome] != "ok") continue;
        INFO(shape << " aside " << aside << " friction " << friction << " step " << i);
        CHECK(std::stod(judged[i][error]) <= 1e-6);
        touching += std::stoi(judged[i][rounds]) > 2;  // else it moves freely
      }
    }
  CHECK(touching > 5);
}
