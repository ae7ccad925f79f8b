#include "planar_chain.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "dense.h"
#include "energies.h"
#include "error.h"

namespace pbd::reference {
namespace {

constexpr double rounding = 1e-12;  // of input, relative

using Eigen::VectorXd;

std::string text(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.3g", value);
  return digits;
}

/// At every bob, the sum over the links above it of factor_i d(q_i).
Eigen::Matrix2Xd summed(const VectorXd& angle, const VectorXd& factor) {
  Eigen::Matrix2Xd sum(2, angle.size());
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  for (int i = 0; i < angle.size(); ++i) {
    at += factor(i) * Eigen::Vector2d(std::cos(angle(i)), std::sin(angle(i)));
    sum.col(i) = at;
  }
  return sum;
}

/// Nodes from the fixed one along the links, and each link's element.
struct Order {
  std::vector<int> node;
  std::vector<const Element*> link;
};

Order order_of(const Scene& scene, const Model& model) {
  std::vector<std::vector<const Element*>> at(scene.mass.size());
  for (const Element& e : model.elements) {
    const std::string where = "effects[" + std::to_string(e.effect) + "]";
    if (e.kind != Kind::distance)
      throw SetupError(where, "another effect than links", "distance links alone");
    if (!e.hard()) throw SetupError(where, "a compliant link among hard ones", "hard links alone");
    for (int a = 0; a < 2; ++a) at[e.node[a]].push_back(&e);
  }
  const auto fixed = [&](std::size_t node) { return std::isinf(scene.mass[node]); };
  Order order;
  for (std::size_t node = 0; node < at.size(); ++node) {
    const std::string where = "node " + std::to_string(node);
    if (at[node].empty()) throw SetupError(where, "no link", "nodes of one chain");
    if (at[node].size() > (fixed(node) ? 1 : 2))
      throw SetupError(where, std::to_string(at[node].size()) + " links",
                       "an open chain: two links, or one at the node it hangs from");
    if (!fixed(node)) continue;
    if (!order.node.empty()) throw SetupError(where, "another node of infinite mass", "one, to hang from");
    if (!scene.initial.v.col(node).isZero(0)) throw SetupError(where, "a moving support", "one at rest");
    order.node.push_back(static_cast<int>(node));
  }
  if (order.node.empty()) throw SetupError("mass", "finite masses alone", "one of infinity, to hang from");
  for (;;) {
    const int here = order.node.back();
    const auto& links = at[here];
    const auto next = std::find_if(links.begin(), links.end(), [&](const Element* e) {
      return order.link.empty() || e != order.link.back();
    });
    if (next == links.end()) break;
    order.link.push_back(*next);
    order.node.push_back((*next)->node[0] == here ? (*next)->node[1] : (*next)->node[0]);
  }
  if (order.node.size() != at.size())
    throw SetupError("links", std::to_string(order.node.size() - 1) + " nodes hung from the support",
                     "all others, " + std::to_string(at.size() - 1));
  return order;
}

/// Orthonormal basis of the plane of all columns, each group relative to its largest.
Eigen::Matrix<double, 3, 2> common_plane(const std::vector<Points>& groups) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  std::vector<Points> scaled;
  for (const Points& group : groups)
    if (const double largest = group.cwiseAbs().maxCoeff(); largest > 0) {
      scaled.emplace_back(group / largest);
      sum += scaled.back() * scaled.back().transpose();
    }
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors();
  double outside = 0;
  for (const Points& group : scaled)
    outside = std::max(outside, (axes.col(0).transpose() * group).cwiseAbs().maxCoeff());
  if (outside > rounding)
    throw SetupError("links, velocities and forces", text(outside) + " of their size out of a plane",
                     "planar motion");
  return axes.rightCols<2>();
}

}  // namespace

VectorXd PlanarChain::acceleration(const VectorXd& angle, const VectorXd& rate) const {
  const int n = links();
  const VectorXd c = angle.array().cos(), s = angle.array().sin();
  Eigen::MatrixXd inertia(n, n);
  VectorXd load = VectorXd::Zero(n);
  Eigen::Vector2d force_below = Eigen::Vector2d::Zero();
  double mass_below = 0;
  for (int i = n - 1; i >= 0; --i) {
    force_below += force.col(i), mass_below += mass(i);
    load(i) += length(i) * (c(i) * force_below.y() - s(i) * force_below.x());
    for (int j = 0; j <= i; ++j)
      inertia(i, j) = inertia(j, i) = mass_below * length(i) * length(j) * (c(i) * c(j) + s(i) * s(j));
    for (int j = 0; j < i; ++j) {
      const double gyration = mass_below * length(i) * length(j) * (s(i) * c(j) - c(i) * s(j));
      load(i) -= gyration * rate(j) * rate(j);
      load(j) += gyration * rate(i) * rate(i);
    }
  }
  return solve_definite(inertia, load);
}

Eigen::Matrix2Xd PlanarChain::positions(const VectorXd& angle) const {
  return summed(angle, length);
}

Eigen::Matrix2Xd PlanarChain::velocities(const VectorXd& angle, const VectorXd& rate) const {
  const Eigen::Matrix2Xd turned = summed(angle, length.cwiseProduct(rate));
  Eigen::Matrix2Xd v(2, turned.cols());
  v << -turned.row(1), turned.row(0);
  return v;
}

State HungChain::state(const State& initial, double time, const VectorXd& at, const VectorXd& turning) const {
  State state = initial;
  state.time += time;
  const Points x = plane * chain.positions(at), v = plane * chain.velocities(at, turning);
  for (int i = 0; i < chain.links(); ++i) {
    const int below = node[i + 1];
    state.x.col(below) = initial.x.col(node[0]) + x.col(i);
    state.v.col(below) = v.col(i);
  }
  return state;
}

HungChain hung_chain(const Scene& scene) {
  const Model model = make_model(scene);
  const Order order = order_of(scene, model);
  const int n = static_cast<int>(order.link.size());
  HungChain hung;
  hung.node = order.node;
  hung.chain.mass.resize(n), hung.chain.length.resize(n), hung.angle.resize(n), hung.rate.resize(n);
  Points link(3, n), turning(3, n), force(3, n);  // along each link, change of velocity along it, on its bob
  for (int i = 0; i < n; ++i) {
    const int above = order.node[i], below = order.node[i + 1];
    hung.chain.mass(i) = scene.mass[below];
    hung.chain.length(i) = order.link[i]->rest(0);
    link.col(i) = scene.initial.x.col(below) - scene.initial.x.col(above);
    turning.col(i) = scene.initial.v.col(below) - scene.initial.v.col(above);
    force.col(i) = model.force.segment<3>(model.first[below]);
  }
  const double extent = hung.chain.length.sum(), speed = scene.initial.v.cwiseAbs().maxCoeff();
  for (int i = 0; i < n; ++i) {
    const std::string where = "link above node " + std::to_string(order.node[i + 1]);
    const double longer = link.col(i).norm() - hung.chain.length(i);
    if (std::abs(longer) > rounding * extent)
      throw SetupError(where, text(longer) + " m longer than its rest length",
                       "links that start at rest length");
    const double growing = turning.col(i).dot(link.col(i)) / hung.chain.length(i);
    if (std::abs(growing) > rounding * speed)
      throw SetupError(where, text(growing) + " m/s of lengthening", "velocities that keep the lengths");
  }
  hung.plane = common_plane({link, turning, force});
  hung.chain.force = hung.plane.transpose() * force;
  const Eigen::Matrix2Xd along = hung.plane.transpose() * link, across = hung.plane.transpose() * turning;
  for (int i = 0; i < n; ++i) {
    hung.angle(i) = std::atan2(along(1, i), along(0, i));
    const Eigen::Vector2d normal(-std::sin(hung.angle(i)), std::cos(hung.angle(i)));
    hung.rate(i) = normal.dot(across.col(i)) / hung.chain.length(i);
  }
  return hung;
}

}  // namespace pbd::reference
