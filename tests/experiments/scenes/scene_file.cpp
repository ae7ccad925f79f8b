// Particles, cloths, solids and effects of scene files are read as written.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <numeric>

#include "mesh.h"
#include "read_scene.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

namespace {

template <class Effect>
const Effect& effect(const SceneFile& file, std::size_t index) {
  return std::get<Effect>(file.scene.effects.at(index));
}

}  // namespace

TEST_CASE("integers beyond 2^53 are numbers like any other") {
  const auto file = read(R"(
[[particle]]
position_m = [0, -9223372036854775807, 10000000000000001]
mass_kg = 9007199254740993
)");
  CHECK(file.scene.initial.x(1, 0) == -9223372036854775807.0);
  CHECK(file.scene.initial.x(2, 0) == 1e16);
  CHECK(file.scene.mass[0] == 9007199254740992.0);
}

TEST_CASE("particles, forces, anchors, links and hinges are read as written") {
  const auto file = read(R"(
[[particle]]
position_m = [0, 0, 0]
mass_kg = inf
[particles]
position_m = [[1, 0, 0], [0, 1, 0], [1, 1, 0.5]]
mass_kg = [1, 2, 3]
velocity_m_s = [[0, 0, 1], [0, 0, 2], [0, 0, 3]]
[[distance]]
nodes = [[0, 1], [2, 3]]
[[distance]]
nodes = [1, 2]
rest_length_m = 2
stiffness_n_per_m = 50
[[anchor]]
near_m = [0.9, 0.9, 1]
target_m = [1, 1, 1]
compliance_m_per_n = 0.5
[[bending]]
nodes = [1, 2, 0, 3]
compliance_rad_per_n_m = 4
[gravity]
acceleration_m_s2 = [0, 0, -2]
[[force]]
nodes = [1, 3]
force_n = [1, 2, 3]
)");
  CHECK(file.scene.mass == std::vector<double>{pbd::infinity, 1, 2, 3});
  CHECK(file.scene.initial.x.col(3) == pbd::Vec3(1, 1, 0.5));
  CHECK(file.scene.initial.v.col(2) == pbd::Vec3(0, 0, 2));
  REQUIRE(file.scene.effects.size() == 5);
  const auto& distance = effect<pbd::Distance>(file, 0);
  CHECK(distance.node == std::vector<std::array<int, 2>>{{0, 1}, {2, 3}, {1, 2}});
  CHECK(distance.rest_length == std::vector<double>{1, std::sqrt(1.25), 2});
  CHECK(distance.compliance == std::vector<double>{0, 0, 0.02});
  const auto& anchor = effect<pbd::Anchor>(file, 1);
  CHECK(anchor.node == std::vector<int>{3});
  CHECK(anchor.target[0] == pbd::Vec3(1, 1, 1));
  CHECK(anchor.compliance[0] == 0.5);
  const auto& bending = effect<pbd::Bending>(file, 2);
  CHECK(bending.node[0] == std::array<int, 4>{1, 2, 0, 3});
  Eigen::Matrix<double, 3, 4> hinge;
  hinge << 1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0.5;
  CHECK(bending.rest_angle[0] == Approx(pbd::dihedral_angle(hinge)));
  CHECK(effect<pbd::Gravity>(file, 3).acceleration == pbd::Vec3(0, 0, -2));
  CHECK(effect<pbd::ExternalForce>(file, 4).node == std::vector<int>{1, 3});
}

TEST_CASE("damping is read where it stands, and only there") {
  const auto file = read(R"(
[particles]
position_m = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]
mass_kg = 1
[[distance]]
nodes = [[0, 1], [1, 2]]
stiffness_n_per_m = 10
[[distance]]
nodes = [0, 2]
damping_s = 0.25
[[anchor]]
node = 1
[[solid]]
cells = [1, 1, 1]
size_m = [1, 1, 1]
density_kg_m3 = 1
young_pa = 100
poisson = 0.3
damping = { young_pa_s = 2, poisson = 0.1 }
anchored = { node = 0, damping_s = 0.5 }
[[cloth]]
cells = [1, 1]
size_m = [1, 1]
area_density_kg_m2 = 1
links = { damping_s = 0.125 }
strain = { young_pa = 1, poisson = 0, thickness_m = 1 }
bending = { damping_s = 2 }
)");
  CHECK(effect<pbd::Distance>(file, 0).damping == std::vector<double>{0, 0, 0.25});
  CHECK(effect<pbd::Anchor>(file, 1).damping.empty());
  const auto& solid = effect<pbd::TetStrain>(file, 2);
  CHECK(solid.damping.value().young == 2);
  CHECK(solid.damping.value().poisson == 0.1);
  CHECK(effect<pbd::Anchor>(file, 3).damping == std::vector<double>{0.5});
  CHECK(effect<pbd::Distance>(file, 4).damping == std::vector<double>(5, 0.125));
  CHECK_FALSE(effect<pbd::TriangleStrain>(file, 5).damping.has_value());
  CHECK(effect<pbd::Bending>(file, 6).damping == std::vector<double>{2});
}

TEST_CASE("texts and comments full of dots are no deep keys, and a byte order mark is skipped") {
  const std::string dots(100, '.');
  const auto file = read("\xEF\xBB\xBF# " + dots + "\ndescription = \"a # \\\"" + dots +
                         "\"\n[[particle]]\nposition_m = [0.5, 0.5, 0.5]\nmass_kg = 1\n");
  CHECK(file.description == "a # \"" + dots);
}

TEST_CASE("a direction may be tiny") {
  const auto file = read("[[chain]]\nlinks = 1\nlength_m = 2\nmass_kg = 1\ndirection = [0, 0, 1e-200]\n");
  CHECK(file.scene.initial.x.col(1) == pbd::Vec3(0, 0, 2));
}

TEST_CASE("effects keep the order of the file, which is that of Gauss-Seidel") {
  const std::string nodes = "[particles]\nposition_m = [[0,0,0],[1,0,0]]\nmass_kg = 1\n";
  const std::string anchor = "[[anchor]]\nnode = 0\n";
  const std::string distance = "[[distance]]\nnodes = [0, 1]\n";
  CHECK(effect<pbd::Anchor>(read(anchor + distance + nodes), 0).node.size() == 1);
  CHECK(effect<pbd::Distance>(read(distance + anchor + nodes), 0).node.size() == 1);
}

TEST_CASE("a chain is a row of equal links with a heavy tip") {
  const std::string text =
      "[[chain]]\nlinks = 4\nlength_m = 2\nmass_kg = 0.1\ntip_mass_kg = 5\ndirection = [0, 0, -3]\n";
  const auto file = read(text + "start_m = [1, 0, 0]\nvelocity_m_s = [0, 1, 0]\n");
  CHECK(file.scene.mass == std::vector<double>{0.1, 0.1, 0.1, 0.1, 5});
  CHECK(file.scene.initial.x.col(4) == pbd::Vec3(1, 0, -2));
  CHECK(file.scene.initial.v.col(0) == pbd::Vec3::Zero());
  CHECK(file.scene.initial.v.col(1) == pbd::Vec3(0, 1, 0));
  CHECK(effect<pbd::Anchor>(file, 0).node == std::vector<int>{0});
  CHECK(effect<pbd::Distance>(file, 1).rest_length == std::vector<double>(4, 0.5));

  const auto fixed = read(text + "start = \"fixed\"\n");
  CHECK(fixed.scene.mass[0] == pbd::infinity);
  CHECK(fixed.scene.effects.size() == 1);
  CHECK(read(text + "start = \"free\"\n").scene.mass[0] == 0.1);
}

TEST_CASE("a cloth has the effects its sub-tables name, and no others") {
  const std::string text =
      "[[cloth]]\ncells = [2, 3]\nsize_m = [1, 2]\narea_density_kg_m2 = 0.5\ntranslation_m = [0, 0, 1]\n";
  const auto bare = read(text);
  CHECK(bare.scene.effects.empty());
  CHECK(bare.scene.nodes() == 12);
  CHECK(std::accumulate(bare.scene.mass.begin(), bare.scene.mass.end(), 0.0) == Approx(1));
  CHECK(bare.scene.initial.x.col(11) == pbd::Vec3(1, 2, 1));

  const auto full = read(text + R"(
[cloth.strain]
young_pa = inf
poisson = 0.25
thickness_m = 0.002
[cloth.links]
compliance_m_per_n = 0.1
[cloth.bending]
compliance_rad_per_n_m = 7
[cloth.anchored]
corners = [[0, 0, 0], [1, 1, 0]]
[[cloth.fixed]]
node = 2
[[cloth.fixed]]
node = 9
)");
  REQUIRE(full.scene.effects.size() == 4);
  CHECK(effect<pbd::TriangleStrain>(full, 0).thickness == 0.002);
  CHECK(effect<pbd::TriangleStrain>(full, 0).node.size() == 12);
  CHECK(effect<pbd::Distance>(full, 1).node.size() == 23);  // 8 + 9 along the sides, 6 diagonals
  CHECK(effect<pbd::Bending>(full, 2).node.size() == 13);   // inner edges: 23 less 10 on the border
  CHECK(effect<pbd::Anchor>(full, 3).node == std::vector<int>{0, 11});
  CHECK(full.scene.mass[2] == pbd::infinity);
  CHECK(full.scene.mass[9] == pbd::infinity);
}

TEST_CASE("a solid is placed, moving rigidly, held where its boxes say, and indices count within it") {
  const auto file = read(R"(
[[particle]]
position_m = [9, 9, 9]
mass_kg = 1
[[solid]]
cells = [2, 1, 1]
size_m = [2, 1, 1]
scale = 0.5
rotation_rad = [0, 0, 1.5707963267948966]
translation_m = [0, 0, 3]
density_kg_m3 = 1000
young_pa = 1e5
poisson = 0.2
strain = "green"
velocity_m_s = [1, 0, 0]
angular_velocity_rad_s = [0, 0, 2]
anchored = { box_m = [[-1, 0.99, 0], [1, 1.01, 4]], compliance_m_per_n = 1e-3 }
fixed = { node = 0 }
)");
  CHECK(file.scene.nodes() == 13);
  CHECK(std::accumulate(file.scene.mass.begin() + 2, file.scene.mass.end(), 0.0) ==
        Approx(1000 * 0.25 - 1000 * 0.125 / 4));  // the box less a quarter of the six tetrahedra at node 0
  const auto& solid = effect<pbd::TetStrain>(file, 0);
  CHECK(solid.strain == pbd::Strain::green);
  CHECK(solid.material.young == 1e5);
  CHECK(solid.node.size() == 12);
  const pbd::Vec3 end(0, 1, 3);  // of the edge along x, which now points along y
  CHECK((file.scene.initial.x.col(3) - end).norm() < 1e-15);
  const pbd::Vec3 centre(-0.25, 0.5, 3.25);
  const pbd::Vec3 velocity = pbd::Vec3(1, 0, 0) + pbd::Vec3(0, 0, 2).cross(end - centre);
  CHECK((file.scene.initial.v.col(3) - velocity).norm() < 1e-14);
  CHECK(effect<pbd::Anchor>(file, 1).node.size() == 4);
  CHECK(file.scene.mass[1] == pbd::infinity);
  CHECK(file.scene.initial.v.col(1) == pbd::Vec3::Zero());
}

TEST_CASE("a body's motion is the same to the bit wherever in memory its scene is read to") {
  const auto velocity = [] {
    return read(R"([[solid]]
cells = [3, 2, 2]
size_m = [0.3, 0.2, 0.2]
translation_m = [0.1, 0.7, 0.3]
density_kg_m3 = 1000
young_pa = 1e5
poisson = 0.3
angular_velocity_rad_s = [1, 2, 3]
)")
        .scene.initial.v;
  };
  const pbd::Points first = velocity();
  std::vector<std::vector<double>> kept;  // what is allocated next moves by 16 bytes
  for (int k = 0; k < 32; ++k) {
    kept.emplace_back(2 * static_cast<std::size_t>(k) + 1);
    CHECK(velocity() == first);
  }
}
