// What planted contact problems are drawn from: random numbers, and impulses and velocities that obey a law.
#pragma once

#include <random>
#include <vector>

#include "planted_cones.h"

namespace pbd::reference::planted {

/// The same numbers everywhere: the standard library's distributions differ between libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double between(double low, double high);
  double decades(double low, double high);
  Eigen::Vector2d direction();
  Eigen::Vector3d vector();  // each component between -1 and 1

 private:
  std::mt19937_64 generator_;
};

enum class ContactState { sticking, sliding, separated, both_zero };

/// r* (N s) and u* (m/s) of one contact obeying the law.
struct Planted {
  Eigen::Vector3d r = Eigen::Vector3d::Zero(), u = Eigen::Vector3d::Zero();
};
Planted plant(FrictionLaw law, ContactState state, double mu, double size, Random& random);

/// Contacts in every state by turns, with the share of both_zero last.
std::vector<Planted> plant_all(FrictionLaw law, const Eigen::VectorXd& friction, double both_zero,
                               Random& random);

/// Coefficients of friction between 0.1 and 1.
Eigen::VectorXd frictions(int contacts, Random& random);

/// The problem of W = J M^-1 J^T that these impulses and velocities solve.
PlantedCone finish(const SparseMatrix& jacobian, const Eigen::VectorXd& inverse_mass,
                   Eigen::VectorXd friction, const std::vector<Planted>& planted);

// Families of small problems (planted_cones.h), of boxes.
PlantedCone two_boxes(FrictionLaw law, std::uint64_t seed);
PlantedCone heavy_top(FrictionLaw law, std::uint64_t seed);
PlantedCone wedge(FrictionLaw law, std::uint64_t seed);

}  // namespace pbd::reference::planted
