// Whole scenes: what their rows tell of a run that goes well and of one that does not.
#include "studies/scenes/scene_run.h"

#include <catch2/catch.hpp>

#include "results.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

namespace {

struct SceneTable {
  std::vector<std::vector<std::string>> rows;

  double number(std::size_t row, const std::string& column) const {
    const auto found = std::find(rows[0].begin(), rows[0].end(), column);
    return std::stod(rows.at(row + 1).at(static_cast<std::size_t>(found - rows[0].begin())));
  }
};

SceneTable run_plans(const TemporaryFolder& folder, const std::vector<ScenePlan>& plans,
                     std::vector<Verdict>& verdicts) {
  Context context(folder.path, Tier::quick, 1);
  SceneStudy study(context, plans);
  for (const ScenePlan& plan : plans) study.run(plan, nullptr);
  study.conclude("tested", "them");
  verdicts = context.verdicts();
  return {rows_of(folder.path / "scenes.csv")};
}

}  // namespace

TEST_CASE("a domino that tilts gains energy of the first order in the step, and its frames are written") {
  std::vector<ScenePlan> plans{plan_of("dominoes")};
  plans[0].duration = 0.1;
  add_shorter(plans, 2);
  const TemporaryFolder folder;
  std::vector<Verdict> verdicts;
  const SceneTable table = run_plans(folder, plans, verdicts);
  CHECK(table.number(1, "step_s") == table.number(0, "step_s") / 2);
  CHECK(table.number(0, "excess_share") > 1e-6);
  CHECK(table.number(0, "excess_share") / table.number(1, "excess_share") == Approx(2).epsilon(0.05));
  for (const Verdict& verdict : verdicts) {
    INFO(verdict.id);
    CHECK(verdict.ruling() == Ruling::holds);
  }
  for (const auto* collection : {"simulation.pvd", "bodies.pvd", "contacts.pvd"}) {
    const std::string text = read_text(folder.path / "dominoes" / collection);
    std::size_t frames = 0;
    for (std::size_t at = 0; (at = text.find("timestep", at)) != std::string::npos; ++at) ++frames;
    CHECK(frames == 4);  // of steps 0, 7, 14 and the last one, 20
  }
}

TEST_CASE("a stack that is not solved is told, and whose steps they are") {
  std::vector<ScenePlan> plans{plan_of("incline"), plan_of("stack")};
  for (ScenePlan& plan : plans) plan.duration = 0.05, plan.pictured = false;
  plans[1].file.method.relaxation = "gauss_seidel";
  plans[1].file.method.max_sweeps = 1;
  plans[1].file.method.max_outer = 1;
  const TemporaryFolder folder;
  std::vector<Verdict> verdicts;
  const SceneTable table = run_plans(folder, plans, verdicts);
  CHECK(table.number(0, "steps_ok") == 5);
  CHECK(table.number(1, "steps_ok") == 0);
  CHECK(table.number(1, "judged_steps") == 0);
  const auto solved = std::find_if(verdicts.begin(), verdicts.end(),
                                   [](const Verdict& verdict) { return verdict.id == "tested.solved"; });
  REQUIRE(solved != verdicts.end());
  CHECK(solved->ruling() == Ruling::missed);
  CHECK(solved->quantity == "missed steps of a scene (stack)");
  CHECK_FALSE(std::filesystem::exists(folder.path / "stack"));
}
