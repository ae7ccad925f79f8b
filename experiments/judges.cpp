#include "judges.h"

#include "choices.h"
#include "error.h"
#include "judge.h"

namespace pbdcheck {

std::vector<std::string> reference_names() {
  std::vector<std::string> names;
  for (const auto& judge : pbd::reference::judges()) names.emplace_back(judge.name);
  return names;
}

Judged judge_step(const std::string& name, const pbd::Scene& scene, const pbd::State& state, double h) {
  const auto& all = pbd::reference::judges();
  for (const auto& judge : all)
    if (name.empty() || judge.name == name) {
      const auto judged = judge.judge(scene, state, h);
      return {judged.x,
              std::string(pbd::reference::outcome_names[static_cast<std::size_t>(judged.outcome)]),
              judged.reason,
              judged.iterations,
              judged.seconds,
              judged.residual};
    }
  throw pbd::SetupError("--reference", "`" + name + "`", allowed_names(name, reference_names()));
}

}  // namespace pbdcheck
