// pbdcheck: the command line. Everything it does is in commands/.
#include <malloc.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <limits>
#include <system_error>
#include <thread>

#include "commands/arguments.h"
#include "commands/commands.h"
#include "cones/cone_solvers.h"
#include "error.h"
#include "harness/interrupt.h"
#include "harness/judges.h"
#include "harness/progress.h"
#include "harness/provenance.h"
#include "rivals/blas.h"
#include "scenes/choices.h"

namespace {

using namespace pbdcheck;

constexpr double most_seconds = 86400;  // a day
constexpr int most_threads = 1024;      // more is a slip of the keyboard

void add_list(CLI::App& app, ListOptions& options) {
  auto* command = app.add_subcommand("list", "Print what there is: " + joined(list_kinds()));
  command->add_option("KIND", options.kind, "One of these; all of them if left out");
  command->add_flag("--json", options.json, "Print JSON")->check(no_value());
}

void add_settings(CLI::App& command, std::vector<std::string>& settings) {
  command
      .add_option("--set", settings,
                  "KEY=VALUE on top of the file, as in method.relaxation=jacobi; may be repeated")
      ->allow_extra_args(false);
}

void add_scene_options(CLI::App& command, std::filesystem::path& scene, std::vector<std::string>& settings,
                       std::filesystem::path& directory) {
  command.add_option("SCENE", scene, "Scene file (TOML)")->required();
  add_settings(command, settings);
  command.add_option("-o,--output", directory, "Folder of the results")->capture_default_str();
}

void add_simulate(CLI::App& app, SimulateOptions& options) {
  auto* command = app.add_subcommand("simulate", "Simulate a scene; writes DIR/probes.csv and DIR/run.json");
  add_scene_options(*command, options.scene, options.settings, options.directory);
  command->add_option("--export", options.export_format, "vtk: a frame a step for ParaView")
      ->check(one_of({"vtk"}));
  command
      ->add_flag("--check", options.check,
                 "Judge each solved step by code that shares nothing with the solver; writes DIR/checks.csv")
      ->check(no_value());
  command->add_option("--judge", options.judge,
                      "every=N: solve each Nth step by a reference, too, and tell the error; writes "
                      "DIR/judged.csv");
}

void add_compare(CLI::App& app, CompareOptions& options) {
  auto* command = app.add_subcommand(
      "compare", "Measure methods against a reference, on one step or a motion; writes DIR/compare.csv");
  add_scene_options(*command, options.scene, options.settings, options.directory);
  command
      ->add_option("--method", options.methods,
                   "KEY=VALUE ... on top of the scene's [method], or rival=NAME with tolerance=VALUE and\n"
                   "max_outer=VALUE at most, in quotes; with --until also step_s=VALUE; may be repeated")
      ->required()
      ->allow_extra_args(false);
  command
      ->add_option("--reference", options.reference,
                   fmt::format("Of a step {}, of a motion {}; if left out the first that knows the scene",
                               fmt::join(reference_names(), ", "), fmt::join(motion_reference_names(), ", ")))
      ->check(one_of(all_reference_names()));
  auto* at_step = command
                      ->add_option("--at-step", options.at_step,
                                   "Steps by the scene's own method before the compared one")
                      ->check(integer_from(0, std::numeric_limits<int>::max()))
                      ->capture_default_str();
  command
      ->add_option("--until", options.until, "Compare the whole motions from 0 to this time (s), not a step")
      ->check(number_between(0, std::numeric_limits<double>::infinity()))
      ->excludes(at_step);
}

void add_advise(CLI::App& app, AdviseOptions& options) {
  auto* command = app.add_subcommand("advise", "Recommend settings that bring a scene to an error quickly");
  command->add_option("SCENE", options.scene, "Scene file (TOML)")->required();
  add_settings(*command, options.settings);
  command
      ->add_option(
          "--error", options.error,
          "Largest error of places at the end, relative to how far things move, or to a thousandth of "
          "the scene's size if that is more")
      ->required()
      ->check(number_between(0, 1));
  command->add_option("--seconds", options.seconds, "About how long to compute")
      ->check(number_between(0, most_seconds))
      ->capture_default_str();
  command->add_flag("--json", options.json, "Print JSON")->check(no_value());
}

void add_threads(CLI::App& command, int& threads) {
  threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  command.add_option("--threads", threads, "Threads of untimed work")
      ->check(integer_from(1, most_threads))
      ->capture_default_str();
}

void add_run(CLI::App& app, RunOptions& options) {
  auto* command =
      app.add_subcommand("run", "Run experiments; writes DIR/EXPERIMENT/ and exits 1 if a verdict fails");
  command->add_option("EXPERIMENT", options.experiments, "Names as of `list experiments`");
  command->add_flag("--all", options.all, "All of them")->check(no_value());
  command->add_option("--tier", options.tier, "quick or full")->capture_default_str();
  add_threads(*command, options.threads);
  command
      ->add_flag("--resume", options.resume, "Skip what is complete with the same commit, tier and settings")
      ->check(no_value());
  command->add_option("-o,--output", options.directory, "Folder of the results")->capture_default_str();
}

void add_verify(CLI::App& app, VerifyOptions& options) {
  auto* command = app.add_subcommand(
      "verify", "Measure the solver against known answers; writes DIR/verify/ and exits 1 if a row fails");
  command
      ->add_option("--only", options.only,
                   "Rows whose id matches the glob, as in 'bar.*'; all but those with '!bar.*'")
      ->check(not_empty("a pattern of ids"));
  command->add_option("--tier", options.tier, "quick or full")->capture_default_str();
  add_threads(*command, options.threads);
  command->add_flag("--resume", options.resume, "Keep what rows this very program has measured there already")
      ->check(no_value());
  command->add_flag("--json", options.json, "Print JSON")->check(no_value());
  command->add_option("--junit", options.junit, "Write the results to this file as JUnit's XML")
      ->check(not_empty("a file"));
  command->add_option("-o,--output", options.directory, "Folder of the results")->capture_default_str();
}

void add_bless(CLI::App& app, BlessOptions& options) {
  auto* command = app.add_subcommand(
      "bless", "Make results of `run` the baselines that `verify` compares with (experiments/baselines/)");
  command->add_option("EXPERIMENT", options.experiments, "Names as of `list experiments`")->required();
  command->add_option("--reason", options.reason, "Why they changed; kept in the baseline")->required();
  command->add_option("-o,--output", options.directory, "Folder of the results")->capture_default_str();
}

void add_cone(CLI::App& app, ConeOptions& options) {
  auto* command = app.add_subcommand("cone", "Solve one contact problem with friction from a file");
  command->add_option("PROBLEM", options.problem, "FCLIB (HDF5) or Siconos (text)")->required();
  command->add_option("--law", options.law, joined(cone_laws()))
      ->check(one_of(cone_laws()))
      ->capture_default_str();
  command
      ->add_option(
          "--relaxation", options.relaxation,
          "A judge of contact problems, a relaxation, or a solver of Siconos: " + joined(cone_solver_names()))
      ->capture_default_str();
  command->add_option("--tolerance", options.tolerance, "Largest natural residual, |r - P_K(r - u)| / |q|")
      ->capture_default_str();
  command->add_flag("--json", options.json, "Print JSON")->check(no_value());
  command->add_option("-o,--output", options.output, "Write problem and solution as FCLIB (HDF5)")
      ->check(not_empty("a file"));
}

/// A usage error in one line, with the nearest command if an unknown one was given.
int usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  std::vector<std::string> commands;
  for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(command->get_name());
  const std::string first = argc > 1 ? argv[1] : "";
  if (std::find(commands.begin(), commands.end(), first) == commands.end())
    error_message(fmt::format("got {}; allowed: {}", first.empty() ? "no command" : "command `" + first + "`",
                              allowed_names(first, commands)));
  else
    error_message(fmt::format("{}; see pbdcheck {} --help", error.what(), first));
  return exit_usage;
}

void require_safe_threads(int& threads) {
  if (threads == 1 || pbd::rivals::blas_is_thread_safe()) return;
  error_message("--threads: got " + std::to_string(threads) + " with " + pbd::rivals::blas_library() +
                ", which is not safe in threads; runs in 1 (allowed: more with libopenblas0-pthread)");
  threads = 1;
}

/// What the arguments ask for; returns the exit code.
int run_command(int argc, char** argv) {
  CLI::App app("Verification harness for position based dynamics", "pbdcheck");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done and every verdict holds; 1 a verdict failed, a solve did not converge or\n"
      "--check refuted a step; 2 bad input or usage; 3 interrupted.\nShell completion: source <(pbdcheck "
      "completion bash)");
  ListOptions list_options;
  SimulateOptions simulate_options;
  CompareOptions compare_options;
  AdviseOptions advise_options;
  RunOptions run_options;
  VerifyOptions verify_options;
  BlessOptions bless_options;
  ConeOptions cone_options;
  std::string shell = "bash";
  add_list(app, list_options);
  add_simulate(app, simulate_options);
  add_compare(app, compare_options);
  add_advise(app, advise_options);
  add_run(app, run_options);
  add_verify(app, verify_options);
  add_bless(app, bless_options);
  add_cone(app, cone_options);
  app.add_subcommand("completion", "Print a completion script: source <(pbdcheck completion bash)")
      ->add_option("SHELL", shell, "bash")
      ->capture_default_str();

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help and --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error, argc, argv);
  }
  catch_interrupts();
  pbd::rivals::use_one_blas_thread();
  if (app.got_subcommand("run")) require_safe_threads(run_options.threads);
  if (app.got_subcommand("verify")) require_safe_threads(verify_options.threads);
  try {
    if (app.got_subcommand("list")) return list(list_options);
    if (app.got_subcommand("simulate")) return simulate(simulate_options);
    if (app.got_subcommand("compare")) return compare(compare_options);
    if (app.got_subcommand("advise")) return advise(advise_options);
    if (app.got_subcommand("run")) return run(run_options);
    if (app.got_subcommand("verify")) return verify(verify_options);
    if (app.got_subcommand("bless")) return bless(bless_options);
    if (app.got_subcommand("cone")) return cone(cone_options);
    return completion(shell);
  } catch (const Interrupted&) {
    return exit_interrupted;
  } catch (const pbd::SetupError& error) {
    error_message(error.what());
    return exit_usage;
  } catch (const std::system_error& error) {  // of the file system
    error_message(error.what());
    return exit_usage;
  } catch (const std::exception& error) {
    error_message(error.what());
    return exit_failed;
  }
}

/// Memory that was freed once is not given back to the system: a timed step would else take it again page by
/// page, or not, as the heap happens to lie.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int largest_mapped = 4 * 1024 * 1024 * static_cast<int>(sizeof(long));  // glibc's most
  mallopt(M_MMAP_THRESHOLD, largest_mapped);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  const int exit_code = run_command(argc, argv);
  if (exit_code == exit_usage || (std::cout.flush() && std::fflush(stdout) == 0)) return exit_code;
  error_message("stdout: got a place that cannot be written; allowed: one that takes the whole output");
  return exit_usage;
}
