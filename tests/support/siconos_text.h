// Contact problems as Siconos writes them.
#pragma once

#include <fmt/format.h>

#include <Eigen/Dense>
#include <string>

namespace pbdcheck::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

inline std::string text(const MatrixXd& numbers) {  // column by column
  std::string all;
  for (const double value : numbers.reshaped()) all += fmt::format("{:.17g} ", value);
  return all + "\n";
}

inline std::string dense(const MatrixXd& w, const VectorXd& q, const VectorXd& mu) {
  return fmt::format("3\n{0}\n0\n{1}\n{1}\n{1}\t{1}\n", mu.size(), w.rows()) + text(w) + text(q) + text(mu);
}

/// A sparse W as Siconos 4.4.0 has CSparse 3.2.0 print it, in six digits, and what stands before it.
inline std::string sparse_head(const MatrixXd& w, bool by_columns) {
  const auto rows = w.rows();
  std::string file =
      fmt::format("3\n{0}\n2\n{1}\n{1}\n{2}\nCSparse Version 3.2.0, Sept 12, 2017.  Copyright (c) ", rows / 3,
                  rows, by_columns ? 2 : 1);
  file += fmt::format("Timothy A. Davis, 2006-2016\n{0}{1}-by-{1}, nzmax: {2} nnz: {2}",
                      by_columns ? "" : "triplet: ", rows, rows * rows);
  file += by_columns ? fmt::format(", 1-norm: {:g}\n", w.cwiseAbs().colwise().sum().maxCoeff()) : "\n";
  for (Eigen::Index j = 0; j < rows; ++j) {
    if (by_columns) file += fmt::format("    col {} : locations {} to {}\n", j, j * rows, (j + 1) * rows - 1);
    for (Eigen::Index i = 0; i < rows; ++i)
      file += by_columns ? fmt::format("      {} : {:g}\n", i, w(i, j))
                         : fmt::format("    {} {} : {:g}\n", i, j, w(i, j));
  }
  return file;
}

inline std::string sparse(const MatrixXd& w, const VectorXd& q, const VectorXd& mu, bool by_columns) {
  return sparse_head(w, by_columns) + text(q) + text(mu);
}

/// All blocks of `size` rows, each written column by column, or row by row.
inline std::string blocks(const MatrixXd& w, const VectorXd& q, const VectorXd& mu, bool by_rows,
                          Eigen::Index size = 3) {
  const auto n = w.rows() / size;
  std::string file = fmt::format("3\n{0}\n1\n{1}\n{1}\n{2}\n{3}\n{3}\n", mu.size(), w.rows(), n * n, n);
  for (int side = 0; side < 2; ++side)
    for (Eigen::Index i = 1; i <= n; ++i) file += fmt::format("{} ", size * i);
  file += fmt::format("\n{}\n{}\n", n + 1, n * n);
  for (Eigen::Index i = 0; i <= n; ++i) file += fmt::format("{} ", i * n);
  for (Eigen::Index k = 0; k < n * n; ++k) file += fmt::format("{} ", k % n);
  for (Eigen::Index k = 0; k < n * n; ++k) {
    const Eigen::MatrixXd block = w.block(size * (k / n), size * (k % n), size, size);
    file += fmt::format("{}\n", k) + text(by_rows ? Eigen::MatrixXd(block.transpose()) : block);
  }
  return file + text(q) + text(mu);
}

}  // namespace pbdcheck::test
