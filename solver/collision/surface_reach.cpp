#include "collision/surface_reach.h"

#include <algorithm>
#include <numeric>

namespace pbd {

SurfaceReach::SurfaceReach(const std::vector<std::array<int, 3>>& triangles, const std::vector<int>& nodes)
    : nodes_(nodes) {
  if (nodes.empty()) return;
  std::vector<int> first(static_cast<std::size_t>(*std::max_element(nodes.begin(), nodes.end())) + 1);
  std::iota(first.begin(), first.end(), 0);
  const auto first_of = [&](int node) {
    while (first[node] != node) node = first[node] = first[first[node]];
    return node;
  };
  for (const auto& [a, b, c] : triangles)
    for (const int other : {b, c}) first[first_of(other)] = first_of(a);
  piece_.assign(first.size(), -1);
  for (const int node : nodes) {
    int& piece = piece_[first_of(node)];
    if (piece < 0) {
      piece = static_cast<int>(in_piece_.size());
      in_piece_.push_back(0);
    }
    piece_[node] = piece;
    in_piece_[piece] += 1;
  }
  course_.resize(in_piece_.size());
  beside_.resize(first.size());
}

void SurfaceReach::set_out(const Points& start, const Points& straight, const Points& free, double room) {
  mean_.setZero();
  std::fill(course_.begin(), course_.end(), Vec3::Zero());
  for (const int node : nodes_) {
    const Vec3 way = straight.col(node) - start.col(node);
    mean_ += way / static_cast<double>(nodes_.size());
    course_[piece_[node]] += way / in_piece_[piece_[node]];
  }
  for (const int node : nodes_) {
    const Vec3& course = course_[piece_[node]];
    const double way = (free.col(node) - start.col(node)).norm();
    beside_[node] = (free.col(node) - start.col(node) - course).norm() + room * (course - mean_).norm() +
                    way_rounding * way;
  }
}

bool SurfaceReach::extend(const Points& start, const Points& x, double room) {
  bool farther = false;
  for (const int node : nodes_) {
    const double reached = (x.col(node) - start.col(node) - course_[piece_[node]]).norm();
    farther |= search_farther(beside_[node], reached, room);
  }
  return farther;
}

double SurfaceReach::of(const std::array<int, 4>& nodes) const {
  double most = 0;
  for (const int node : nodes) most = std::max(most, beside_[node]);
  return 2 * most + (course_[piece_[nodes[3]]] - course_[piece_[nodes[0]]]).norm();
}

double SurfaceReach::most() const {
  double beside = 0, apart = 0;
  for (const double own : beside_) beside = std::max(beside, own);
  for (const Vec3& course : course_) apart = std::max(apart, (course - mean_).norm());
  return 2 * (beside + apart);
}

}  // namespace pbd
