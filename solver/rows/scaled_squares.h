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

  /// One of them, while they live.
  class Entry {
   public:
    Entry(double factor, const Square& unit) : factor_(factor), unit_(unit) {}
    operator Square() const { return factor_ * unit_; }
    double operator()(Eigen::Index row, Eigen::Index column) const { return factor_ * unit_(row, column); }
    double trace() const { return factor_ * unit_.trace(); }
    bool is_zero() const { return factor_ == 0; }

    Value operator*(const Value& x) const {
      if constexpr (Square::RowsAtCompileTime == 1) {
        return factor_ * x;  // `unit` is 1
      } else {
        const Value product = unit_ * x;  // one expression of all three would scale the matrix
        return factor_ * product;
      }
    }

   private:
    double factor_;
    const Square& unit_;
  };

  /// What each is a number times; of constraints of one row 1 alone.
  void set_unit(const Square& unit) {
    if constexpr (Square::RowsAtCompileTime > 1) unit_ = unit;
  }
  const Square& unit() const { return unit_; }
  void set(std::size_t i, double factor) { factor_[i] = factor; }
  double factor(std::size_t i) const { return factor_[i]; }
  Entry operator[](std::size_t i) const { return {factor_[i], unit_}; }

  void resize(std::size_t count) { factor_.resize(count); }
  std::size_t size() const { return factor_.size(); }
  std::size_t bytes() const { return factor_.size() * sizeof(double); }

 private:
  Square unit_ = Square::Identity();
  std::vector<double> factor_;
};

}  // namespace pbd
