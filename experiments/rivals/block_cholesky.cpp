#include "rivals/block_cholesky.h"

#include <omp.h>

#include <algorithm>

namespace pbd::rivals {
namespace {

/// Keeps CHOLMOD's loops on this thread while it lives: dividing them among threads makes factors of this
/// size several times slower, and no other method measured uses more than one.
class OneThread {
 public:
  OneThread() : levels_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;
  ~OneThread() { omp_set_max_active_levels(levels_); }

 private:
  int levels_;
};

}  // namespace

BlockCholesky::BlockCholesky(int blocks, std::vector<std::array<int, 2>> pairs) {
  for (int i = 0; i < blocks; ++i) pairs.push_back({i, i});
  for (auto& [row, column] : pairs) std::swap(row, column);  // to sort by columns
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

  start_.push_back(0);
  for (auto first = pairs.begin(); first != pairs.end();) {
    const auto last =
        std::find_if(first, pairs.end(), [&](const auto& pair) { return pair[0] != (*first)[0]; });
    for (int axis = 0; axis < 3; ++axis) {
      for (auto pair = first; pair != last; ++pair)
        for (int i = 0; i < 3; ++i) row_.push_back(3 * (*pair)[1] + i);
      start_.push_back(static_cast<int>(row_.size()));
    }
    first = last;
  }
  values_.setZero(static_cast<int>(row_.size()));

  matrix_.nrow = matrix_.ncol = 3 * static_cast<std::size_t>(blocks);
  matrix_.nzmax = row_.size();
  matrix_.p = start_.data();
  matrix_.i = row_.data();
  matrix_.x = values_.data();
  matrix_.stype = -1;
  matrix_.itype = CHOLMOD_INT;
  matrix_.xtype = CHOLMOD_REAL;
  matrix_.dtype = CHOLMOD_DOUBLE;
  matrix_.sorted = matrix_.packed = 1;
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal =
      CHOLMOD_AUTO;      // simplicial where supernodes would be small: chains, a few hundred nodes
  common_.final_ll = 1;  // so that the simplicial factor, too, fails unless positive definite
  common_.quick_return_if_not_posdef = 1;
  factor_ = cholmod_analyze(&matrix_, &common_);
}

BlockCholesky::~BlockCholesky() {
  for (cholmod_dense** dense : {&solution_, &work_y_, &work_e_}) cholmod_free_dense(dense, &common_);
  cholmod_free_factor(&factor_, &common_);
  cholmod_finish(&common_);
}

BlockCholesky::Slot BlockCholesky::slot(int row, int column) const {
  const auto first = row_.begin() + start_[3 * static_cast<std::size_t>(column)];
  const auto last = row_.begin() + start_[3 * static_cast<std::size_t>(column) + 1];
  return {static_cast<int>(std::lower_bound(first, last, 3 * row) - row_.begin()),
          static_cast<int>(last - first)};
}

// The diagonal block is the first one of its columns.
void BlockCholesky::reset(const Eigen::VectorXd& diagonal) {
  values_.setZero();
  for (int i = 0; i < diagonal.size(); ++i)
    values_(start_[static_cast<std::size_t>(i)] + i % 3) = diagonal(i);
}

Eigen::VectorXd BlockCholesky::diagonal() const {
  Eigen::VectorXd d(static_cast<int>(matrix_.ncol));
  for (int i = 0; i < d.size(); ++i) d(i) = values_(start_[static_cast<std::size_t>(i)] + i % 3);
  return d;
}

bool BlockCholesky::factorise() {
  const OneThread one_thread;
  return cholmod_factorize(&matrix_, factor_, &common_) && common_.status == CHOLMOD_OK;
}

Eigen::Map<const Eigen::VectorXd> BlockCholesky::solve(Eigen::VectorXd& right) {
  const OneThread one_thread;
  cholmod_dense b{};
  b.nrow = b.nzmax = b.d = matrix_.ncol;
  b.ncol = 1;
  b.x = right.data();
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  cholmod_solve2(CHOLMOD_A, factor_, &b, nullptr, &solution_, nullptr, &work_y_, &work_e_, &common_);
  return {static_cast<const double*>(solution_->x), static_cast<Eigen::Index>(matrix_.ncol)};
}

}  // namespace pbd::rivals
