// The commands of pbdcheck. Each takes its options, writes results to stdout or files, and returns the exit
// code; mistakes in what the user gave are SetupErrors.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/exit_codes.h"
#include "ledger/ledger.h"
#include "studies/experiments.h"

namespace pbdcheck {

inline constexpr const char* default_directory = "results";

/// What can be listed.
std::vector<std::string> list_kinds();

struct ListOptions {
  std::string kind;  // empty: all kinds
  bool json = false;
};
int list(const ListOptions& options);

struct SimulateOptions {
  std::filesystem::path scene;
  std::vector<std::string> settings;  // KEY=VALUE
  std::filesystem::path directory = default_directory;
  std::string export_format;         // empty or "vtk"
  bool check = false;                // judge what each step claims
  std::optional<std::string> judge;  // every=N: compare each Nth step with a reference's
};
int simulate(const SimulateOptions& options);

struct CompareOptions {
  std::filesystem::path scene;
  std::vector<std::string> settings;
  std::vector<std::string> methods;  // each "KEY=VALUE KEY=VALUE ..." on top of the scene's method
  std::string reference;             // empty: the first one
  std::optional<double> until;       // s: whole motions are compared, not one step
  int at_step = 0;                   // steps of the scene's own method before the step that is compared
  std::filesystem::path directory = default_directory;
};
int compare(const CompareOptions& options);

struct AdviseOptions {
  std::filesystem::path scene;
  std::vector<std::string> settings;
  double error = 0;     // of places at the end, as `end_error`
  double seconds = 30;  // of computing, about
  bool json = false;
};
/// The quickest settings for an error, by a pilot on the scene.
int advise(const AdviseOptions& options);

struct RunOptions {
  std::vector<std::string> experiments;
  bool all = false;
  std::string tier = "quick";
  int threads = 1;
  bool resume = false;
  std::filesystem::path directory = default_directory;
};
int run(const RunOptions& options, const std::vector<Experiment>& known = experiments());

struct VerifyOptions {
  std::string only{};  // a glob of ids; empty: all rows
  std::string tier = "quick";
  int threads = 1;
  bool resume = false;
  bool json = false;
  std::filesystem::path junit{};  // empty: none
  std::filesystem::path directory = default_directory;
};
int verify(const VerifyOptions& options, const std::vector<LedgerRow>& known = ledger_rows());

struct BlessOptions {
  std::vector<std::string> experiments;
  std::string reason;
  std::filesystem::path directory = default_directory;
};
/// Makes results the baselines that `verify` compares with.
int bless(const BlessOptions& options);

struct ConeOptions {
  std::filesystem::path problem;
  std::string law = "coulomb";
  std::string relaxation = "cone_interior_point";
  double tolerance = 1e-8;
  bool json = false;
  std::filesystem::path output;  // empty: none
};
int cone(const ConeOptions& options);

/// Prints the completion script of a shell.
int completion(const std::string& shell);

}  // namespace pbdcheck
