// What others would use instead of our solver, and the list of them.
//
// A rival does one implicit Euler step by a method of its own, written to be fast. It is neither solver nor
// judge: it shares the scene with both and nothing else.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "scene.h"

namespace pbd::rivals {

enum class Status { ok, not_converged, diverged };
inline constexpr std::array<std::string_view, 3> status_names{"ok", "not_converged", "diverged"};

/// When a step ends. The tolerance is on the residual |v - v_free - W J^T p|_M, relative to the step's scale
/// |v - v_l|_M + |v_free - v_l|_M, as for our solver.
struct Budget {
  double tolerance = 1e-8;
  int max_iterations = 100;
};

/// What a step reached and took. Seconds are without the observer's; parts need not add up to the whole.
struct Report {
  Status status = Status::not_converged;
  std::string_view reason;  // empty if ok
  int iterations = 0;
  int factorisations = 0;
  double residual = 0;  // relative to the step's scale
  double seconds = 0;
  double evaluate_s = 0;  // energy and gradient
  double assemble_s = 0;  // stiffness
  double factorise_s = 0;
  double solve_s = 0;
};

/// Shown every iterate, the first one being where the rival begins.
struct Iterate {
  int iteration;
  double seconds;   // so far, without the observer's
  double residual;  // as in the report
  const Points& x;  // m
};
using Observer = std::function<void(const Iterate&)>;

/// A method ready for one scene and one step length; what is the same for every step is done in its making.
class Rival {
 public:
  Rival() = default;
  Rival(const Rival&) = delete;
  Rival& operator=(const Rival&) = delete;
  virtual ~Rival() = default;

  /// Advances `state` by the step. Does not throw: what went wrong stands in the report. A diverged step
  /// leaves `state` as it was.
  virtual Report step(State& state, const Budget& budget, const Observer& observer) = 0;
  Report step(State& state, const Budget& budget = {}) { return step(state, budget, {}); }
};

/// Throws SetupError for an invalid scene or step (s), and for effects that the rival cannot do.
using MakeRival = std::unique_ptr<Rival> (*)(const Scene& scene, double h);
struct NamedRival {
  std::string_view name;
  MakeRival make;
  bool solves_step;  // where it ends is the step's solution, whatever the tolerance
};

/// newton, vbd, xpbd.
std::span<const NamedRival> rivals();

}  // namespace pbd::rivals
