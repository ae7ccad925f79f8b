#include "outer/metric_contacts.h"

#include <algorithm>
#include <utility>

#include "outer/dual_contacts.h"
#include "rows/laws.h"

namespace pbd {
namespace {

template <class Block>
bool asks(const Block& block, std::size_t i, const Points& v) {
  const auto r = block.residual(v, i, block.impulse[i]);
  return !allowed(block, i, block.impulse[i], -block.by_inverse_diagonal(i, r)).isZero(0);
}

}  // namespace

std::int64_t MetricContacts::pressed(Rows& rows, const std::vector<bool>& eliminated, const Points& v) {
  std::int64_t count = 0;
  each_contact(rows, eliminated, [&](const auto& block, std::size_t i) {
    count += !block.impulse[i].isZero(0) || asks(block, i, v);
  });
  return count;
}

/// Lets contacts take part whose law asks for an impulse at v; true if there are any that did not.
bool MetricContacts::engage(Rows& rows, const std::vector<bool>& eliminated, const Points& v) {
  bool any = false;
  std::size_t k = 0;
  each_contact(rows, eliminated, [&](const auto& block, std::size_t i) {
    if (!engaged_[k] && asks(block, i, v)) any = engaged_[k] = true;
    ++k;
  });
  return any;
}

/// Sets `node_` to what can move of the contacts that take part: of each something, or its law asked for
/// nothing.
void MetricContacts::place_nodes(Rows& rows, const std::vector<bool>& eliminated, const Metric& metric) {
  node_.clear();
  number_.assign(rows.inverse_mass.size(), -1);
  std::size_t next = 0;
  each_contact(rows, eliminated, [&](const auto& block, std::size_t i) {
    if (!engaged_[next++]) return;
    for (const int node : block.node[i])
      if (rows.inverse_mass[node] > 0 && std::exchange(number_[node], 0) < 0) node_.push_back(node);
  });
  inverse_.begin(metric, node_.size());
  order_.clear();
  for (const int node : node_) {
    const int place = inverse_.place(metric, node);
    order_.push_back({inverse_.root(place), place, node});
  }
  std::sort(order_.begin(), order_.end());
  place_.clear();
  node_.clear();
  for (const auto& [root, place, node] : order_) {
    number_[node] = static_cast<int>(node_.size());
    place_.push_back(place);
    node_.push_back(node);
  }
}

void MetricContacts::find_response(LocalContacts& local) const {
  local.clear_response();
  for (std::size_t first = 0, end = 0; first < place_.size(); first = end) {
    const int root = inverse_.root(place_[first]);
    while (end < place_.size() && inverse_.root(place_[end]) == root) ++end;
    for (std::size_t b = first; b < end; ++b) {
      auto moved = local.add_run(static_cast<int>(first), static_cast<int>(end - first));
      for (std::size_t a = first; a < end; ++a)
        moved.middleRows<3>(3 * static_cast<Eigen::Index>(a - first)) = inverse_.block(place_[a], place_[b]);
      local.end_node();
    }
  }
}

/// States the local problem of the contacts that take part, where its impulses are the rows' and the nodes go
/// with v without them.
void MetricContacts::couple(Rows& rows, const std::vector<bool>& eliminated, const Metric& metric,
                            const Points& v) {
  if (local_.blocks.empty()) local_.blocks.add(LocalContacts{});
  auto& local = std::get<LocalContacts>(local_.blocks.front());
  local.resize_contacts(static_cast<std::size_t>(std::count(engaged_.begin(), engaged_.end(), true)));
  place_nodes(rows, eliminated, metric);
  find_response(local);
  local_.inverse_mass.assign(node_.size(), 0);
  local_.contacts = true;
  ++local_.generation;
  velocity_.resize(3, static_cast<Eigen::Index>(node_.size()));
  for (std::size_t k = 0; k < node_.size(); ++k)
    velocity_.col(static_cast<Eigen::Index>(k)) = metric.rotation(node_[k]).transpose() * v.col(node_[k]);
  std::size_t next = 0, k = 0;
  each_contact(rows, eliminated, [&]<class Block>(const Block& block, std::size_t i) {
    if (!engaged_[next++]) return;
    constexpr int R = Block::rows;  // without friction the tangential rows are zero
    const typename Block::Jacobian& jacobian = block.jacobian[i];
    local.node[k].fill(0);
    local.jacobian[k].setZero();
    local.bias[k].setZero();
    local.bias[k].template head<R>() = block.bias[i];
    local.compliance.set(k, block.compliance[i](0, 0));
    local.impulse[k].setZero();
    local.impulse[k].template head<R>() = block.impulse[i];
    local.bounds[k] = block.bounds[i];
    local.friction[k] = block.frictional() ? block.friction[i] : 0;
    local.law = block.law;
    for (int a = 0; a < Block::nodes; ++a) {
      const int node = block.node[i][a], number = number_[node];
      const auto directions = jacobian.template middleCols<3>(3 * a);
      if (number < 0) {  // it goes as it is told to
        local.bias[k].template head<R>() += directions * v.col(node);
        continue;
      }
      local.node[k][a] = number;
      local.jacobian[k].template block<R, 3>(0, 3 * a) = directions * metric.rotation(node);
    }
    ++k;
  });
  find_diagonal(local);
}

/// Of W = J P^-1 J^T and the compliance, the contacts' own blocks.
void MetricContacts::find_diagonal(LocalContacts& local) {
  for (std::size_t i = 0; i < local.size(); ++i) {
    Eigen::Matrix3d& own = local.delassus[i];
    own = Eigen::Matrix3d(local.compliance[i]) + local.own_coupling(i);
    const bool tangential = own(1, 1) > 0;
    if (!tangential) own = own(0, 0) * Eigen::Matrix3d::Identity();
    const double trace = own.trace();
    local.inverse_diagonal[i] = (trace > 0 ? 3 / trace : 0) * Eigen::Matrix3d::Identity();
    if (!(trace > 0)) local.bounds[i].freedom = Freedom::held;  // nothing that it touches can move
  }
}

std::int64_t MetricContacts::solve(LinearSolver& solver, Rows& rows, const std::vector<bool>& eliminated,
                                   Metric& metric, bool fresh, const InnerBudget& budget, Points& v) {
  engaged_.clear();
  each_contact(rows, eliminated,
               [&](const auto& block, std::size_t i) { engaged_.push_back(!block.impulse[i].isZero(0)); });
  engage(rows, eliminated, v);
  start_ = v;
  std::int64_t sweeps = 0;
  do {
    couple(rows, eliminated, metric, start_);
    auto& local = std::get<LocalContacts>(local_.blocks.front());
    if (local.size() == 0) break;
    apply_impulses(local_, velocity_);
    sweeps += relax(solver, local_, velocity_, fresh, budget, nullptr);
    fresh = true;
    force_.setZero(3, v.cols());
    std::size_t next = 0, k = 0;
    each_contact(rows, eliminated, [&]<class Block>(Block& block, std::size_t i) {
      if (!engaged_[next++]) return;
      block.impulse[i] = local.impulse[k++].template head<Block::rows>();
      const typename Block::Velocities push = block.jacobian[i].transpose() * block.impulse[i];
      for (int a = 0; a < Block::nodes; ++a) force_.col(block.node[i][a]) += push.template segment<3>(3 * a);
    });
    metric.solve(force_, push_);
    v = start_ + push_;
  } while (engage(rows, eliminated, v));
  return sweeps;
}

}  // namespace pbd
