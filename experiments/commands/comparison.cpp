#include "commands/comparison.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "harness/progress.h"

namespace pbdcheck {
namespace {

/// Draws `compare.csv` of a folder by the project's plotting script; a warning if that fails.
void draw(const std::filesystem::path& directory) {
  const std::string script = (source_root() / "plots" / "compare.py").string(), folder = directory.string();
  const char* const arguments[] = {"/usr/bin/python3", script.c_str(), folder.c_str(), nullptr};
  pid_t child = 0;
  int status = 0;
  const bool started =
      posix_spawn(&child, arguments[0], nullptr, nullptr, const_cast<char* const*>(arguments), environ) == 0;
  if (!started || waitpid(child, &status, 0) < 0 || status != 0)
    warn(fmt::format("no figure drawn: {} {} failed", arguments[0], script));
}

const std::filesystem::path& writable(const std::filesystem::path& directory) {
  require_writable(directory);
  return directory;
}

}  // namespace

void Compared::fail(const std::string& why) {
  outcome = RunOutcome::failed;
  reason = why;
  all_ok = false;
  error_message(why);
}

void Compared::stop() {
  outcome = RunOutcome::interrupted;
  reason = "stopped by the user";
}

ComparisonRecord::ComparisonRecord(const CompareOptions& options)
    : options_(options), file_(writable(options.directory) / "run.json") {}

nlohmann::ordered_json ComparisonRecord::settings(const SceneFile& file, const std::string& reference) const {
  return {{"scene", options_.scene.string()},
          {"set", options_.settings},
          {"step_s", file.step_s},
          {"nodes", file.scene.nodes()},
          {"method", method_text(file.method)},
          {"compared", options_.methods},
          {"reference", reference}};
}

int ComparisonRecord::close(const nlohmann::ordered_json& settings, const TableTotals& totals,
                            const Compared& compared) {
  auto json = run_record(1, compared.outcome, compared.reason);
  json["settings"] = settings;
  json["rows"] = totals.rows;
  json["wall_s"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  file_.write(json_text(json));
  file_.complete();
  if (compared.outcome == RunOutcome::interrupted) return exit_interrupted;
  draw(options_.directory);
  return compared.all_ok ? exit_done : exit_failed;
}

}  // namespace pbdcheck
