// One body of a scene file, or a grid of copies of it.
#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <random>
#include <string>

#include "scenes/builder.h"

namespace pbdcheck {

inline void require_new_name(Keys& keys, const Builder& builder, const std::string& name) {
  if (name == "world") keys.refuse("name", "`world`, the fixed body that joints may name", "another name");
  for (const auto& body : builder.bodies)
    if (body.name == name) keys.refuse("name", "`" + name + "` twice", "a name of its own for each body");
}

/// A grid of bodies alike, each shifted and turned a little, the same in every run.
class Copies {
 public:
  Copies(Keys& keys, const Builder& builder) : name_(read_name(keys)) {
    if (!keys.has("copies")) {
      for (const auto* key : {"spacing_m", "scatter_m", "scatter_rad"})
        if (keys.has(key)) keys.refuse(key, "a place among copies of one body", "`copies`, too");
      require_new_name(keys, builder, name_);
      return;
    }
    copied_ = true;
    const auto counts = keys.integers("copies", 1);
    constexpr std::int64_t most = 100000;
    const std::string allowed = fmt::format("three numbers >= 1 whose product is at most {}", most);
    if (counts.size() != 3) keys.refuse("copies", allowed);
    count_ = {counts[0], counts[1], counts[2]};
    if (count_[0] > most / count_[1] / count_[2]) keys.refuse("copies", allowed);
    spacing_ = keys.vector("spacing_m");
    scatter_ = keys.number_or("scatter_m", 0, Range::not_negative);
    turn_ = keys.number_or("scatter_rad", 0, Range::not_negative);
    for (std::int64_t i = 0; i < size(); ++i) require_new_name(keys, builder, name(i));
  }

  std::int64_t size() const { return count_[0] * count_[1] * count_[2]; }
  bool copied() const { return copied_; }
  std::string name(std::int64_t i) const { return copied_ ? fmt::format("{}_{}", name_, i) : name_; }

  /// Of copy i in the place of the first one; asked for one after the other. x runs first, z last.
  Eigen::Isometry3d moved(std::int64_t i, const Eigen::Isometry3d& first) {
    if (!copied_) return first;
    const std::int64_t row = i / count_[0], layer = row / count_[1];
    const pbd::Vec3 cell(static_cast<double>(i % count_[0]), static_cast<double>(row % count_[1]),
                         static_cast<double>(layer));
    Eigen::Isometry3d placed = first;
    placed.translation() += cell.cwiseProduct(spacing_) + scatter_ * random_vector();
    const pbd::Vec3 turn = turn_ * random_vector();
    if (turn.norm() > 0)
      placed.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * first.linear();
    return placed;
  }

 private:
  /// Each entry from -1 to 1: 53 bits of a generator whose numbers the standard fixes.
  pbd::Vec3 random_vector() {
    const auto draw = [&] { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1; };
    const double x = draw(), y = draw(), z = draw();
    return {x, y, z};
  }

  std::string name_;
  bool copied_ = false;
  std::array<std::int64_t, 3> count_{1, 1, 1};
  pbd::Vec3 spacing_ = pbd::Vec3::Zero();
  double scatter_ = 0, turn_ = 0;  // m, rad
  std::mt19937_64 engine_;
};

}  // namespace pbdcheck
