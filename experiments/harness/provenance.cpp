#include "harness/provenance.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <metis.h>
#include <sys/utsname.h>
#include <toml++/toml.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "build_info.h"
#include "harness/experiment.h"
#include "judge.h"
#include "rivals/blas.h"
#include "scenes/body_shapes.h"

namespace pbdcheck {
namespace {

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.find(':') + 2, line.size()));
  return "unknown";
}

/// "Linux 6.1.0 x86_64, Debian GNU/Linux 12 (bookworm)"
std::string operating_system() {
  utsname kernel{};
  uname(&kernel);
  std::string text = fmt::format("{} {} {}", kernel.sysname, kernel.release, kernel.machine);
  constexpr std::string_view name = "PRETTY_NAME=\"";
  std::ifstream in("/etc/os-release");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(name)) text += ", " + line.substr(name.size(), line.rfind('"') - name.size());
  return text;
}

/// Mean number of processes that ran or waited in the last minute, -1 if the system does not say.
double load() {
  double mean = -1;
  return getloadavg(&mean, 1) == 1 ? mean : -1;
}

std::string now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

nlohmann::ordered_json libraries() {
  nlohmann::ordered_json used{
      {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"tomlplusplus", fmt::format("{}.{}.{}", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
      {"nlohmann_json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                    NLOHMANN_JSON_VERSION_PATCH)},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"cli11", CLI11_VERSION},
      {"metis", fmt::format("{}.{}.{}", METIS_VER_MAJOR, METIS_VER_MINOR, METIS_VER_SUBMINOR)},
      {"qhull", qhull_version()}};
  for (const auto& [name, version] : pbd::reference::library_versions()) used[name] = version;
  used["blas"] = pbd::rivals::blas_library();
  return used;
}

}  // namespace

bool from_this_build(const nlohmann::ordered_json& record) {
  return record.value("commit", "") == build_info::commit &&
         record.value("changes", "") == build_info::changes;
}

std::string version_text() {
  std::string text = fmt::format("pbdcheck {} ({}{})", build_info::version, build_info::commit,
                                 build_info::dirty ? ", with uncommitted changes" : "");
  const auto used = libraries();
  for (const auto& [name, version] : used.items()) text += "\n" + name + " " + version.get<std::string>();
  return text;
}

nlohmann::ordered_json run_record(int threads, RunOutcome outcome, const std::string& reason) {
  nlohmann::ordered_json record{{"commit", build_info::commit},
                                {"dirty", build_info::dirty},
                                {"changes", build_info::changes},
                                {"version", build_info::version},
                                {"compiler", build_info::compiler},
                                {"flags", build_info::flags},
                                {"march", build_info::march},
                                {"date", now()},
                                {"system", operating_system()},
                                {"processor", processor()},
                                {"cores", std::thread::hardware_concurrency()},
                                {"load", load()},
                                {"threads", threads},
                                {"seed", seed},
                                {"libraries", libraries()},
                                {"status", outcome_names[static_cast<std::size_t>(outcome)]}};
  if (!reason.empty()) record["reason"] = reason;
  return record;
}

std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2) + "\n";
}

}  // namespace pbdcheck
