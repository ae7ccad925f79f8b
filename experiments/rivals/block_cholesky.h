// Sparse symmetric matrix of 3 x 3 blocks and its Cholesky factor L L^T, by CHOLMOD's supernodal
// factorisation.
#pragma once

#include <cholmod.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace pbd::rivals {

/// The pattern is fixed: ordering (AMD or METIS, as CHOLMOD chooses) and symbolic analysis are done once.
class BlockCholesky {
 public:
  /// Of a block in the values: its columns begin at `first`, `stride` apart. None if `first` is negative.
  struct Slot {
    int first = -1, stride = 0;
  };

  /// A matrix of `blocks` block rows. `pairs` are the blocks that are not zero, row >= column, in any order
  /// and as often as one likes; those of the diagonal need not be there.
  BlockCholesky(int blocks, std::vector<std::array<int, 2>> pairs);
  BlockCholesky(const BlockCholesky&) = delete;
  BlockCholesky& operator=(const BlockCholesky&) = delete;
  ~BlockCholesky();

  Slot slot(int row, int column) const;
  /// Makes the matrix diagonal.
  void reset(const Eigen::VectorXd& diagonal);
  template <class Block>
  void add(const Slot& slot, const Block& block) {
    for (int j = 0; j < 3; ++j)
      Eigen::Map<Eigen::Vector3d>(values_.data() + slot.first + j * slot.stride) += block.col(j);
  }
  Eigen::VectorXd diagonal() const;

  /// False if the matrix is not positive definite.
  bool factorise();
  /// The solution lives until the next call.
  Eigen::Map<const Eigen::VectorXd> solve(Eigen::VectorXd& right);

 private:
  std::vector<int> start_, row_;  // compressed columns; the diagonal blocks are full, of which CHOLMOD reads
  Eigen::VectorXd values_;        // the lower triangle
  cholmod_common common_{};
  cholmod_sparse matrix_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *solution_ = nullptr, *work_y_ = nullptr, *work_e_ = nullptr;
};

}  // namespace pbd::rivals
