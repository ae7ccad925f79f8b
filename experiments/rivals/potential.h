// The elastic energy of a scene, its gradient and its stiffness, element by element.
#pragma once

#include <string_view>
#include <tuple>

#include "rivals/block_cholesky.h"
#include "rivals/solids.h"

namespace pbd::rivals {

/// All elements of one kind. The elements' nodes, where the blocks of their stiffness go, and which of them a
/// node has.
template <class Element>
struct Group {
  static constexpr std::size_t nodes = Element::nodes;
  struct Target {
    int a, b;  // local nodes; a's block row is not above b's
    BlockCholesky::Slot slot;
  };
  std::vector<Element> element;
  std::vector<std::array<int, nodes>> node;
  std::vector<std::array<Target, nodes*(nodes + 1) / 2>> target;
  struct Corner {
    int element, local;
  };
  std::vector<Corner> corner;  // node after node
  std::vector<int> first;      // of a node's corners; one more at the end

  void add(const std::array<int, nodes>& nodes_of_it, const Element& it) {
    node.push_back(nodes_of_it);
    element.push_back(it);
  }
};

/// Acceleration of every node by gravity and external forces, m/s^2; zero for infinite mass.
Points acceleration(const Scene& scene);

class Potential {
 public:
  /// Throws SetupError, in the name of a rival, for a constraint of compliance 0. `block` is the block row of
  /// each node, -1 for none.
  Potential(std::string_view rival, const Scene& scene, const std::vector<int>& block);

  /// Pairs of block rows that an element connects, the larger one first.
  std::vector<std::array<int, 2>> pairs() const;
  /// Makes ready for adding to this matrix.
  void attach(const BlockCholesky& matrix);

  /// U(x) in J; adds its gradient (N).
  double energy(const Points& x, Points& gradient) const;
  /// Adds d2U/dx2 (N/m), every element's part made positive semidefinite if `projected`.
  void add_stiffness(const Points& x, bool projected, BlockCholesky& matrix) const;
  std::size_t elements() const;
  /// Makes ready for `add_at`.
  void attach_nodes(int nodes);
  /// Adds dU/dx (N) and d2U/dx2 (N/m) of one node.
  void add_at(int node, const Points& x, Vec3& gradient, Mat3& stiffness) const;
  /// A sweep of XPBD (xpbd.h) over all elements, with the inverse masses of the nodes (1/kg).
  void sweep(const Eigen::RowVectorXd& inverse_mass, double h, std::vector<double>& multiplier,
             Points& x) const;
  /// Whether d2U/dx2 is the same at every x.
  bool quadratic() const;

 private:
  std::vector<int> block_;
  std::tuple<Group<AnchorElement>, Group<SpringElement>, Group<HingeElement>, Group<GreenElement<2>>,
             Group<GreenElement<3>>, Group<CorotationalElement>, Group<LinearElement>>
      groups_;
};

}  // namespace pbd::rivals
