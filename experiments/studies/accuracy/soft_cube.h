// A soft cube at rest on the ground, under a plate or under its own weight alone, as elements and as springs.
//
// 0.2 m, 1000 kg/m^3, E = 1e5 Pa. Between frictionless plates the stress is uniaxial, but for its own weight
// m g even, of the mean P = (W + m g/2)/A under a plate of the weight W. A corotational strain is the stretch
// less 1, so that large strains change nothing of
//
//   sag = L P/E,   bulge = nu P/E   (mean widening at half the height, over the width)
#pragma once

#include "harness/judges.h"
#include "studies/accuracy/spring_network.h"

namespace pbdcheck {

struct CubeCase {
  Model model = Model::elements;
  int n = 2;  // cells along an edge, even
  double poisson = 0.3;
  double friction = 0;
  bool plate = true;
};

constexpr double soft_cube_side = 0.2;   // m
constexpr double soft_cube_young = 1e5;  // Pa
constexpr double plate_strain = 0.05;    // what the plate's weight alone presses the cube by
/// N, of the plate and of the cube.
double plate_weight();
double cube_weight();

struct SoftCube {
  pbd::TetMesh mesh;
  pbd::Scene scene;
  int first = 0;  // node of the mesh in the scene
};
SoftCube soft_cube(const CubeCase& each, double kappa);

/// At rest, which implicit Euler reaches by steps so long that each leaves little of the way. The tolerance
/// bounds what a step's velocities are off by in the metric of masses, and so by h tolerance scale/sqrt(m)
/// the place of a node of mass m. The judge leaves some steps open, refusing an overlap of 1e-14 m of its
/// own; where it solved none, or was not asked, `off_judge` is NaN.
struct Resting {
  double sag = 0, bulge = 0;  // m, and over the width
  double ground = 0;          // N, carried by the ground
  double off_judge = 0;  // sum over the steps of how far each ends from the judge's solution, over the sag
  double allowed = 0;    // what the tolerance leaves of that
  int judged_steps = 0;  // that the judge solved
  std::int64_t rows = 0, sweeps = 0;
  int steps = 0;
  pbd::Status status = pbd::Status::ok;
  std::string reason{};
};
Resting rest(const SoftCube& cube, const pbd::Method& method, bool judge);

}  // namespace pbdcheck
