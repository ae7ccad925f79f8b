// What a user can get wrong: each mistake is refused with exit code 2 and a message that says where it is,
// what stands there and what may, and nothing is written.
#include "mistakes.h"
#include "two_particles.h"

using namespace pbdcheck::test;

namespace {

// Lines 10 to 12.
const std::string cloth = "[[cloth]]\ncells = [1, 1]\narea_density_kg_m2 = 1\n";

/// Of the whole scene if the text contains [step], of what follows the two particles otherwise.
const std::vector<Mistake> mistakes{
    {"[graviti]\n", {"scene.toml:10: graviti", "unknown key", "did you mean `gravity`?"}},
    {"[gravity]\nacceleration = [0, 0, -1]\n",
     {"scene.toml:11: gravity.acceleration", "did you mean `acceleration_m_s2`?"}},
    {"[gravity]\nacceleration_m_s2 = [0, 0]\n",
     {"scene.toml:11: gravity.acceleration_m_s2", "[ 0, 0 ]", "three"}},
    {"[gravity]\nacceleration_m_s2 = [0, 0, nan]\n", {"scene.toml:11", "got nan", "a finite number"}},
    {"[gravity]\nacceleration_m_s2 = \"down\"\n",
     {"scene.toml:11", "down", "a list of three finite numbers"}},
    {"[gravity\n", {"scene.toml:10", "TOML"}},
    {"[[particle]]\nposition_m = [0, 1, 0]\nmass_kg = -1\n",
     {"scene.toml:12: particle.2.mass_kg", "got -1", "a number > 0 up to 1e100, or inf"}},
    {"[[particle]]\nposition_m = [0, 1, 0]\nmass_kg = nan\n", {"scene.toml:12", "got nan", "> 0"}},
    {"[[particle]]\nposition_m = [0, inf, 0]\nmass_kg = 1\n",
     {"scene.toml:11: particle.2.position_m", "got inf"}},
    {"[[particle]]\nposition_m = [0, 1, 0]\n", {"scene.toml:10: particle.2.mass_kg", "got nothing"}},
    {"[particles]\nposition_m = [[0, 1, 0], [0, 2, 0]]\nmass_kg = [1, 2, 3]\n",
     {"scene.toml:12: particles.mass_kg", "[ 1, 2, 3 ]", "a list of 2"}},
    {"[[distance]]\nnodes = [0, 0]\n",
     {"scene.toml:11: distance.0.nodes", "node 0 twice", "different nodes"}},
    {"[[distance]]\nnodes = [0, 2]\n", {"scene.toml:11", "got 2", "a node index from 0 to 1"}},
    {"[[distance]]\nnodes = [0, -1]\n", {"scene.toml:11", "got -1", "an integer from 0 to 2147483647"}},
    {"[[distance]]\nnodes = [0, 1, 2]\n", {"scene.toml:11", "[ 0, 1, 2 ]", "2 integers"}},
    {"[[distance]]\nnodes = [0, 1]\nrest_length_m = -1\n",
     {"scene.toml:12", "got -1", "a finite number >= 0"}},
    {"[[distance]]\nnodes = [0, 1]\ncompliance_m_per_n = -1e-3\n",
     {"scene.toml:12: distance.0.compliance_m_per_n", "got -0.001", ">= 0"}},
    {"[[distance]]\nnodes = [0, 1]\ncompliance_m_per_n = 1\nstiffness_n_per_m = 1\n",
     {"scene.toml:13: distance.0.stiffness_n_per_m", "one of them"}},
    {"[[anchor]]\nnode = 0\n[[anchor]]\nnode = 0\n", {"scene.toml:12: anchor.1", "node 0 anchored twice"}},
    {"[[anchor]]\nnodes = [0, 0]\n", {"scene.toml:11: anchor.0.nodes", "node 0 twice", "each node once"}},
    {"[[anchor]]\nnode = 7\n", {"scene.toml:11: anchor.0.node", "got 7", "from 0 to 1"}},
    {"[[anchor]]\nbox_m = [[5, 5, 5], [6, 6, 6]]\n",
     {"scene.toml:11: anchor.0.box_m", "a box without nodes"}},
    {"[[anchor]]\nbox_m = [[1, 0, 0], [0, 1, 1]]\n",
     {"scene.toml:11: anchor.0.box_m", "[ [ 1, 0, 0 ], [ 0, 1, 1 ] ]", "lowest"}},
    {"[[anchor]]\ncorners = [[0, 2, 0]]\n",
     {"scene.toml:11: anchor.0.corners", "[ [ 0, 2, 0 ] ]", "from [0, 0, 0] to [1, 1, 1]"}},
    {"[[anchor]]\nnear_m = [1e200, 0, 0]\n", {"scene.toml:11: anchor.0.near_m", "1e+200", "up to 1e100"}},
    {"[[anchor]]\nnode = 0\nstiffness_n_per_m = 1e-320\n",
     {"scene.toml:12: anchor.0.stiffness_n_per_m", "got 1e-320", "a number >= 1e-100"}},
    {"[[particle]]\nposition_m = [0, 1, 0]\nmass_kg = inf\n[[anchor]]\nnode = 2\n",
     {"scene.toml:13: anchor.0", "an anchor on node 2, which is fixed", "finite mass"}},
    {"[[anchor]]\ncompliance_m_per_n = 0\n", {"scene.toml:10: anchor.0", "exactly one of node, nodes"}},
    {"[[anchor]]\nnod = 0\n", {"scene.toml:11: anchor.0.nod", "did you mean `node`?"}},
    {"anchor = []\n[step]\nstep_s = 1\nsteps = 1\n[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n",
     {"scene.toml:1: anchor", "got an empty list", "leave the key out"}},
    {"[[gravity]]\n[[gravity]]\n", {"scene.toml:10: gravity", "2 tables", "one table"}},
    {"[[distance]]\nnodes = [0, 1]\nrest_length_m = 0\n",
     {"scene.toml:10: distance.0", "link 0 hard and of rest length 0", "a compliance > 0"}},
    {"[[distance]]\nnodes = [0, 99999999999]\n", {"scene.toml:11", "99999999999", "from 0 to 2147483647"}},
    {"[[distance]]\nnodes = [0, 1]\ndamping_s = -1\n",
     {"scene.toml:12: distance.0.damping_s", "got -1", ">= 0"}},
    {cloth +
         "size_m = [1, 1]\nstrain = { young_pa = inf, poisson = 0.3, thickness_m = 1, damping = { young_pa_s "
         "= 1, poisson = 0.3 } }\n",
     {"scene.toml", "triangle_strain damping", "damping of a finite young"}},
    {cloth +
         "size_m = [1, 1]\nstrain = { young_pa = 1, poisson = 0.3, thickness_m = 1, damping = { young_pa = 1 "
         "} }\n",
     {"scene.toml:14: cloth.0.strain.damping.young_pa_s", "got nothing"}},
    {"[[bending]]\nnodes = [0, 1, 1, 0]\n", {"scene.toml:11: bending.0.nodes", "twice"}},
    {"[[force]]\nnode = 0\n", {"scene.toml:10: force.0.force_n", "got nothing"}},
    {"[[chain]]\nlength_m = 1\nmass_kg = 1\nlinks = 2000000000\n",
     {"scene.toml:13: chain.0.links", "at most"}},
    {"[[solid]]\ncells = [99999, 99999, 99999]\nsize_m = [1, 1, 1]\n",
     {"scene.toml:11: solid.0.cells", "at most"}},
    {"[[solid]]\ncells = [70, 70, 70]\nsize_m = [1, 1, 1]\n",
     {"scene.toml:11: solid.0.cells", "got 2058000 elements", "at most 2000000"}},
    {"[[chain]]\nlength_m = 1\nmass_kg = 1\nlinks = 9\n[[chain]]\nlength_m = 1\nmass_kg = 1\nlinks = "
     "1999992\n",
     {"scene.toml:17: chain.1.links", "got 1999992 elements (2000001 in the scene so far)"}},
    {"[[chain]]\nlength_m = 1\nmass_kg = 1\ndirection = [1e200, 0, 0]\n",
     {"scene.toml:13: chain.0.direction", "1e+200", "up to 1e100"}},
    {"[[chain]]\nlength_m = 1\nmass_kg = 1\nlinks = 0\n",
     {"scene.toml:13: chain.0.links", "got 0", "from 1"}},
    {"[[chain]]\nlength_m = 1\nmass_kg = 1\ndirection = [0, 0, 0]\n", {"scene.toml:13", "the zero vector"}},
    {"[[chain]]\nlength_m = 1\nmass_kg = 1\nstart = \"anchord\"\n",
     {"scene.toml:13", "did you mean `anchored`?"}},
    {"[method]\nrelaxation = \"jacoby\"\n",
     {"scene.toml:11: method.relaxation", "`jacoby`", "did you mean `jacobi`?", "gauss_seidel"}},
    {"[method]\nintegrator = \"euler\"\n", {"scene.toml:11: method.integrator", "`euler`", "implicit_euler"}},
    {"[method]\nalpha = 0.4\n", {"scene.toml:10: method: alpha", "got 0.4", "0.5 to 1"}},
    {"[method]\nbeta = 0.25\n", {"scene.toml:10: method: beta", "both, or neither"}},
    {"[method]\ndirection_blend = 2\n", {"scene.toml:10: method: direction_blend", "got 2", "0 to 1"}},
    {"[method]\nstabilisation = 1.5\n", {"scene.toml:10: method: stabilisation", "got 1.5", "0 to 1"}},
    {"[method]\nmax_outer = 0\n", {"scene.toml:11: method.max_outer", "got 0", "an integer from 1"}},
    {"[method]\nmax_sweeps = 1.5\n", {"scene.toml:11: method.max_sweeps", "got 1.5", "an integer"}},
    {"[method]\nwarm_start = 1\n", {"scene.toml:11: method.warm_start", "got 1", "true or false"}},
    {"[method]\ntolerance = \"small\"\n",
     {"scene.toml:11: method.tolerance", "small", "a finite number >= 0"}},
    {"[[probe]]\nkind = \"speed\"\n", {"scene.toml:11: probe.0.kind", "`speed`", "position, velocity"}},
    {"[[probe]]\nkind = \"position\"\n", {"scene.toml:10: probe.0", "no choice of nodes"}},
    {"[[probe]]\nkind = \"energy\"\n[[probe]]\nkind = \"energy\"\n",
     {"scene.toml:12: probe.1", "same columns"}},
    {"[[probe]]\nkind = \"energy\"\nname = \"a,b\"\n", {"scene.toml:12: probe.0.name", "`a,b`"}},
    {"[[cloth]]\nfile = \"none.obj\"\narea_density_kg_m2 = 1\n",
     {"scene.toml:11: cloth.0.file", "no such file"}},
    {"[[cloth]]\nfile = \"folder.obj\"\n", {"scene.toml:11: cloth.0.file", "folder.obj, a folder"}},
    {cloth + "size_m = 2\n", {"scene.toml:13: cloth.0.size_m", "got 2", "a list of 2 numbers"}},
    {cloth + "size_m = [1, 1]\nlinks = []\n", {"scene.toml:14: cloth.0.links", "an empty list"}},
    {cloth + "size_m = [1, 1]\n[[cloth.links]]\n[[cloth.links]]\n",
     {"scene.toml:14: cloth.0.links", "2 tables", "one table"}},
    {cloth + "size_m = [1, 1]\n[[cloth.fixed]]\nnode = 0\n[[cloth.fixed]]\nnode = 0\n",
     {"scene.toml:16: cloth.0.fixed.1", "node 0 fixed twice"}},
    {cloth + "size_m = [1, 1]\nfixed = { node = 0 }\nanchored = { node = 0 }\n",
     {"scene.toml:15: cloth.0.anchored", "an anchor on node 2, which is fixed"}},
    {cloth + "size_m = [1, 1]\nscale = 1e100\ntranslation_m = [1e100, 0, 0]\n",
     {"scene.toml:10: cloth.0", "positions beyond 1e100 m"}},
    {"[[cloth]]\ncells = [1, 1]\nsize_m = [1e100, 1e100]\narea_density_kg_m2 = 1e100\n",
     {"scene.toml:10: cloth.0", "mass ", "up to 1e100 kg"}},
    {"[[cloth]]\nfile = \"twisted.obj\"\narea_density_kg_m2 = 1\nbending = {}\n",
     {"scene.toml:10: cloth.0: twisted.obj: triangles 0 1", "the same direction"}},
    {"[[cloth]]\ncells = [2, 0]\nsize_m = [1, 1]\narea_density_kg_m2 = 1\n",
     {"scene.toml:11: cloth.0.cells", "got 0"}},
    {"[[solid]]\ncells = [1, 1, 1]\nsize_m = [1, 1, 1]\ndensity_kg_m3 = 1\nyoung_pa = 1\npoisson = 0.5\n",
     {"scene.toml:15: solid.0.poisson", "got 0.5", "-1 < poisson < 0.5"}},
    {"[[solid]]\ncells = [1, 1, 1]\nsize_m = [1, 1, 1]\ndensity_kg_m3 = 1\nyoung_pa = inf\npoisson = 0.3\n",
     {"scene.toml:14: solid.0.young_pa", "got inf"}},
    {"[[solid]]\nfile = \"inverted.node\"\ndensity_kg_m3 = 1\nyoung_pa = 1\npoisson = 0\n",
     {"scene.toml:10: solid.0", "inverted.node: tetrahedron 1", "volume -", "longest edge",
      "a positive volume"}},
    {"[[cloth]]\nfile = \"thin.obj\"\narea_density_kg_m2 = 1\n",
     {"scene.toml:10: cloth.0", "thin.obj: triangle 0", "area 5", "longest edge 1e+20 m",
      "above 1e-12 of the edge's square"}},
    {"[[solid]]\nfile = \"bad.msh\"\ndensity_kg_m3 = 1\nyoung_pa = 1\npoisson = 0\n",
     {"bad.msh:2", "binary", "ASCII"}},
    {"[step]\nstep_s = 0\nsteps = 1\n[[chain]]\nlength_m = 1\nmass_kg = 1\n",
     {"scene.toml:2: step.step_s", "got 0", "a finite number > 0"}},
    {"[step]\nstep_s = 5e-324\nsteps = 1\n[[chain]]\nlength_m = 1\nmass_kg = 1\n",
     {"scene.toml:2: step.step_s", "a number >= 1e-75"}},
    {"[step]\nstep_s = 0.1\n[[chain]]\nlength_m = 1\nmass_kg = 1\n",
     {"scene.toml:1: step.duration_s", "got nothing"}},
    {"[step]\nstep_s = 0.1\nsteps = 1\n", {"scene.toml", "a scene without nodes"}},
    {"[step]\nstep_s = 0.1\nsteps = 1\n[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = inf\n",
     {"scene.toml: got", "every node has infinite mass"}},
    {"# [step] is missing\n[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n",
     {"scene.toml: step: got nothing", "a table [step]"}},
    {"x = 1" + std::string(400, '0') + ".5\n", {"scene.toml:10", "TOML"}},
    {"a" + deep(50000) + " = 1\n", {"scene.toml:10: got a key of too many parts", "at most 32 parts"}},
    {"[a" + deep(50000) + "]\n", {"scene.toml:10: got a key of too many parts"}},
    {"x = { \"a b\"" + deep(50000) + " = 1 }\n", {"scene.toml:10: got a key of too many parts"}},
};

std::string whole_scene(const Mistake& mistake) {
  return mistake.text.find("[step]") != std::string::npos ? mistake.text : two_particles + mistake.text;
}

}  // namespace

TEST_CASE("mistakes in a scene file are refused with line, key, value and what is allowed") {
  for (const auto& mistake : mistakes) {
    INFO(mistake.text);
    const TemporaryFolder folder;
    folder.write("thin.obj", "v 0 0 0\nv 1e20 0 0\nv 0 0.1 0\nf 1 2 3\n");
    folder.write("inverted.node", "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0 0 -1\n");
    folder.write("inverted.ele", "2 4 0\n0 0 1 2 3\n1 0 1 2 4\n");
    folder.write("twisted.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n");
    std::filesystem::create_directory(folder.path / "folder.obj");
    folder.write("bad.msh", "$MeshFormat\n4.1 1 8\n");
    const auto scene = folder.write("scene.toml", whole_scene(mistake));
    const auto out = folder.path / "out";
    check_refused(run_program({"simulate", scene, "-o", out}), mistake.message);
    CHECK_FALSE(std::filesystem::exists(out));
  }
}
