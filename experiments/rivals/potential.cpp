#include "rivals/potential.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "error.h"

namespace pbd::rivals {
namespace {

template <class Groups, class Function>
void for_each(Groups& groups, const Function& function) {
  std::apply([&](auto&... group) { (function(group), ...); }, groups);
}

template <class Element>
Nodes<Element::nodes> gather(const Points& x, const std::array<int, Element::nodes>& node) {
  Nodes<Element::nodes> local;
  for (int a = 0; a < Element::nodes; ++a) local.col(a) = x.col(node[static_cast<std::size_t>(a)]);
  return local;
}

/// The sign of an element's value whose energy is half its square, and has this gradient: of what has two
/// sides.
template <class Element>
double side(const Element&, const Nodes<Element::nodes>&, const Nodes<Element::nodes>&) {
  return 1;
}
double side(const SpringElement&, const Nodes<2>& x, const Nodes<2>& gradient) {
  return gradient.col(1).dot(x.col(1) - x.col(0)) < 0 ? -1 : 1;
}
/// The angle falls where its third node goes along the normal there.
double side(const HingeElement&, const Nodes<4>& x, const Nodes<4>& gradient) {
  const Vec3 normal = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0));
  return gradient.col(2).dot(normal) > 0 ? -1 : 1;
}

/// Shape gradients and constants of a simplex from its edges at rest in D dimensions (m).
template <int D>
Simplex<D> simplex(const Eigen::Matrix<double, D, D>& edges, double lambda, double mu) {
  const double volume = edges.determinant() / (D == 2 ? 2 : 6);
  Simplex<D> result{{}, volume * lambda, volume * mu};
  result.shape.template rightCols<D>() = edges.inverse().transpose();
  result.shape.col(0) = -result.shape.template rightCols<D>().rowwise().sum();
  return result;
}

/// Edges from node 0 in the plane of a rest triangle, the first one along u.
Eigen::Matrix2d flat_edges(const Mat3& rest) {
  const Vec3 u = rest.col(1) - rest.col(0), other = rest.col(2) - rest.col(0);
  Eigen::Matrix2d edges;
  edges << u.norm(), u.dot(other) / u.norm(), 0, u.cross(other).norm() / u.norm();
  return edges;
}

/// Fills the groups from the scene's effects.
template <class Groups>
struct Builder {
  std::string rival;
  Groups& groups;

  template <class Element>
  Group<Element>& group() const {
    return std::get<Group<Element>>(groups);
  }
  template <class E>
  double constant(const E& effect, std::size_t i) const {
    if (effect.compliance[i] > 0) return 1 / effect.compliance[i];
    throw SetupError(rival + ": " + std::string(E::name) + " compliance[" + std::to_string(i) + "]", "0",
                     "a number > 0: no hard constraints");
  }

  void operator()(const Gravity&) const {}
  void operator()(const ExternalForce&) const {}
  /// Effects of rigid bodies, which no scene has here.
  template <class BodyEffect>
  void operator()(const BodyEffect&) const {}
  void operator()(const Anchor& e) const {
    for (std::size_t i = 0; i < e.node.size(); ++i)
      group<AnchorElement>().add({e.node[i]}, {e.target[i], constant(e, i)});
  }
  void operator()(const Distance& e) const {
    for (std::size_t i = 0; i < e.node.size(); ++i)
      group<SpringElement>().add(e.node[i], {e.rest_length[i], constant(e, i)});
  }
  void operator()(const Bending& e) const {
    for (std::size_t i = 0; i < e.node.size(); ++i)
      group<HingeElement>().add(e.node[i], {e.rest_angle[i], constant(e, i)});
  }
  void operator()(const TriangleStrain& e) const {
    if (std::isinf(e.material.young))
      throw SetupError(rival + ": triangle_strain young", "inf", "a finite number: no hard constraints");
    const double nu = e.material.poisson, k = e.thickness * e.material.young / (1 - nu * nu);
    for (std::size_t i = 0; i < e.node.size(); ++i)
      group<GreenElement<2>>().add(e.node[i], {simplex<2>(flat_edges(e.rest[i]), k * nu, k * (1 - nu) / 2)});
  }
  void operator()(const TetStrain& e) const {
    const double nu = e.material.poisson, mu = e.material.young / (2 * (1 + nu)),
                 lambda = 2 * mu * nu / (1 - 2 * nu);
    for (std::size_t i = 0; i < e.node.size(); ++i) {
      const auto tet = simplex<3>(e.rest[i].rightCols<3>().colwise() - e.rest[i].col(0), lambda, mu);
      switch (e.strain) {
        case Strain::green:
          group<GreenElement<3>>().add(e.node[i], {tet});
          break;
        case Strain::corotational:
          group<CorotationalElement>().add(e.node[i], {tet});
          break;
        case Strain::linear:
          group<LinearElement>().add(e.node[i], {tet});
          break;
      }
    }
  }
};

}  // namespace

Points acceleration(const Scene& scene) {
  Points a = Points::Zero(3, scene.nodes());
  for (const Effect& effect : scene.effects) {
    if (const auto* gravity = std::get_if<Gravity>(&effect)) a.colwise() += gravity->acceleration;
    if (const auto* external = std::get_if<ExternalForce>(&effect))
      for (std::size_t i = 0; i < external->node.size(); ++i)
        a.col(external->node[i]) +=
            external->force[i] / scene.mass[static_cast<std::size_t>(external->node[i])];
  }
  for (int node = 0; node < scene.nodes(); ++node)
    if (std::isinf(scene.mass[static_cast<std::size_t>(node)])) a.col(node).setZero();
  return a;
}

Potential::Potential(std::string_view rival, const Scene& scene, const std::vector<int>& block)
    : block_(block) {
  const std::string name(rival);
  if (!scene.bodies.empty())
    throw SetupError(name, std::to_string(scene.bodies.size()) + " rigid bodies", "nodes only");
  for (const Effect& effect : scene.effects) {
    if (damped(effect)) throw SetupError(name, "an effect with damping", "elastic effects");
    if (std::holds_alternative<Contact>(effect)) throw SetupError(name, "contact", "elastic effects");
    std::visit(Builder<decltype(groups_)>{name, groups_}, effect);
  }
}

std::vector<std::array<int, 2>> Potential::pairs() const {
  std::vector<std::array<int, 2>> pairs;
  for_each(groups_, [&](const auto& group) {
    for (const auto& node : group.node)
      for (const int a : node)
        for (const int b : node) {
          const int row = block_[static_cast<std::size_t>(a)], column = block_[static_cast<std::size_t>(b)];
          if (column >= 0 && row > column) pairs.push_back({row, column});
        }
  });
  return pairs;
}

void Potential::attach(const BlockCholesky& matrix) {
  for_each(groups_, [&]<class Element>(Group<Element>& group) {
    group.target.clear();
    for (const auto& node : group.node) {
      auto target = group.target.emplace_back().begin();
      const auto block = [&](int a) {
        return block_[static_cast<std::size_t>(node[static_cast<std::size_t>(a)])];
      };
      for (int a = 0; a < Element::nodes; ++a)
        for (int b = 0; b <= a; ++b, ++target) {
          *target = block(a) >= block(b) ? typename Group<Element>::Target{a, b, {}}
                                         : typename Group<Element>::Target{b, a, {}};
          if (block(target->b) >= 0) target->slot = matrix.slot(block(target->a), block(target->b));
        }
    }
  });
}

void Potential::attach_nodes(int nodes) {
  for_each(groups_, [&](auto& group) {
    group.first.assign(static_cast<std::size_t>(nodes) + 1, 0);
    const auto each_corner = [&](auto&& visit) {
      for (std::size_t i = 0; i < group.node.size(); ++i)
        for (std::size_t a = 0; a < group.node[i].size(); ++a)
          visit(static_cast<std::size_t>(group.node[i][a]), static_cast<int>(i), static_cast<int>(a));
    };
    each_corner([&](std::size_t node, int, int) { ++group.first[node + 1]; });
    std::partial_sum(group.first.begin(), group.first.end(), group.first.begin());
    group.corner.resize(static_cast<std::size_t>(group.first.back()));
    std::vector<int> next(group.first.begin(), group.first.end() - 1);
    each_corner([&](std::size_t node, int element, int local) {
      group.corner[static_cast<std::size_t>(next[node]++)] = {element, local};
    });
  });
}

void Potential::add_at(int node, const Points& x, Vec3& gradient, Mat3& stiffness) const {
  const auto own = static_cast<std::size_t>(node);
  for_each(groups_, [&]<class Element>(const Group<Element>& group) {
    for (int k = group.first[own]; k < group.first[own + 1]; ++k) {
      const auto& [i, a] = group.corner[static_cast<std::size_t>(k)];
      const auto element = static_cast<std::size_t>(i);
      const auto local = gather<Element>(x, group.node[element]);
      if constexpr (requires { group.element[element].add_at(local, a, gradient, stiffness); }) {
        group.element[element].add_at(local, a, gradient, stiffness);
      } else {
        Nodes<Element::nodes> slope;
        group.element[element].energy(local, slope);
        gradient += slope.col(a);
        stiffness += group.element[element].stiffness(local, false)(a, a);
      }
    }
  });
}

double Potential::energy(const Points& x, Points& gradient) const {
  double sum = 0;
  for_each(groups_, [&]<class Element>(const Group<Element>& group) {
    for (std::size_t i = 0; i < group.element.size(); ++i) {
      Nodes<Element::nodes> local;
      sum += group.element[i].energy(gather<Element>(x, group.node[i]), local);
      for (int a = 0; a < Element::nodes; ++a)
        gradient.col(group.node[i][static_cast<std::size_t>(a)]) += local.col(a);
    }
  });
  return sum;
}

void Potential::add_stiffness(const Points& x, bool projected, BlockCholesky& matrix) const {
  for_each(groups_, [&]<class Element>(const Group<Element>& group) {
    for (std::size_t i = 0; i < group.element.size(); ++i) {
      const auto block = group.element[i].stiffness(gather<Element>(x, group.node[i]), projected);
      for (const auto& [a, b, slot] : group.target[i])
        if (slot.first >= 0) matrix.add(slot, block(a, b));
    }
  });
}

std::size_t Potential::elements() const {
  std::size_t count = 0;
  for_each(groups_, [&](const auto& group) { count += group.element.size(); });
  return count;
}

void Potential::sweep(const Eigen::RowVectorXd& inverse_mass, double h, std::vector<double>& multiplier,
                      Points& x) const {
  const double compliance = 1 / (h * h);
  double* own = multiplier.data();
  for_each(groups_, [&]<class Element>(const Group<Element>& group) {
    for (std::size_t i = 0; i < group.element.size(); ++i, ++own) {
      const auto& node = group.node[i];
      const Nodes<Element::nodes> local = gather<Element>(x, node);
      Nodes<Element::nodes> slope;
      const double size = std::sqrt(2 * std::max(0.0, group.element[i].energy(local, slope)));
      if (size == 0 && *own == 0) continue;
      const double value = side(group.element[i], local, slope) * size;
      slope /= value != 0 ? value : 1;  // of the value; zero where the energy's own is
      double mobility = compliance;
      for (int a = 0; a < Element::nodes; ++a)
        mobility += inverse_mass(node[static_cast<std::size_t>(a)]) * slope.col(a).squaredNorm();
      const double change = -(value + compliance * *own) / mobility;
      *own += change;
      for (int a = 0; a < Element::nodes; ++a) {
        const int index = node[static_cast<std::size_t>(a)];
        x.col(index) += inverse_mass(index) * change * slope.col(a);
      }
    }
  });
}

bool Potential::quadratic() const {
  return std::get<Group<SpringElement>>(groups_).element.empty() &&
         std::get<Group<HingeElement>>(groups_).element.empty() &&
         std::get<Group<GreenElement<2>>>(groups_).element.empty() &&
         std::get<Group<GreenElement<3>>>(groups_).element.empty() &&
         std::get<Group<CorotationalElement>>(groups_).element.empty();
}

}  // namespace pbd::rivals
