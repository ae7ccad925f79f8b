// Mistakes in --set and on the command line: each is refused with exit code 2 and what is allowed.
#include "mistakes.h"
#include "two_particles.h"

using namespace pbdcheck::test;

TEST_CASE("mistakes in --set are refused with the setting") {
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.toml", two_particles);
  const std::vector<std::pair<std::string, std::vector<std::string>>> settings{
      {"method.relaxatoin=jacobi", {"--set method.relaxatoin", "unknown key", "did you mean `relaxation`?"}},
      {"method.relaxation=jacoby", {"--set method.relaxation", "`jacoby`", "did you mean `jacobi`?"}},
      {"step.step_s=-1", {"--set step.step_s", "got -1", "> 0"}},
      {"step.step_s=fast", {"--set step.step_s", "fast", "a finite number > 0"}},
      {"stepp.step_s=1", {"--set stepp", "did you mean `step`?"}},
      {"particle.2.mass_kg=1", {"--set particle.2.mass_kg", "entry `2`", "from 0 to 1"}},
      {"particle.x.mass_kg=1", {"--set particle.x.mass_kg", "entry `x`"}},
      {"step.step_s.x=1", {"--set step.step_s.x", "below a value"}},
      {"step..step_s=1", {"--set step..step_s", "a dotted path"}},
      {"a" + deep(1000) + "=1", {"--set: got a key of too many parts", "at most 32"}},
      {"step.step_s", {"--set", "`step.step_s`", "KEY=VALUE"}}};
  for (const auto& [setting, message] : settings) {
    INFO(setting);
    const auto out = folder.path / "out";
    check_refused(run_program({"simulate", scene, "--set", setting, "-o", out}), message);
    CHECK_FALSE(std::filesystem::exists(out));
  }
}

TEST_CASE("mistakes on the command line are refused with what is allowed") {
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.toml", two_particles).string();
  const auto file = folder.write("file", "").string();
  std::filesystem::create_symlink("loop.toml", folder.path / "loop.toml");
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> lines{
      {{"simulat", scene}, {"`simulat`", "did you mean `simulate`?"}},
      {{"simulate", folder.path / "none.toml"}, {"none.toml", "no such file"}},
      {{"simulate", folder.path}, {folder.path.string() + ": got a folder", "a scene file"}},
      {{"simulate", folder.path / "loop.toml"}, {"loop.toml: got", "symbolic links"}},
      {{"simulate"}, {"SCENE"}},
      {{"simulate", scene, "--exprot", "vtk"}, {"--exprot"}},
      {{"simulate", scene, "--export", "vtu"}, {"--export", "`vtu`", "vtk"}},
      {{"simulate", scene, "-o", file}, {"-o", file, "a directory"}},
      {{"simulate", scene, "-o", file + "/below"}, {"-o", file, "a directory"}},
      {{"simulate", scene, "-o", "/proc/nothing"}, {"-o", "/proc/nothing", "a directory"}},
      {{"list", "integratorz"}, {"`integratorz`", "did you mean `integrators`?"}},
      {{"run", "no_such_experiment"}, {"run", "`no_such_experiment`"}},
      {{"run"}, {"nothing to run", "--all"}},
      {{"run", "incline", "stack", "incline"}, {"incline more than once", "each experiment once"}},
      {{"run", "--all", "--tier", "ful"}, {"--tier", "did you mean `full`?"}},
      {{"run", "--all", "--threads", "0"}, {"--threads", "got `0`"}},
      {{"run", "--all", "--threads", "many"}, {"--threads", "many"}},
      {{"compare", scene}, {"--method"}},
      {{"compare", scene, "--method", "relaxation=jacoby"},
       {"--method relaxation", "did you mean `jacobi`?"}},
      {{"compare", scene, "--method", "integrator=newmark"},
       {"--method integrator", "`newmark`", "implicit_euler, which leads to the step"}},
      {{"compare", scene, "--method", "direction_blend=0.5"}, {"--method direction_blend", "got 0.5"}},
      {{"compare", scene, "--method", "speed=1"}, {"--method speed", "unknown key"}},
      {{"compare", scene, "--method", "outer=plain", "--reference", "oracle"}, {"--reference", "`oracle`"}},
      {{"compare", scene, "--method", "outer=plain", "--at-step", "-1"}, {"--at-step"}},
      {{"completion", "fish"}, {"`fish`", "bash"}}};
  for (const auto& [line, message] : lines) {
    INFO(line[0] << " " << (line.size() > 1 ? line.back() : ""));
    check_refused(run_program(line), message);
  }
}
