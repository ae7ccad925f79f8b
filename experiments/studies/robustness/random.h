// Random numbers that are the same with every standard library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Geometry>

namespace pbdcheck {

class Random {
 public:
  explicit Random(std::uint64_t begin) : engine_(begin) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  bool happens(double probability) { return uniform(0, 1) < probability; }
  int below(int count) { return static_cast<int>(uniform(0, count)); }

  /// In the cube of half side `size`.
  Eigen::Vector3d vector(double size) {
    const double x = uniform(-size, size), y = uniform(-size, size), z = uniform(-size, size);
    return {x, y, z};
  }
  /// Of any direction in a cube of half side 1, by rejection in the ball.
  Eigen::Vector3d direction() {
    Eigen::Vector3d v;
    do v = vector(1);
    while (v.squaredNorm() > 1 || v.squaredNorm() < 1e-2);
    return v.normalized();
  }
  Eigen::Quaterniond turn() {
    const Eigen::Vector3d axis = direction();
    return Eigen::Quaterniond(Eigen::AngleAxisd(uniform(-3.14, 3.14), axis));
  }

  template <class List>
  const auto& one_of(const List& list) {
    return list[static_cast<std::size_t>(below(static_cast<int>(list.size())))];
  }

  /// K different numbers below `count`.
  template <std::size_t K>
  std::array<int, K> different(int count) {
    std::array<int, K> picked;
    for (std::size_t a = 0; a < K;) {
      picked[a] = below(count);
      if (std::find(picked.begin(), picked.begin() + a, picked[a]) == picked.begin() + a) ++a;
    }
    return picked;
  }

  /// The numbers below `count` in any order.
  std::vector<int> order(int count) {
    std::vector<int> picked(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) picked[static_cast<std::size_t>(i)] = i;
    for (int i = count - 1; i > 0; --i)
      std::swap(picked[static_cast<std::size_t>(i)], picked[static_cast<std::size_t>(below(i + 1))]);
    return picked;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace pbdcheck
