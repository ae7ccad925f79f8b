// Square matrices that are one matrix times a number each: compliances of constraints of one material, of
// which a sweep then reads a number each, not a matrix.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace pbd {

template <class Square>
class ScaledSquares {
 public:
  using Value = Eigen::Matrix<double, Square::RowsAtCompileTime, 1>;

  /// One of them.
  class Entry {
   public:
    Entry(double factor, const Square& one) : factor_(factor), one_(one) {}
    operator Square() const { return factor_ * one_; }
    double operator()(Eigen::Index row, Eigen::Index column) const { return factor_ * one_(row, column); }
    double trace() const { return factor_ * one_.trace(); }
    bool is_zero() const { return factor_ == 0; }

    Value operator*(const Value& x) const {
      if constexpr (Square::RowsAtCompileTime == 1)
        return factor_ * x;  // `one` is 1
      else
        return factor_ * (one_ * x);
    }

   private:
    double factor_;
    const Square& one_;
  };

  /// `one` for constraints of several rows; 1 for those of a single one.
  void set_one(const Square& one) {
    if constexpr (Square::RowsAtCompileTime > 1) one_ = one;
  }
  const Square& one() const { return one_; }
  void set(std::size_t i, double factor) { factor_[i] = factor; }
  double factor(std::size_t i) const { return factor_[i]; }
  Entry operator[](std::size_t i) const { return {factor_[i], one_}; }

  void resize(std::size_t count) { factor_.resize(count); }
  std::size_t size() const { return factor_.size(); }
  std::size_t bytes() const { return factor_.size() * sizeof(double); }

 private:
  Square one_ = Square::Identity();
  std::vector<double> factor_;
};

}  // namespace pbd
