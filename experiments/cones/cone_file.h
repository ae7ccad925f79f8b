// Contact problems with friction on disk: FCLIB's HDF5 files (local and global) and Siconos' text (dense,
// blocks, or sparse). The format is told by the content.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cone_problem.h"

namespace pbdcheck {

struct ConeFile {
  pbd::reference::ConeProblem problem;  // with W as stored
  std::string form;                     // what the file was, and how it was read
  std::vector<std::string> warnings;    // of what is in doubt
  double asymmetry = 0;                 // of W
  double rounding = 0;                  // as in StoredCone
  bool semidefinite = true;             // W's symmetric part, to `rounding` and its asymmetry, 0.01 at most
};

/// Global problems are condensed: W = H^T M^-1 H, q = w + H^T M^-1 f. Throws SetupError naming the file and
/// what is allowed.
ConeFile read_cone_file(const std::filesystem::path& path);

/// The problem as FCLIB's local one with its solution (u, r), complete or not there.
void write_cone_file(const std::filesystem::path& path, const pbd::reference::ConeProblem& problem,
                     const pbd::reference::ConeSolution& solution);

// The parts, one source each.

using Sparse = Eigen::SparseMatrix<double>;

/// Asymmetry that products of doubles leave behind.
inline constexpr double symmetric_within = 1e-12;

/// |W - W^T| / |W| (Frobenius).
double asymmetry(const Sparse& w);

/// The problem with the symmetric part of W.
pbd::reference::ConeProblem symmetric(const pbd::reference::ConeProblem& problem);

/// Of a number in W and q, so that products do not overflow.
inline constexpr double largest_in_cone = 1e100;

/// A problem as it is stored. `transposed` is W with each block read row by row where that is in doubt.
/// `rounding` is the largest relative error of a number in W: of numbers in 17 digits, what a program lost
/// that computed them.
struct StoredCone {
  Sparse delassus, transposed;
  Eigen::VectorXd free_velocity, friction;
  std::string form;
  std::vector<std::string> warnings{};
  double rounding = 1e-10;
};
bool is_hdf5(const std::filesystem::path& path);
StoredCone read_fclib(const std::filesystem::path& path);
StoredCone read_siconos(const std::filesystem::path& path);

}  // namespace pbdcheck
