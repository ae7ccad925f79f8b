// Random heaps: a step that says it is solved holds apart what it began with apart.
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "results.h"

using namespace pbdcheck::test;

namespace {

/// A capsule turns about a box's edge in the air, after a step that is not solved.
constexpr const char* heap = R"(
[[rigid_body]]
name="ground"
shape="half_space"
[[rigid_body]]
name="b0"
shape="sphere"
radius_m=0.125
mass_kg=1.033
position_m=[-0.087,0.033,0.4]
rotation_rad=[0.415,1.475,1.902]
[[rigid_body]]
name="b1"
shape="hull"
file="{}"
scale=0.171
mass_kg=8.660
position_m=[0.126,0.099,0.95]
rotation_rad=[-0.696,-1.794,0.799]
velocity_m_s=[0,0,-2.85]
[[rigid_body]]
name="b2"
shape="box"
size_m=[0.134,0.393,0.202]
mass_kg=0.102
position_m=[-0.125,0.105,1.5]
rotation_rad=[-1.675,-0.199,-1.636]
velocity_m_s=[0,0,-1.73]
[[rigid_body]]
name="b3"
shape="capsule"
radius_m=0.139
length_m=0.158
mass_kg=0.694
position_m=[-0.085,0.039,2.05]
rotation_rad=[-1.262,-0.684,-0.514]
velocity_m_s=[0,0,-2.26]
[gravity]
[contact]
friction=0.8
[step]
step_s=0.01
duration_s=0.4
[method]
integrator="implicit_euler"
tolerance=1e-8
)";

}  // namespace

TEST_CASE("no pair of a heap deepens in a step that is told to be solved") {
  const TemporaryFolder folder;
  folder.write("heap.toml", fmt::format(heap, (scenes / "meshes" / "wedge.obj").string()));
  const auto ran = run_program({"simulate", folder.path / "heap.toml", "--check", "-o", folder.path / "out"});
  CHECK_THAT(ran.out, Catch::Contains("none refuted"));
}
