// What a user can get wrong with rigid bodies: refused with exit code 2 and a message that says
// where it is, what stands there and what may, and nothing is written.
#include "mistakes.h"
#include "two_bodies.h"

using namespace pbdcheck::test;

namespace {

const std::vector<Mistake> body_mistakes{
    {body("mass_kg = 1\n"), {"scene.toml:15: rigid_body.2.name", "got nothing"}},
    {body("name = \"Arm\"\n"), {"scene.toml:16: rigid_body.2.name", "`Arm`", "lower case letters"}},
    {body("name = \"arm\"\n"), {"scene.toml:16: rigid_body.2.name", "`arm` twice", "a name of its own"}},
    {body("name = \"world\"\n"), {"scene.toml:16: rigid_body.2.name", "`world`", "another name"}},
    {body("name = \"a\"\nshape = \"spere\"\n"),
     {"scene.toml:17: rigid_body.2.shape", "did you mean `sphere`?"}},
    {body(sphere + "mass_kg = 1\n"), {"scene.toml:15: rigid_body.2.radius_m", "got nothing"}},
    {body(sphere + "radius_m = 0\n"), {"scene.toml:18: rigid_body.2.radius_m", "got 0", "> 0"}},
    {body(sphere + "radius_m = 1\n"),
     {"scene.toml:15: rigid_body.2.density_kg_m3", "density_kg_m3 or mass_kg"}},
    {body(sphere + "radius_m = 1\nlength_m = 1\nmass_kg = 1\n"),
     {"scene.toml:19: rigid_body.2.length_m", "unknown key"}},
    {body(sphere + "radius_m = 1\nmass_kg = 1\ndensity_kg_m3 = 1\n"),
     {"scene.toml:19: rigid_body.2.mass_kg", "a density and a mass", "one of them"}},
    {body(sphere + "radius_m = 1\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\n"),
     {"scene.toml:20: rigid_body.2.inertia_kg_m2", "a shape and moments of inertia"}},
    {body(sphere + "radius_m = 1\nmass_kg = inf\n"), {"scene.toml:19: rigid_body.2.mass_kg", "got inf"}},
    {body(sphere + "radius_m = 1e100\ndensity_kg_m3 = 1\n"),
     {"scene.toml:15: rigid_body.2", "moments of inertia inf", "up to 1e100"}},
    {body(sphere + "radius_m = 1e-80\ndensity_kg_m3 = 1\n"),
     {"scene.toml:15: rigid_body.2", "moments of inertia 0"}},
    {body(sphere + "radius_m = 1\nmass_kg = 1\nheld = \"still\"\n"),
     {"scene.toml:20: rigid_body.2.held", "`still`", "free, fixed, moving"}},
    {body(sphere + "radius_m = 1\ndensity_kg_m3 = 1\nvelocity_m_s = [1e15, 1e15, 0]\n"),
     {"scene.toml:20: rigid_body.2.velocity_m_s", "1000000000000000.0", "a speed up to 1e+15 m/s"}},
    {body(sphere + "radius_m = 1\nheld = \"fixed\"\nvelocity_m_s = [1, 0, 0]\n"),
     {"scene.toml:20: rigid_body.2.velocity_m_s", "a fixed body", "moving"}},
    {body("name = \"a\"\nshape = \"box\"\nsize_m = [1, 1]\nmass_kg = 1\n"),
     {"scene.toml:18: rigid_body.2.size_m", "[ 1, 1 ]", "a list of 3 numbers"}},
    {body("name = \"a\"\nmass_kg = 1\n"), {"scene.toml:15: rigid_body.2.inertia_kg_m2", "got nothing"}},
    {body("name = \"a\"\ninertia_kg_m2 = [1, 1, 1]\n"),
     {"scene.toml:15: rigid_body.2.mass_kg", "got nothing"}},
    {body("name = \"a\"\ndensity_kg_m3 = 1\n"),
     {"scene.toml:17: rigid_body.2.density_kg_m3", "a density without a shape"}},
    {body("name = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 3]\n"),
     {"scene.toml:18: rigid_body.2.inertia_kg_m2", "[ 1, 1, 3 ]", "none larger than the sum"}},
    {body("name = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 0]\n"),
     {"scene.toml:18: rigid_body.2.inertia_kg_m2", "got 0", "> 0"}},
    {body("name = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nrotation_rad = [0, 1e9, 0]\n"),
     {"scene.toml:19: rigid_body.2.rotation_rad", "at most 1e8 rad"}},
    {body("name = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nrotation_rad = [0, nan, 0]\n"),
     {"scene.toml:19: rigid_body.2.rotation_rad", "got nan"}},
    {body("name = \"a\"\nshape = \"mesh\"\nfile = \"open.obj\"\nmass_kg = 1\n"),
     {"scene.toml:15: rigid_body.2: open.obj: surface: got edge", "a closed surface"}},
    {body("name = \"a\"\nshape = \"mesh\"\nfile = \"inside_out.obj\"\nmass_kg = 1\n"),
     {"scene.toml:15: rigid_body.2: inside_out.obj: surface: got volume -", "seen from outside"}},
    {body("name = \"a\"\nshape = \"mesh\"\nfile = \"none.obj\"\nmass_kg = 1\n"),
     {"scene.toml:18: rigid_body.2.file", "none.obj, no such file"}},
    {body("name = \"a\"\nshape = \"mesh\"\nfile = \"mesh.stl\"\nmass_kg = 1\n"),
     {"extension `.stl`", ".obj or .off"}},
    {body("name = \"a\"\nshape = \"hull\"\nfile = \"flat.obj\"\nmass_kg = 1\n"),
     {"scene.toml:15: rigid_body.2: flat.obj: convex hull: got 5 points within 2 x 3 x 0 m",
      "do not lie in one plane"}},
    {body("name = \"a\"\nshape = \"hull\"\nfile = \"broken.obj\"\nmass_kg = 1\n"),
     {"broken.obj: convex hull: got 5 points within 1 x 1 x 1e+30 m"}},
    {body("name = \"a\"\nshape = \"mesh\"\nfile = \"crossed.obj\"\nmass_kg = 1\n"),
     {"crossed.obj: surface: got parts that enclose a negative volume", "does not cross itself"}},
    {body("name = \"a\"\nshape = \"hull\"\nfile = \"few.obj\"\nmass_kg = 1\n"),
     {"few.obj: convex hull: got 3 points", "four points"}},
    {"[[joint]]\nbodies = [\"arm\", \"hand\"]\nkind = 1\n",
     {"scene.toml:17: joint.0.kind", "got 1", "one of ball, hinge"}},
    {body("name = \"a\"\nshape = \"sphere\"\nradius_m = 1\nmass_kg = 1\ncopies = [2, 2]\nspacing_m = [1, 1, "
          "1]\n"),
     {"scene.toml:20: rigid_body.2.copies", "three numbers >= 1"}},
    {body("name = \"a\"\nshape = \"sphere\"\nradius_m = 1\nmass_kg = 1\ncopies = [1000, 1000, 2]\nspacing_m "
          "= [1, 1, 1]\n"),
     {"scene.toml:20: rigid_body.2.copies", "at most 100000"}},
    {body("name = \"a\"\nshape = \"sphere\"\nradius_m = 1\nmass_kg = 1\nscatter_m = 1\n"),
     {"scene.toml:20: rigid_body.2.scatter_m", "`copies`, too"}},
    {body("name = \"a\"\nshape = \"sphere\"\nradius_m = 1\nmass_kg = 1\ncopies = [2, 1, 1]\n"),
     {"rigid_body.2.spacing_m", "got nothing"}},
    {body("name = \"a\"\nshape = 1\n"), {"scene.toml:17: rigid_body.2.shape", "got 1", "one of sphere, box"}},
    {"[method]\nouter = 1\n", {"scene.toml:16: method.outer", "got 1", "one of auto, plain"}},
};

}  // namespace

TEST_CASE("mistakes with rigid bodies are refused with line, key, value and what is allowed") {
  const TemporaryFolder folder;
  const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  folder.write("open.obj", tetrahedron);
  folder.write("inside_out.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 4 2\nf 2 4 3\nf 3 4 1\nf 1 2 3\n");
  folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 2 3 0\n");
  folder.write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1e30\n");
  // The tetrahedron, and a smaller one inside out far away.
  folder.write("crossed.obj", tetrahedron +
                                  "f 1 3 2\nv 9 0 0\nv 9.5 0 0\nv 9 0.5 0\nv 9 0 0.5\n"
                                  "f 5 8 6\nf 6 8 7\nf 7 8 5\nf 5 6 7\n");
  folder.write("few.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  folder.write("mesh.stl", "solid\n");
  check_mistakes(folder, two_bodies, body_mistakes);
}

TEST_CASE("bodies that are missed are asked for") {
  const TemporaryFolder folder;
  const std::string step = "[step]\nstep_s = 1\nsteps = 1\n";
  for (const auto& [text, message] : std::vector<Mistake>{
           {"[gyroscopic]\n[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n",
            {"scene.toml:4: gyroscopic", "a gyroscopic torque without a rigid body", "[[rigid_body]]"}},
           {"", {"a scene without nodes", "rigid_body"}},
           {"[[rigid_body]]\nname = \"a\"\nheld = \"fixed\"\n", {"every node has infinite mass"}},
           {"[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n[[probe]]\nkind = \"position\"\nbody = "
            "\"a\"\n",
            {"scene.toml:9: probe.0.body", "`a`", "of which the scene has none"}}}) {
    INFO(text);
    check_refused(
        run_program({"simulate", folder.write("scene.toml", step + text), "-o", folder.path / "out"}),
        message);
  }
}
