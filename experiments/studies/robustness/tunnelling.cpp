// Do fast things pass through each other? Random pairs of all kinds are thrown at each other, and code that
// shares nothing with the solver's search of contacts follows each step's way (passage.h).
#include <fmt/format.h>

#include <exception>
#include <numbers>

#include "step/step.h"
#include "studies/experiments.h"
#include "studies/robustness/thrown_pair.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double half_turn = std::numbers::pi;  // rad

/// Steps of scenes. A scene ends with its first step that misses its tolerance or passes.
struct Tally {
  std::int64_t scenes = 0, hits = 0, ok = 0, missed = 0, turned = 0, passed = 0, passed_missed = 0,
               passed_in_touch = 0;

  void operator+=(const Tally& other) {
    scenes += other.scenes;
    hits += other.hits;
    ok += other.ok;
    missed += other.missed;
    turned += other.turned;
    passed += other.passed;
    passed_missed += other.passed_missed;
    passed_in_touch += other.passed_in_touch;
  }
};

struct Attempt {
  Tally tally;
  std::string error;
};

/// Where straight ways and constant turns lead from `start`.
State unhindered(const State& start, double h) {
  State end = start;
  end.x += h * start.v;
  for (std::size_t body = 0; body < end.orientation.size(); ++body) {
    const Vec3 turn = h * start.spin.col(static_cast<Eigen::Index>(body));
    end.orientation[body] = end.orientation[body] * Eigen::AngleAxisd(turn.norm(), turn.stableNormalized());
  }
  return end;
}

bool passes(const ThrownPair& pair, const State& from, const State& to) {
  return pass_through(pair.scene, pair.core[0], pair.core[1], from, to);
}

/// 1 if the two pass through each other where nothing stops them.
std::int64_t hits(const ThrownPair& pair) {
  State state = pair.scene.initial;
  for (int k = 0; k < pair.steps; ++k) {
    const State from = state;
    state = unhindered(from, pair.h);
    if (passes(pair, from, state)) return 1;
  }
  return 0;
}

bool turns_round(const State& end, double h) {
  return end.spin.cols() > 0 && !(h * end.spin.colwise().norm().maxCoeff() < half_turn);
}

Tally tally_of(const ThrownPair& pair) {
  Tally tally{1, hits(pair)};
  Workspace workspace(pair.scene, Method{});
  State state = pair.scene.initial;
  for (int k = 0; k < pair.steps; ++k) {
    const State from = state;
    const bool ok = step(workspace, pair.h, state).status == Status::ok;
    ++(ok ? tally.ok : tally.missed);
    tally.turned += ok && turns_round(state, pair.h);
    if (passes(pair, from, state)) {
      const bool apart_before = apart(pair.scene, pair.whole[0], pair.whole[1], from) >= pair.apart / 2;
      ++(!ok ? tally.passed_missed : apart_before ? tally.passed : tally.passed_in_touch);
      break;
    }
    if (!ok) break;
  }
  return tally;
}

Attempt throw_pair(const std::array<Thing, 2>& kinds, std::int64_t index, bool continuous) {
  try {
    return {tally_of(thrown_pair(kinds, index, continuous)), ""};
  } catch (const std::exception& error) {
    return {{}, error.what()};
  }
}

struct Row {
  std::array<std::string, 2> name;
  Tally tally;
  std::string error;
};

/// The scenes of a pair of kinds; those whose steps pass are listed.
Row row_of(Context& context, const std::array<Thing, 2>& kinds, bool continuous, std::int64_t count,
           Table& passed) {
  std::vector<Attempt> all(static_cast<std::size_t>(count));
  context.parallel(
      count, [&](std::int64_t i) { all[static_cast<std::size_t>(i)] = throw_pair(kinds, i, continuous); });
  const auto name = [&](std::size_t k) {
    return std::string(thing_names[static_cast<std::size_t>(kinds[k])]);
  };
  Row row{{name(0), name(1)}, {}, ""};
  for (std::int64_t i = 0; i < count; ++i) {
    const auto& [tally, error] = all[static_cast<std::size_t>(i)];
    row.tally += tally;
    if (!error.empty()) row.error = fmt::format("scene {}: {}", i, error);
    const std::string step = tally.passed > 0            ? "ok"
                             : tally.passed_in_touch > 0 ? "ok, from touch"
                                                         : "missed";
    if (continuous && tally.passed + tally.passed_in_touch + tally.passed_missed > 0)
      passed.row({row.name[0], row.name[1], i, step});
  }
  return row;
}

}  // namespace

void tunnelling(Context& context) {
  const auto pairs = thrown_pairs();
  context.begin(2 * std::ssize(pairs));
  Table table = context.table(
      "pairs", {"first", "second", "continuous", "scenes", "hits", "steps_ok", "steps_missed", "steps_turned",
                "passed_ok", "passed_in_touch", "passed_missed", "status", "reason"});
  Table passed = context.table("passed", {"first", "second", "scene", "step_status"});
  std::array<Tally, 2> sum;  // without continuous detection, with it
  std::int64_t blind = 0, errors = 0;
  for (const bool continuous : {true, false})
    for (const auto& kinds : pairs) {
      const bool cloth = kinds[0] == Thing::sheet || kinds[1] == Thing::sheet;
      const std::int64_t count = context.full()         ? (continuous ? 10000 : 1000)
                                 : !continuous || cloth ? 10
                                                        : 30;
      const Row row = row_of(context, kinds, continuous, count, passed);
      const Tally& tally = row.tally;
      table.row({row.name[0], row.name[1], std::int64_t{continuous}, tally.scenes, tally.hits, tally.ok,
                 tally.missed, tally.turned, tally.passed, tally.passed_in_touch, tally.passed_missed,
                 std::string(row.error.empty() ? "ok" : "skipped"), row.error});
      sum[continuous] += tally;
      errors += !row.error.empty();
      blind += tally.hits == 0;
      context.advance(row.name[0] + ", " + row.name[1]);
    }
  table.close();
  passed.close();
  const auto verdict = [&](Basis basis, std::string_view id, std::string_view statement,
                           std::int64_t measured, std::int64_t of, std::string_view what, double bound) {
    context.verdict(basis, fmt::format("tunnelling.{}", id), statement, fmt::format("{}, of {}", what, of),
                    static_cast<double>(measured), bound);
  };
  const Tally& with = sum[1];
  verdict(Basis::code, "solved", "nothing passes through what it begins apart from in a step that is solved",
          with.passed, with.ok, "steps that do", 0);
  verdict(Basis::goal, "in_touch", "nor does what begins in touch", with.passed_in_touch, with.ok,
          "steps that do", 0);
  verdict(Basis::goal, "missed", "nothing passes in a step that misses its tolerance", with.passed_missed,
          with.missed, "missed steps that do", 0);
  verdict(Basis::goal, "misses", "one in a hundred scenes that hit is missed at most", with.missed, with.hits,
          "missed steps", 0.01 * static_cast<double>(with.hits));
  verdict(Basis::robustness, "throws", "no scene throws", errors, 2 * std::ssize(pairs),
          "pairs of kinds with one that does", 0);
  verdict(Basis::robustness, "hit", "of each pair of kinds some scenes hit", blind, 2 * std::ssize(pairs),
          "pairs of kinds without", 0);
  context.verdict(
      Basis::robustness, "tunnelling.bites", "without continuous detection this judge sees solved steps pass",
      fmt::format("1 if none does; {} of {} do", sum[0].passed, sum[0].ok), sum[0].passed > 0 ? 0.0 : 1.0, 0);
}

}  // namespace pbdcheck
