// Limits without rows: one-sided ones, undamped, that are open and stay so until the bodies that they join
// have gone a part of the way to a stop. What waits has no impulse.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "rows/begin_values.h"
#include "rows/wandered.h"

namespace pbd {

template <class E>
class WaitingLimits {
  using C = Constraint<E>;
  using Block = BlockOf<E>;

 public:
  /// `entries` of an effect with bounds have rows where nothing waits. Without this nothing does.
  void allocate(const E& effect, const std::vector<std::size_t>& entries) {
    entries_ = entries;
    waits_.assign(constraint_count(effect), false);
    take(effect);
  }

  /// Takes bounds and bodies of the effect, while nothing waits.
  void take(const E& effect) {
    one_sided_.clear();
    to_look_ = 1;
    std::vector<int> bodies;
    for (const std::size_t entry : entries_) {
      const auto& [lower, upper] = effect.bounds[entry];
      if ((lower == 0) == (upper == 0)) continue;
      one_sided_.push_back(entry);
      for (const int body : C::body(effect, entry)) bodies.push_back(body);
    }
    seen_ = SeenBodies(std::move(bodies));
  }

  bool waits(std::size_t entry) const { return waiting_ > 0 && waits_[entry]; }

  /// Where a step begins: has those wait that nothing comes near, and calls the others. True if the rows are
  /// others than before.
  bool look(const Scene& scene, const E& effect, const StepBegin& begin, Block& block) {
    if (one_sided_.empty()) return false;
    const Wandered next = seen_.free_motion(begin);
    const bool stay = waiting_ == 0 || approach_.part(seen_.wandered(begin.at) + next) < 1;
    if (stay && (waiting_ == one_sided_.size() || --to_look_ > 0)) return false;
    to_look_ = patience;
    seen_.see(begin.at);
    approach_ = {};
    std::vector<bool> waits(waits_.size(), false), pushes(waits_.size(), false);
    for (std::size_t i = 0; i < block.size(); ++i) pushes[block.entry(i)] = block.impulse[i][0] != 0;
    for (const std::size_t entry : one_sided_) {
      const auto own = local_at(effect, entry, columns_of(scene, effect, entry), begin.at);
      const double gap = open(effect, entry, own);
      if (pushes[entry] || !(gap > 0)) continue;
      const Approach approach = C::approach(effect, entry, own, gap);
      waits[entry] = approach.part(least_steps * next) < 1;
      if (waits[entry]) approach_.take_quicker(approach);
    }
    return put(scene, effect, begin.inverse_mass, waits, block);
  }

  /// Calls those that a solved iterate has passed, of angles all that it may have; true if there are any.
  bool call(const Scene& scene, const E& effect, const StepBegin& begin, const Configuration& reached,
            Block& block) {
    if (waiting_ == 0) return false;
    const Wandered step = seen_.way_of_step(begin, reached.x);
    if (approach_.part(seen_.wandered(begin.at) + step) < 1) return false;
    std::vector<bool> waits = waits_;
    for (const std::size_t entry : one_sided_) {
      if (!waits[entry]) continue;
      const auto columns = columns_of(scene, effect, entry);
      if constexpr (is_angle<E>) {
        const auto start = local_at(effect, entry, columns, begin.at);
        const double gap = open(effect, entry, start);
        waits[entry] = gap > 0 && C::approach(effect, entry, start, gap).part(step) < 1;
      } else {
        waits[entry] = open(effect, entry, local_at(effect, entry, columns, reached)) > 0;
      }
    }
    return put(scene, effect, begin.inverse_mass, waits, block);
  }

  /// True if any waited.
  bool call_all(const Scene& scene, const E& effect, const std::vector<double>& inverse_mass, Block& block) {
    return put(scene, effect, inverse_mass, std::vector<bool>(waits_.size(), false), block);
  }

 private:
  static constexpr double least_steps = 4;  // like the one that begins, to wait for less is not worth it
  static constexpr int patience = 32;       // steps: what is near is not soon far

  /// c or -c: above 0 where the limit is idle.
  static double open(const E& effect, std::size_t entry, const typename C::Positions& at) {
    typename C::Value value;
    typename C::Jacobian unused;
    C::evaluate(effect, entry, at, value, unused);
    return effect.bounds[entry][0] == 0 ? value[0] : -value[0];
  }

  /// Rows of what does not wait; those that had one keep what is in it.
  bool put(const Scene& scene, const E& effect, const std::vector<double>& inverse_mass,
           const std::vector<bool>& waits, Block& block) {
    if (waits == waits_) return false;
    const Block before = block;
    block.entries = entries_;
    std::erase_if(block.entries, [&](std::size_t entry) { return waits[entry]; });
    block.resize(block.entries.size());
    block.bounds.resize(block.size());
    for (std::size_t i = 0, k = 0; i < block.size(); ++i) {
      block.node[i] = columns_of(scene, effect, block.entries[i]);
      while (k < before.size() && before.entry(k) < block.entries[i]) ++k;
      if (k == before.size() || before.entry(k) != block.entries[i]) continue;
      block.impulse[i] = before.impulse[k];
      block.jacobian[i] = before.jacobian[k];
      block.bias[i] = before.bias[k];
      block.compliance.set(i, before.compliance.factor(k));
      block.inverse_diagonal[i] = before.inverse_diagonal[k];
    }
    if (block.size() == waits.size()) block.entries.clear();
    block.divide(inverse_mass, block.chunks.threads);
    waits_ = waits;
    waiting_ = static_cast<std::size_t>(std::count(waits.begin(), waits.end(), true));
    return true;
  }

  std::vector<std::size_t> entries_, one_sided_;
  std::vector<bool> waits_;  // of all of the effect's constraints
  std::size_t waiting_ = 0;
  Approach approach_;  // of those that wait, from where the bodies were seen
  SeenBodies seen_;
  int to_look_ = 1;  // steps
};

}  // namespace pbd
