#include "commands/simulation_judges.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "contact_newton.h"
#include "error.h"
#include "integrator_map.h"
#include "scenes/contacts.h"

namespace pbdcheck {

nlohmann::ordered_json checks_json(const StepChecks& checks) {
  return {{"steps", checks.judged()},
          {"refuted", checks.refuted_steps()},
          {"missed", checks.missed()},
          {"compared", checks.compared()},
          {"left_out", checks.left_out()}};
}

void write_checks(const std::filesystem::path& path, const StepChecks& checks, TableTotals& totals) {
  Table table(path, {"step", "check", "what", "number", "bound"}, &totals);
  for (const auto& [step, finding] : checks.refuted())
    table.row({step, finding.check, finding.what, finding.number, finding.bound});
  table.close();
}

nlohmann::ordered_json judged_json(const StepJudge& judge) {
  return {{"reference", judge.reference()},
          {"every", judge.every()},
          {"steps", judge.judged()},
          {"unsolved", judge.unsolved()},
          {"missed", judge.missed()},
          {"from_claim_alone", judge.from_claim_alone()},
          {"another_solution", judge.ambiguous()},
          {"solutions_as_they_are", judge.as_they_are()},
          {"features_of_the_begin", judge.by_features()},
          {"worst_error_m", judge.worst_error_m()},
          {"worst_error_of_scale", judge.worst_error_of_scale()}};
}

std::int64_t every_of(const std::string& text) {
  constexpr std::string_view key = "every=";
  std::int64_t every = 0;
  const char* const last = text.data() + text.size();
  const bool known = text.starts_with(key);
  const auto read = std::from_chars(text.data() + (known ? key.size() : 0), last, every);
  if (!known || read.ec != std::errc{} || read.ptr != last || every < 1)
    throw pbd::SetupError("--judge", "`" + text + "`", "every=N with N = 1, 2, ...");
  return every;
}

void require_judgeable(const SceneFile& file, std::int64_t every) {
  pbd::reference::require_judged(file.method.integrator, "--judge: method.integrator");
  if (file.method.direction_blend != 1)
    throw pbd::SetupError("--judge", fmt::format("method.direction_blend {}", file.method.direction_blend),
                          "1");
  if (every > file.steps)
    throw pbd::SetupError("--judge", fmt::format("every={}", every),
                          fmt::format("1 to {} steps", file.steps));
  if (knows_contact(default_reference(file.scene, file.method.integrator)))
    pbd::reference::require_judged(file.scene, file.scene.initial, file.step_s,
                                   pbd::friction_by_name(file.method.friction));
}

}  // namespace pbdcheck
