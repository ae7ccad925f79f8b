#include "studies/accuracy/soft_chain.h"

#include <cmath>
#include <stdexcept>

#include "dense.h"
#include "scenes/standard.h"

namespace pbdcheck {

using namespace pbd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const Distance& hung_links(const Scene& scene) {
  for (const auto& effect : scene.effects)
    if (const auto* links = std::get_if<Distance>(&effect)) return *links;
  throw std::logic_error("a scene without links");
}

}  // namespace

Scene hanging_chain(int links, double compliance) {
  Scene scene = chain(links);
  scene.initial.x.row(2) = -scene.initial.x.row(0);
  scene.initial.x.row(0).setZero();
  std::get<Distance>(scene.effects.back()).compliance.assign(static_cast<std::size_t>(links), compliance);
  return scene;
}

double predicted_stretch(const Scene& chain, double h, int sweeps, double factor) {
  const Distance& links = hung_links(chain);
  const auto count = static_cast<Eigen::Index>(links.node.size());
  MatrixXd delassus = MatrixXd::Zero(count, count);
  VectorXd sigma(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto link = static_cast<std::size_t>(i);
    const double above = 1 / chain.mass[link], below = 1 / chain.mass[link + 1];
    delassus(i, i) = above + below;
    if (i > 0) delassus(i, i - 1) = delassus(i - 1, i) = -above;
    sigma[i] = links.compliance[link] / (h * h);
  }
  MatrixXd whole = delassus;
  whole.diagonal() += sigma;
  MatrixXd swept = whole.triangularView<Eigen::Lower>();
  swept.diagonal() /= factor;
  const MatrixXd unit = MatrixXd::Identity(count, count);
  const MatrixXd once = unit - reference::product(whole, reference::inverse(swept));
  MatrixXd power = unit;
  for (int k = 0; k < sweeps; ++k) power = reference::product(once, power);
  const MatrixXd left =
      unit - reference::product(delassus, reference::product(reference::inverse(whole), unit - power));
  const VectorXd opened = h * h * gravity * left.col(0);
  return reference::solve(MatrixXd(unit - left), opened).sum();
}

double physical_stretch(const Scene& chain) {
  const Distance& links = hung_links(chain);
  double hanging = 0, stretch = 0;
  for (std::size_t i = links.node.size(); i-- > 0;) {
    hanging += chain.mass[i + 1];
    stretch += hanging * gravity * links.compliance[i];
  }
  return stretch;
}

void classic_step(const Scene& scene, double h, int sweeps, double factor, State& state) {
  const Distance& links = hung_links(scene);
  const Points before = state.x;
  for (int node = 0; node < scene.nodes(); ++node)
    if (std::isfinite(scene.mass[static_cast<std::size_t>(node)]))
      state.x.col(node) += h * state.v.col(node) - h * h * gravity * Vec3::UnitZ();
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t i = 0; i < links.node.size(); ++i) {
      const auto [a, b] = links.node[i];
      const double wa = 1 / scene.mass[static_cast<std::size_t>(a)];
      const double wb = 1 / scene.mass[static_cast<std::size_t>(b)];
      const Vec3 apart = state.x.col(b) - state.x.col(a);
      const Vec3 pull = factor * (1 - links.rest_length[i] / apart.norm()) / (wa + wb) * apart;
      state.x.col(a) += wa * pull;
      state.x.col(b) -= wb * pull;
    }
  state.v = (state.x - before) / h;
  state.time += h;
}

}  // namespace pbdcheck
