#include "outer/anderson.h"

#include <algorithm>
#include <cmath>

namespace pbd {

void Anderson::flatten(const Rows& rows, const Points& v, Eigen::VectorXd& z) const {
  z.resize(v.size() + row_count(rows));
  z.head(v.size()) = v.reshaped();
  Eigen::Index next = v.size();
  for_each_block(rows.blocks, [&](const auto& block) {
    for (const auto& impulse : block.impulse) {
      z.segment(next, impulse.size()) = impulse;
      next += impulse.size();
    }
  });
}

void Anderson::spread(const Eigen::VectorXd& z, Rows& rows, Points& v) const {
  v.reshaped() = z.head(v.size());
  Eigen::Index next = v.size();
  for_each_block(rows.blocks, [&](auto& block) {
    for (auto& impulse : block.impulse) {
      impulse = z.segment(next, impulse.size());
      next += impulse.size();
    }
  });
}

void Anderson::begin(const Rows& rows, const Points& v) {
  if (memory_ > 0) flatten(rows, v, start_);
}

bool Anderson::accelerate(const std::vector<double>& inverse_mass, Rows& rows, Points& v) {
  if (memory_ == 0) return false;
  if (root_mass_.size() == 0) {
    root_mass_.resize(v.size());
    for (Eigen::Index k = 0; k < v.size(); ++k) {
      const double inverse = inverse_mass[k / 3];
      root_mass_[k] = inverse > 0 ? 1 / std::sqrt(inverse) : 0.0;
    }
  }
  last_image_.swap(image_);
  last_residual_.swap(residual_);
  flatten(rows, v, image_);
  residual_ = root_mass_.cwiseProduct((image_ - start_).head(v.size()));
  if (count_ > 0) {
    if (image_change_.rows() != image_.size() || image_change_.cols() == 0) {  // contacts come and go
      image_change_.resize(image_.size(), memory_);
      residual_change_.resize(residual_.size(), memory_);
    }
    const int column = (count_ - 1) % memory_;
    image_change_.col(column) = image_ - last_image_;
    residual_change_.col(column) = residual_ - last_residual_;
  }
  const int columns = std::min(count_++, memory_);
  if (columns == 0) return false;
  combine(columns);
  constexpr double longest = 100;
  const double length = (start_ - image_).head(v.size()).cwiseProduct(root_mass_).norm();
  if (!std::isfinite(length)) return false;
  const double cap = longest * residual_.norm();
  if (length > cap) start_ = image_ + cap / length * (start_ - image_);
  spread(start_, rows, v);
  return true;
}

/// start_ = g - Dg gamma, by Gram and Schmidt from the newest difference to the oldest: what the newer ones
/// span already is left out.
void Anderson::combine(int columns) {
  constexpr double dependent = 1e-12;
  const auto newest = [&](int k) { return (count_ - 2 - k) % memory_; };
  basis_.resize(residual_.size(), memory_);
  triangle_.setZero(memory_, memory_);
  for (int k = 0; k < columns; ++k) {
    basis_.col(k) = residual_change_.col(newest(k));
    const double length = basis_.col(k).norm();
    for (int pass = 0; pass < 2; ++pass)
      for (int j = 0; j < k; ++j) {
        const double share = basis_.col(j).dot(basis_.col(k));
        triangle_(j, k) += share;
        basis_.col(k) -= share * basis_.col(j);
      }
    const double left = basis_.col(k).norm();
    triangle_(k, k) = left;
    if (left > dependent * length)
      basis_.col(k) /= left;
    else
      basis_.col(k).setZero();
  }
  start_ = image_;
  coefficient_.resize(memory_);
  for (int k = columns - 1; k >= 0; --k) {
    double rest = basis_.col(k).dot(residual_);
    for (int j = k + 1; j < columns; ++j) rest -= triangle_(k, j) * coefficient_[j];
    coefficient_[k] = basis_.col(k).isZero(0) ? 0.0 : rest / triangle_(k, k);
    start_ -= coefficient_[k] * image_change_.col(newest(k));
  }
}

void Anderson::reject(Rows& rows, Points& v) {
  spread(image_, rows, v);
  forget();
}

}  // namespace pbd
