// The energy of a scene and its hard constraints, from the value of every effect alone; derivatives are
// automatic.
//
//   U(x)             = sum over compliant constraints of 1/2 c^T A^-1 c
//   L(x, gamma, rho) = U(x) - gamma^T c_hard(x) + sum_i rho_i/2 c_hard,i^2
//
// The hard constraints are c_hard(x) = 0; the forces f, gravity and external ones, are kept beside L.
//
// gamma (N for lengths) is the force of a hard constraint along its direction, J^T gamma the force on the
// nodes. For a compliant one the force is -A^-1 c. Every constraint is a function of a small matrix F = sum_a
// x_a w_a^T (see constraint_values.h), so derivatives are taken by F and chained with the constant w.
#pragma once

#include <array>
#include <vector>

#include "scene.h"
#include "sparse.h"

namespace pbd::reference {

/// Rows and variables of one constraint: at most 6 rows and 9 entries of F, without allocation.
using RowVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using LocalVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1>;
using LocalMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 9>;

enum class Kind { anchor, distance, bending, triangle, green, linear, corotational };

/// One constraint with its rest quantities, derived here from the scene's rest positions.
struct Element {
  Kind kind = Kind::anchor;
  int effect = 0, entry = 0;             // position in the scene
  int nodes = 1, columns = 1, rows = 1;  // K, Q, R
  std::array<int, 4> node{};             // first K used
  Eigen::Matrix<double, 4, 3> weight;    // w, K x Q used (1 or 1/m)
  Vec3 rest = Vec3::Zero();              // target (m), rest length (m) or rest angle (rad)
  RowMatrix stiffness;                   // A^-1, R x R, zero for a hard constraint
  int first_row = -1;                    // among the hard rows; -1 for a compliant constraint
  bool turns = false;                    // of corotational ones: forces act along dc/dx, not with R fixed

  bool hard() const { return first_row >= 0; }
  int variables() const { return 3 * columns; }
};

/// Value (R) and derivatives (R x 3Q, and R of 3Q x 3Q) of a constraint by the entries of F in column order.
struct Local {
  RowVector value;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 9> jacobian;
  std::array<LocalMatrix, 6> hessian;
};

/// A scene's constraints, forces and numbering of unknowns. Nodes of infinite mass have no unknowns.
struct Model {
  std::vector<Element> elements;  // in the scene's order
  int hard_rows = 0;
  int unknowns = 0;        // 3 per node of finite mass
  std::vector<int> first;  // per node: its first unknown, or -1
  Vector mass;             // per unknown, kg
  Vector force;            // gravity and external forces per unknown, N

  /// First unknown of an element's node a, or -1.
  int unknown(const Element& element, int a) const { return first[element.node[a]]; }
};

/// Isotropic elasticity matrix with engineering shear, Pa; the same of plane stress, times thickness, N/m.
Eigen::Matrix<double, 6, 6> elasticity(const Material& material);
Eigen::Matrix3d membrane(const Material& material, double thickness);

/// Throws SetupError for a scene that `validate` refuses, with rigid bodies, or without a node of finite
/// mass.
Model make_model(const Scene& scene);
/// The nodes' part of a scene that may have rigid bodies, and that may have no node of finite mass.
Model make_node_model(const Scene& scene);

/// Unknowns of positions x, and positions with their unknowns replaced (nodes of infinite mass from `x`).
Vector gather(const Model& model, const Points& x);
Points scatter(const Model& model, const Points& x, const Vector& unknowns);

/// F of an element, 3 x Q used.
Eigen::Matrix3d local_matrix(const Element& element, const Points& x);

/// Constraint value c(x), R entries.
RowVector constraint_value(const Element& element, const Points& x);
void differentiate(const Element& element, const Points& x, Local& local);
/// Without the Hessians, which it leaves as they are.
void differentiate_once(const Element& element, const Points& x, Local& local);

/// Multipliers and penalties of the hard rows; empty vectors mean zero.
struct Multipliers {
  Vector gamma;  // N for lengths
  Vector rho;    // N/m for lengths
};

/// L at x (J).
double lagrangian(const Model& model, const Points& x, const Multipliers& multipliers);

/// Force-like factors of an element's rows, dL/dc: A^-1 c, or rho c - gamma for a hard one.
RowVector stress(const Element& element, const RowVector& c, const Multipliers& multipliers);
/// The element's part of L (J).
double energy(const Element& element, const RowVector& c, const Multipliers& multipliers);

}  // namespace pbd::reference
