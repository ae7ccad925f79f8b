// Scenes and schemes of the experiment `direction`, and one simulation of a scene by a scheme.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scene.h"
#include "step/step.h"

namespace pbdcheck {

/// Where constraints take their directions from, and how far a step is solved.
struct Scheme {
  std::string family;  // "position": the constraints' values are met; "velocity": one linearisation a step
  pbd::Method method{};
};

/// Blends of directions from a step's begin (0) to its end (1), and symplectic_euler (SHAKE: 0), every linear
/// problem solved directly.
std::vector<Scheme> position_schemes(std::string_view outer);
/// Velocity time stepping with a share of stabilisation.
std::vector<Scheme> velocity_schemes();
std::vector<Scheme> joined(std::vector<Scheme> first, const std::vector<Scheme>& second);

struct DirectionScene {
  std::string name;
  pbd::Scene scene;
  double energy_scale;  // J
  double largest_gain;  // of the scale: what exceeds it has blown up
  /// Of a state, J; of the start, 0 or `energy_scale`.
  std::function<double(const pbd::State&)> energy;
};

/// Pendulum of 1 m released horizontally.
DirectionScene hard_pendulum();
/// Chain of `links` released horizontally, its tip `ratio` times as heavy as the other nodes.
DirectionScene swinging_tip(int links, double ratio);

/// A chain of 20 links along x, one end fixed, the other pulled by 100 N; no gravity. Small transverse
/// motions have modes y_i = sin((2 n - 1) pi i/(2 N + 1)) of 2 sqrt(T/(m d)) sin((2 n - 1) pi/(2 (2 N + 1)))
/// rad/s.
struct TautChain {
  static constexpr int links = 20;
  static constexpr double tension = 100, mass = 0.1, length = 1.0 / links;  // N, kg, m

  static double frequency(int mode);
  static pbd::Vec3 shape(int mode, int node);
  /// Coordinate of a mode.
  static double coordinate(int mode, const pbd::Points& x);
  static pbd::Scene at_rest();
};
/// All of its modes moved by `speed` (m/s). Its energy is that of small transverse motion.
DirectionScene taut_chain(double speed);

/// What a simulation showed: energies over the scale, violations of links over their lengths.
struct DirectionRun {
  double energy_end = 0, energy_lowest = 0, energy_highest = 0;
  double largest_rise = 0;  // of the energy in a step
  double violation_largest = 0, violation_rms = 0;
  double work_per_s = 0;      // row updates a simulated second
  int steps = 0, missed = 0;  // steps, those that missed their tolerance
  int most_outer = 0;         // outer iterations of a step
  pbd::Status status = pbd::Status::ok;
  std::string reason{};
};

/// Called with the state after each step.
using StateWatch = std::function<void(const pbd::State&)>;

/// `duration` s in steps of h, ended where a step diverges, a link doubles or the energy exceeds the largest
/// gain. Steps that miss their tolerance count against a method that claims to solve them.
DirectionRun simulate(const DirectionScene& scene, const pbd::Method& method, double h, double duration,
                      const StateWatch& watch = {});

}  // namespace pbdcheck
