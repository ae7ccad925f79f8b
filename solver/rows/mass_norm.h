// Products of columns as they are, and in the metric of the masses over the nodes that can move: |v|_M^2 =
// sum m |v|^2, J.
#pragma once

#include <cmath>
#include <iterator>
#include <vector>

#include "geometry.h"
#include "threads/threads.h"

namespace pbd {

/// The sum of a . b over all columns.
inline double dot(const Points& a, const Points& b) {
  return (a.array() * b.array()).sum();
}

/// a . M b
inline double mass_product(const std::vector<double>& inverse_mass, const Points& a, const Points& b) {
  double sum = 0;
  for (std::size_t node = 0; node < inverse_mass.size(); ++node)
    if (inverse_mass[node] > 0) sum += a.col(node).dot(b.col(node)) / inverse_mass[node];
  return sum;
}

/// `sum` + |a - b|_M^2
inline double squared_mass_distance(const std::vector<double>& inverse_mass, const Points& a, const Points& b,
                                    double sum = 0, int threads = 1) {
  add_columns(threads, std::ssize(inverse_mass), sum,
              [&](Eigen::Index first, Eigen::Index count, double& own) {
                for (Eigen::Index node = first; node < first + count; ++node)
                  if (inverse_mass[node] > 0)
                    own += (a.col(node) - b.col(node)).squaredNorm() / inverse_mass[node];
              });
  return sum;
}

inline double mass_distance(const std::vector<double>& inverse_mass, const Points& a, const Points& b,
                            int threads = 1) {
  return std::sqrt(squared_mass_distance(inverse_mass, a, b, 0, threads));
}

inline double squared_mass_norm(const std::vector<double>& inverse_mass, const Points& v, int threads = 1) {
  double sum = 0;
  add_columns(threads, std::ssize(inverse_mass), sum,
              [&](Eigen::Index first, Eigen::Index count, double& own) {
                for (Eigen::Index node = first; node < first + count; ++node)
                  if (inverse_mass[node] > 0) own += v.col(node).squaredNorm() / inverse_mass[node];
              });
  return sum;
}

inline double mass_norm(const std::vector<double>& inverse_mass, const Points& v, int threads = 1) {
  return std::sqrt(squared_mass_norm(inverse_mass, v, threads));
}

/// |momentum|_W = |W momentum|_M, sqrt(J).
inline double momentum_norm(const std::vector<double>& inverse_mass, const Points& momentum) {
  double sum = 0;
  for (std::size_t node = 0; node < inverse_mass.size(); ++node)
    sum += inverse_mass[node] * momentum.col(node).squaredNorm();
  return std::sqrt(sum);
}

}  // namespace pbd
