#include "outer/metric_contacts.h"

#include <algorithm>

#include "rows/laws.h"

namespace pbd {
namespace {

/// f(block, i) for every contact: the rows that are not eliminated are no others.
template <class F>
void each_contact(Rows& rows, const std::vector<bool>& eliminated, F&& f) {
  for (std::size_t b = 0; b < rows.blocks.size(); ++b) {
    if (eliminated[b]) continue;
    std::visit(
        [&]<class Block>(Block& block) {
          if constexpr ((Block::rows == 1 || Block::rows == 3) && !is_local<Block>)
            for (std::size_t i = 0; i < block.size(); ++i) f(block, i);
        },
        rows.blocks[b]);
  }
}

template <class Block>
bool asks(const Block& block, std::size_t i, const Points& v) {
  const auto r = block.residual(v, i, block.impulse[i]);
  return !allowed(block, i, block.impulse[i], -block.inverse_diagonal[i] * r).isZero(0);
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

/// States the local problem of the contacts that take part, where its impulses are the rows' and the nodes go
/// with v without them.
void MetricContacts::couple(Rows& rows, const std::vector<bool>& eliminated, const Metric& metric,
                            const Points& v) {
  if (local_.blocks.empty()) local_.blocks.add(LocalContacts{});
  auto& local = std::get<LocalContacts>(local_.blocks.front());
  const auto count = static_cast<std::size_t>(std::count(engaged_.begin(), engaged_.end(), true));
  local.resize_contacts(count);
  local.column.resize(count);
  coupled_.resize(count);
  velocity_.resize(3, static_cast<Eigen::Index>(count));
  local_.inverse_mass.assign(count, 0);
  local_.contacts = true;
  ++local_.generation;
  inverse_.begin(metric, most_nodes * count);
  std::size_t next = 0, k = 0;
  each_contact(rows, eliminated, [&]<class Block>(const Block& block, std::size_t i) {
    if (!engaged_[next++]) return;
    constexpr int R = Block::rows;  // without friction the tangential rows are zero
    local.node[k] = {static_cast<int>(k)};
    local.jacobian[k].setIdentity();
    local.bias[k].setZero();
    local.bias[k].template head<R>() = block.bias[i];
    local.compliance[k].setZero();
    local.compliance[k].template topLeftCorner<R, R>() = block.compliance[i];
    local.impulse[k].setZero();
    local.impulse[k].template head<R>() = block.impulse[i];
    local.bounds[k] = block.bounds[i];
    local.friction[k] = block.frictional() ? block.friction[i] : 0;
    local.law = block.law;
    velocity_.col(static_cast<Eigen::Index>(k)).setZero();
    velocity_.col(static_cast<Eigen::Index>(k)).template head<R>() = block.jacobian[i] * block.gather(v, i);
    Coupled& coupled = coupled_[k++];
    coupled.nodes = 0;
    for (int a = 0; a < Block::nodes; ++a) {
      const int node = block.node[i][a];
      if (!(rows.inverse_mass[node] > 0)) continue;
      coupled.place[coupled.nodes] = inverse_.place(metric, node);
      Eigen::Matrix3d& jacobian = coupled.jacobian[coupled.nodes++];
      jacobian.setZero();
      jacobian.topRows<R>() = block.jacobian[i].template middleCols<3>(3 * a) * metric.rotation(node);
    }
  });
}

/// W = J P^-1 J^T, one contact's column after the other.
void MetricContacts::find_delassus(LocalContacts& local) {
  for (auto& column : local.column) column.clear();
  places_.clear();
  for (const Coupled& own : coupled_)
    for (int a = 0; a < own.nodes; ++a) places_.push_back(own.place[a]);
  std::sort(places_.begin(), places_.end());
  places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  pushed_.resize(inverse_.places());
  for (std::size_t j = 0; j < coupled_.size(); ++j) {
    for (const int place : places_) {
      Eigen::Matrix3d& pushed = pushed_[place];
      pushed.setZero();
      for (int b = 0; b < coupled_[j].nodes; ++b)
        pushed.noalias() += inverse_.block(place, coupled_[j].place[b]) * coupled_[j].jacobian[b].transpose();
    }
    for (std::size_t i = j; i < coupled_.size(); ++i) {
      Eigen::Matrix3d w = Eigen::Matrix3d::Zero();  // of i by j
      for (int a = 0; a < coupled_[i].nodes; ++a)
        w.noalias() += coupled_[i].jacobian[a] * pushed_[coupled_[i].place[a]];
      if (w.isZero(0)) continue;
      local.column[j].push_back({static_cast<int>(i), w});
      if (i != j) local.column[i].push_back({static_cast<int>(j), w.transpose()});
    }
  }
  for (std::size_t i = 0; i < coupled_.size(); ++i) {
    Eigen::Matrix3d& own = local.delassus[i];
    own = local.compliance[i];
    for (const auto& [contact, w] : local.column[i])
      if (contact == static_cast<int>(i)) own += w;
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
    if (coupled_.empty()) break;
    auto& local = std::get<LocalContacts>(local_.blocks.front());
    find_delassus(local);
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
