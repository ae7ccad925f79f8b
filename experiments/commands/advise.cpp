#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "error.h"
#include "harness/pilot.h"
#include "scenes/contacts.h"
#include "scenes/scene_file.h"

namespace pbdcheck {
namespace {

/// Keys and values as of --set, of a run on the scene's whole duration.
std::vector<std::pair<std::string, std::string>> settings_of(const SceneFile& file, const Pilot& pilot,
                                                             const PilotRun& run) {
  const pbd::Method& method = run.setting.method;
  const double step = pilot.duration / static_cast<double>(run.setting.steps);
  std::vector<std::pair<std::string, std::string>> all{{"step.step_s", fmt::format("{}", step)}};
  if (file.counts_steps)
    all.emplace_back("step.steps",
                     fmt::format("{}", std::lround(static_cast<double>(file.steps) * file.step_s / step)));
  all.emplace_back("method.integrator", method.integrator);
  all.emplace_back("method.outer", method.outer);
  all.emplace_back("method.relaxation", method.relaxation);
  all.emplace_back("method.tolerance", fmt::format("{}", method.tolerance));
  return all;
}

std::string set_text(const SceneFile& file, const Pilot& pilot, const PilotRun& run) {
  std::string text;
  for (const auto& [key, value] : settings_of(file, pilot, run))
    text += fmt::format("{}--set {}={}", text.empty() ? "" : " ", key, value);
  return text;
}

std::string toml_text(const SceneFile& file, const Pilot& pilot, const PilotRun& run) {
  std::string text, section;
  for (const auto& [key, value] : settings_of(file, pilot, run)) {
    const std::string table = key.substr(0, key.find('.'));
    if (table != section) text += fmt::format("{}[{}]\n", section.empty() ? "" : "\n", table);
    section = table;
    const bool word = std::isalpha(static_cast<unsigned char>(value[0])) != 0;
    text += fmt::format("{0} = {2}{1}{2}\n", key.substr(table.size() + 1), value, word ? "\"" : "");
  }
  return text;
}

double whole_duration(const SceneFile& file) {
  return static_cast<double>(file.steps) * file.step_s;
}

bool is_part(const SceneFile& file, const Pilot& pilot) {
  return pilot.duration < whole_duration(file) * (1 - 1e-9);
}

/// Nothing touches in the part that the pilot tells, which may be otherwise later.
bool is_before_contact(const SceneFile& file, const Pilot& pilot) {
  return is_part(file, pilot) && contact_of(file.scene) != nullptr && !pilot.truth.touched;
}

/// What the pilot cannot tell.
std::vector<std::string> limits(const AdviseOptions& options, const SceneFile& file, const Pilot& pilot) {
  std::vector<std::string> all;
  if (is_part(file, pilot)) {
    const std::string why =
        pilot.untold > 0 ? fmt::format("as {:.3g} s of computing do not tell where the first {:.4g} s end",
                                       pilot.spent_s, pilot.untold)
                         : fmt::format("which took {:.3g} s of computing", pilot.spent_s);
    all.emplace_back(fmt::format(
        "what comes after the first {:.4g} of {:.4g} s, {}: impacts later on may want shorter steps",
        pilot.duration, whole_duration(file), why));
  }
  if (is_before_contact(file, pilot)) all.emplace_back("contact, of which there is none in these");
  all.emplace_back(fmt::format("errors below {:.2g}, three error bars of the truth ({})", pilot.truth.told(0),
                               pilot.truth.method));
  if (!(pilot.truth.told(0) <= options.error))
    all.emplace_back(
        "whether a motion that shorter steps do not settle has an end of its own: it may be chaotic");
  if (!pilot.complete)
    all.emplace_back(
        fmt::format("what is beyond the {} settings that {:g} s allow", pilot.tried, options.seconds));
  return all;
}

/// Why no setting is told.
std::string why_none(const AdviseOptions& options, const Pilot& pilot) {
  if (!std::isnan(pilot.truth.error_bar))
    return fmt::format("No setting of {} that were tried solves the scene", pilot.tried);
  std::string why = fmt::format("No setting was tried, as there is no true end of the first {:.4g} s: {}, {}",
                                pilot.duration, pilot.truth.method, pilot.truth.reason);
  if (pilot.needed_s > options.seconds)
    why += fmt::format("; --seconds {:.0f} at least", std::ceil(pilot.needed_s));
  return why;
}

/// How many times as long the second best takes; none if it is alone.
std::optional<double> margin(const Pilot& pilot) {
  if (pilot.met.size() < 2) return {};
  return pilot.met[1].wall_s / pilot.met[0].wall_s;
}

/// Of a step from the true end.
double memory_mb(const SceneFile& file, const Pilot& pilot, const PilotRun& run) {
  return step_memory_mb(file, pilot.duration, run.setting, pilot.truth.end);
}

nlohmann::ordered_json advice_json(const AdviseOptions& options, const SceneFile& file, const Pilot& pilot) {
  nlohmann::ordered_json json{{"scene", options.scene.string()},
                              {"error_asked", options.error},
                              {"found", !pilot.met.empty()},
                              {"settings", nullptr},
                              {"error", nullptr},
                              {"error_scale_m", nullptr},
                              {"ms_per_s", nullptr},
                              {"memory_mb", nullptr},
                              {"margin", nullptr},
                              {"second", nullptr}};
  if (const auto* run = !pilot.met.empty() ? pilot.met.data() : pilot.nearest ? &*pilot.nearest : nullptr) {
    json["settings"] = nlohmann::ordered_json::object();
    for (const auto& [key, value] : settings_of(file, pilot, *run)) json["settings"][key] = value;
    json["error"] = run->error;
    json["error_scale_m"] = error_scale(file.scene, pilot.truth.end);
    json["ms_per_s"] = pilot.ms_per_s(*run);
    json["memory_mb"] = memory_mb(file, pilot, *run);
  }
  if (const auto times = margin(pilot)) {
    json["margin"] = *times;
    json["second"] = set_text(file, pilot, pilot.met[1]);
  }
  json["error_bar"] = pilot.truth.error_bar;
  json["truth"] = pilot.truth.method;
  json["duration_s"] = pilot.duration;
  json["before_contact"] = is_before_contact(file, pilot);
  json["tried"] = pilot.tried;
  json["spent_s"] = pilot.spent_s;
  if (pilot.needed_s > 0) json["needed_s"] = pilot.needed_s;
  if (pilot.met.empty() && !pilot.nearest) json["reason"] = why_none(options, pilot);
  json["cannot_tell"] = limits(options, file, pilot);
  return json;
}

void print_advice(const AdviseOptions& options, const SceneFile& file, const Pilot& pilot) {
  if (pilot.met.empty() && !pilot.nearest) {
    fmt::print("{}.\n", why_none(options, pilot));
    return;
  }
  const PilotRun& run = pilot.met.empty() ? *pilot.nearest : pilot.met[0];
  if (pilot.met.empty())
    fmt::print("No setting of {} that were tried meets an error of {:g}; the nearest has {:.2g}.\n",
               pilot.tried, options.error, run.error);
  if (is_before_contact(file, pilot))
    fmt::print(
        "Nothing touches in the first {:.4g} s, and no longer part could be told: this is advice for free "
        "motion alone.\n",
        pilot.duration);
  fmt::print("{}\n\n{}\n", set_text(file, pilot, run), toml_text(file, pilot, run));
  fmt::print("error {:.2g} +- {:.1g} of {:.2g} m after {:.4g} s, {:.3g} ms per simulated second, {:.2g} MB",
             run.error, pilot.truth.error_bar, error_scale(file.scene, pilot.truth.end), pilot.duration,
             pilot.ms_per_s(run), memory_mb(file, pilot, run));
  if (const auto times = margin(pilot))
    fmt::print("; the second best takes {:.2f} times as long:\n{}\n", *times,
               set_text(file, pilot, pilot.met[1]));
  else
    fmt::print("\n");
  fmt::print("Not told: {}.\n", fmt::join(limits(options, file, pilot), "; "));
}

}  // namespace

int advise(const AdviseOptions& options) {
  const SceneFile file = read_scene_file(options.scene, options.settings);
  static_cast<void>(file.workspace());  // refuses what the scene does not allow where the file says it
  const Pilot found = pilot(file, options.error, options.seconds);
  if (options.json)
    fmt::print("{}\n", advice_json(options, file, found).dump(2));
  else
    print_advice(options, file, found);
  return found.met.empty() ? exit_failed : exit_done;
}

}  // namespace pbdcheck
