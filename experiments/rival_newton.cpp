// When is quasi_newton, which factors one constant matrix a scene, faster than Newton's method, which
// factors the stiffness at every iterate? One step of a falling cantilever for sizes and materials: seconds
// until the error first falls to a target, as in a running simulation: what only the first step of a scene
// takes (making, ordering, the constant factor) stands apart.
#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "experiments.h"
#include "judges.h"
#include "measure.h"
#include "scenes/standard.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double step_s = 1.0 / 60;
constexpr int lead_steps = 10;     // from rest
constexpr int most_judged = 5184;  // tetrahedra that a judge solves in passable time; rivals above
constexpr double targets[]{1e-3, 1e-6, 1e-10};

struct Problem {
  std::string name;
  Scene scene;
  Material material;
  std::int64_t elements;
  bool largest;
};

std::vector<Problem> problems(bool full) {
  std::vector<Problem> all;
  for (const int cells : {8, 16, 24, 44})
    for (const double young : {1e5, 1e6, 1e7})
      for (const double poisson : {0.3, 0.49}) {
        if (!full && (cells == 44 || young != 1e6)) continue;
        Scene scene = cantilever(cells, {young, poisson}, Strain::green);
        const auto elements = std::ssize(std::get<TetStrain>(scene.effects.front()).node);
        all.push_back({fmt::format("cantilever E={:g} nu={:g}", young, poisson),
                       std::move(scene),
                       {young, poisson},
                       elements,
                       cells == 44});
      }
  return all;
}

/// One step by a method that is ready for the scene; shows the iterates with the seconds so far.
using Watch = std::function<void(int iteration, double seconds, const Points& x)>;
using Step = std::function<Report(State& state, const Watch& watch)>;

struct Contestant {
  std::string name;
  std::function<Step(const Scene& scene)> make;
};

Step ready_quasi_newton(const Scene& scene) {
  Method method;
  method.outer = "quasi_newton";
  method.tolerance = 1e-12;
  method.max_outer = 2000;
  method.warm_start = false;
  const auto workspace = std::make_shared<Workspace>(scene, method);
  return [&scene, method, workspace](State& state, const Watch& watch) {
    return step(scene, method, step_s, state, *workspace, [&](const Iterate& iterate) {
      watch(iterate.outer_iteration, std::nan(""), iterate.x);
    });
  };
}

}  // namespace
}  // namespace pbdcheck
