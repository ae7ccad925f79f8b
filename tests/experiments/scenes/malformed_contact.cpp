// What a user can get wrong with contact: refused with exit code 2 and a message that says where it is, what
// stands there and what may, and nothing is written.
#include <algorithm>

#include "mistakes.h"

using namespace pbdcheck::test;

namespace {

// Lines 1 to 19 of every scene below.
const std::string three_bodies = R"([[rigid_body]]
name = "ground"
shape = "half_space"
material = "stone"
[[rigid_body]]
name = "ball"
shape = "sphere"
radius_m = 0.5
mass_kg = 2
position_m = [0, 0, 1]
material = "wood"
[[rigid_body]]
name = "hook"
shape = "sphere"
radius_m = 0.5
mass_kg = 2
[step]
step_s = 0.01
steps = 2
)";

std::string contact(const std::string& rest) {
  return "[contact]\n" + rest;
}

std::string pair(const std::string& rest) {
  return contact("[[contact.pair]]\n" + rest);
}

std::string apart(const std::string& bodies) {
  return contact("[[contact.apart]]\nbodies = " + bodies + "\n");
}

std::string probe(const std::string& rest) {
  return contact("[[probe]]\nkind = \"contact_force\"\n" + rest);
}

std::string third_body(const std::string& rest) {
  return contact("[[rigid_body]]\nname = \"third\"\n" + rest);
}

std::string particle(const std::string& rest) {
  return contact("[[particle]]\nposition_m = [0, 0, 9]\nmass_kg = 1\n[particle.contact]\n" + rest);
}

std::string cloth_and_body(const std::string& rest) {
  return "[[cloth]]\ncells = [1, 1]\nsize_m = [1, 1]\narea_density_kg_m2 = 1\n[cloth.contact]\n" + rest;
}

const std::vector<Mistake> contact_mistakes{
    {"", {"scene.toml:5: rigid_body.1", "without a table [contact]", "a table [contact]"}},
    {contact("frction = 1\n"), {"scene.toml:21: contact.frction", "did you mean `friction`?"}},
    {contact("friction = -1\n"), {"scene.toml:21: contact.friction", "got -1", ">= 0"}},
    {contact("friction = inf\n"), {"scene.toml:21: contact.friction", "got inf", "a finite number"}},
    {contact("restitution = 1.5\n"), {"scene.toml:21: contact.restitution", "got 1.5", "from 0 to 1"}},
    {contact("restitution = -0.5\n"), {"scene.toml:21: contact.restitution", "got -0.5", "from 0 to 1"}},
    {contact("margin_m = -1\n"), {"scene.toml:21: contact.margin_m", "got -1", ">= 0"}},
    {contact("margin = 1\n"), {"scene.toml:21: contact.margin", "did you mean `margin_m`?"}},
    {contact("recovery_m_s = -1\n"), {"scene.toml:21: contact.recovery_m_s", "got -1", ">= 0"}},
    {contact("thickness_m = \"thin\"\n"), {"scene.toml:21: contact.thickness_m", "got 'thin'"}},
    {contact("damping_s = nan\n"), {"scene.toml:21: contact.damping_s", "got nan"}},
    {contact("compliance_m_per_n = 1\nstiffness_n_per_m = 1\n"),
     {"scene.toml:22: contact.stiffness_n_per_m", "a stiffness and a compliance"}},
    {"[[contact]]\n[[contact]]\n", {"contact", "2 tables", "one table"}},
    {pair("friction = 1\n"), {"scene.toml:21: contact.pair.0.materials", "got nothing", "2 texts"}},
    {pair("materials = [\"wood\"]\n"), {"scene.toml:22: contact.pair.0.materials", "a list of 2 texts"}},
    {pair("materials = [\"wood\", \"stome\"]\n"),
     {"scene.toml:22: contact.pair.0.materials", "`stome`", "one of stone, wood; did you mean `stone`?"}},
    {pair("materials = [\"wood\", \"stone\"]\n[[contact.pair]]\nmaterials = [\"stone\", \"wood\"]\n"),
     {"scene.toml:24: contact.pair.1.materials", "`stone` and `wood` twice", "each pair once"}},
    {pair("materials = [\"wood\", \"stone\"]\nmargin_m = 1\n"),
     {"scene.toml:23: contact.pair.0.margin_m", "unknown key"}},
    {apart("[\"ball\", \"groun\"]"),
     {"scene.toml:22: contact.apart.0.bodies", "`groun`", "did you mean `ground`?"}},
    {apart("[\"ball\", \"ball\"]"), {"scene.toml:22: contact.apart.0.bodies", "`ball` twice"}},
    {apart("[\"ball\", \"world\"]"),
     {"scene.toml:22: contact.apart.0.bodies", "`world`, which touches nothing", "take part in contact"}},
    {third_body("shape = \"half_space\"\nmass_kg = 1\n"),
     {"scene.toml:24: rigid_body.3.mass_kg", "a mass of a half space", "it is fixed"}},
    {third_body("shape = \"half_space\"\nheld = \"moving\"\n"),
     {"scene.toml:24: rigid_body.3.held", "a half space that moves", "fixed"}},
    {third_body("shape = \"half_space\"\nvelocity_m_s = [1, 0, 0]\n"),
     {"scene.toml:24: rigid_body.3.velocity_m_s", "a velocity of a fixed body"}},
    {third_body("shape = \"half_spce\"\n"),
     {"scene.toml:23: rigid_body.3.shape", "did you mean `half_space`?"}},
    {third_body("mass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nmaterial = \"wood\"\n"),
     {"scene.toml:25: rigid_body.3.material", "contact without a shape", "a body with a shape"}},
    {third_body("shape = \"sphere\"\nradius_m = 1\nmass_kg = 1\nmaterial = \"Wood\"\n"),
     {"scene.toml:26: rigid_body.3.material", "`Wood`", "lower case letters"}},
    {third_body("shape = \"sphere\"\nradius_m = 1\nmass_kg = 1\ncontact = 1\n"),
     {"scene.toml:26: rigid_body.3.contact", "got 1", "true or false"}},
    {third_body("shape = \"sphere\"\nradius_m = 1\nmass_kg = 1\ncontact = false\n[[contact.apart]]\nbodies = "
                "[\"ball\", \"third\"]\n"),
     {"scene.toml:28: contact.apart.0.bodies", "`third`, which touches nothing"}},
    {third_body("mass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nsurface_velocity_m_s = [1, 0, 0]\n"),
     {"scene.toml:25: rigid_body.3.surface_velocity_m_s", "contact without a shape", "a body with a shape"}},
    {third_body("shape = \"sphere\"\nradius_m = 1\nmass_kg = 1\ncontact = false\n"
                "surface_velocity_m_s = [1, 0, 0]\n"),
     {"scene.toml:27: rigid_body.3.surface_velocity_m_s", "a surface that touches nothing"}},
    {third_body("shape = \"sphere\"\nradius_m = 1\nmass_kg = 1\nsurface_velocity_m_s = [1, 0]\n"),
     {"scene.toml:26: rigid_body.3.surface_velocity_m_s"}},
    {third_body("shape = \"sphere\"\nradius_m = 1\nmass_kg = 1\nsurface_velocity_m_s = [inf, 0, 0]\n"),
     {"scene.toml:26: rigid_body.3.surface_velocity_m_s", "got inf", "finite"}},
    {contact("nodes_touch = 1\n"), {"scene.toml:21: contact.nodes_touch", "got 1", "true or false"}},
    {particle("radius_m = -1\n"), {"scene.toml:25: particle.0.contact.radius_m", "got -1", ">= 0"}},
    {particle("radius = 1\n"), {"scene.toml:25: particle.0.contact.radius", "did you mean `radius_m`?"}},
    {particle("surface = true\n"), {"scene.toml:25: particle.0.contact.surface", "unknown key"}},
    {particle("node = 1\n"), {"scene.toml:25: particle.0.contact.node", "got 1", "from 0 to 0"}},
    {contact(cloth_and_body("surface = true\nradius_m = 0.1\n")),
     {"scene.toml:27: cloth.0.contact.radius_m", "unknown key"}},
    {contact("thickness_m = 0\n" + cloth_and_body("surface = true\n")),
     {"scene.toml:21: contact.thickness_m", "got 0", "a number > 0 where surfaces and bodies take part"}},
    {contact(cloth_and_body("surface = 1\n")), {"scene.toml:26: cloth.0.contact.surface", "true or false"}},
    {contact(cloth_and_body("node = 1\nnodes = [2]\n")),
     {"scene.toml:27: cloth.0.contact.nodes", "both node, nodes"}},
    {contact("[[probe]]\nkind = \"contact\"\n"),
     {"scene.toml:22: probe.0.kind", "`contact`", "did you mean `contacts`?"}},
    {probe(""), {"scene.toml:21: probe.0.body", "got nothing"}},
    {probe("body = \"bal\"\n"), {"scene.toml:23: probe.0.body", "did you mean `ball`?"}},
    {probe("body = \"ball\"\nother = \"ball\"\n"), {"scene.toml:24: probe.0.other", "`ball` twice"}},
    {probe("body = \"ball\"\nnode = 1\n"), {"scene.toml:24: probe.0.node", "unknown key"}},
    {contact("[method]\nfriction = \"columb\"\n"),
     {"scene.toml:22: method.friction", "did you mean `coulomb`?"}},
    {contact("[method]\nintegrator = \"midpoint\"\n"),
     {"integrator: got midpoint with contact", "implicit_euler"}},
    {contact("[method]\nrelaxation = \"ldlt\"\n"),
     {"scene.toml:22: method.relaxation", "got ldlt with contact", "direct"}},
};

}  // namespace

TEST_CASE("mistakes with contact are refused with line, key, value and what is allowed") {
  check_mistakes(TemporaryFolder(), three_bodies, contact_mistakes);
}

TEST_CASE("methods that contact does not allow are refused where they are stated") {
  const TemporaryFolder folder;
  const auto out = folder.path / "out";
  const std::string stack = (scenes / "stack.toml").string();
  check_refused(run_program({"simulate", stack, "-o", out, "--set", "method.integrator=midpoint"}),
                {"--set method.integrator", "contact"});
  check_refused(run_program({"simulate", stack, "-o", out, "--set", "contact.friction=1e20"}),
                {"--set contact.friction", "a number from 0 to 1e+07"});
  check_refused(run_program({"simulate", stack, "-o", out, "--set", "rigid_body.1.mass_kg=1e-50"}),
                {"stack.toml", "mass", "within a factor of"});
}

TEST_CASE("contact that nothing takes part in, and what stands without it, are refused") {
  const TemporaryFolder folder;
  const std::string rest =
      "[step]\nstep_s = 1\nsteps = 1\n[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n";
  for (const auto& [text, message] : std::vector<Mistake>{
           {"[contact]\n", {"scene.toml:7: contact", "where nothing touches", "a rigid body with a shape"}},
           {"[particle.contact]\n", {"scene.toml:7: particle.0.contact", "without a table [contact]"}},
           {"[[rigid_body]]\nname = \"a\"\nshape = \"half_space\"\ncontact = false\n",
            {"scene.toml:7: rigid_body.0", "without a table [contact]"}},
           {"[[probe]]\nkind = \"contacts\"\n",
            {"scene.toml:8: probe.0.kind", "`contacts`", "the scene has no table [contact]"}}}) {
    INFO(text);
    check_refused(
        run_program({"simulate", folder.write("scene.toml", rest + text), "-o", folder.path / "out"}),
        message);
  }
}
