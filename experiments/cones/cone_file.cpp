#include "cones/cone_file.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <cmath>

#include "error.h"
#include "validate.h"

namespace pbdcheck {
namespace {

using Eigen::VectorXd;
using pbd::SetupError;

/// False for NaN, too.
bool usable(const VectorXd& numbers) {
  return (numbers.array().abs() <= largest_in_cone).all();
}

Sparse symmetric_part(const Sparse& w) {
  return 0.5 * (w + Sparse(w.transpose()));
}

/// Whether the symmetric part is positive semidefinite within the errors of W's numbers: those of `rounding`
/// move eigenvalues by that share of the largest sum of a row at most.
bool semidefinite(const Sparse& w, double rounding) {
  constexpr double most_error = 0.01;  // larger asymmetry is not rounding
  const Sparse part = symmetric_part(w);
  const double size = part.diagonal().cwiseAbs().maxCoeff();
  const double sum = (part.cwiseAbs() * VectorXd::Ones(w.cols())).maxCoeff();
  Sparse shift(w.rows(), w.cols());
  shift.setIdentity();
  shift *= sum > 0 ? rounding * sum + std::min(asymmetry(w), most_error) * size : 1;
  return Eigen::SimplicialLLT<Sparse>(Sparse(part + shift)).info() == Eigen::Success;
}

void require(bool holds, const std::filesystem::path& path, const std::string& got,
             const std::string& allowed) {
  if (!holds) throw SetupError(path.string(), got, allowed);
}

}  // namespace

double asymmetry(const Sparse& w) {
  const double size = w.norm();
  return size > 0 ? Sparse(w - Sparse(w.transpose())).norm() / size : 0;
}

ConeFile read_cone_file(const std::filesystem::path& path) {
  require(std::filesystem::is_regular_file(path), path, "no file",
          "an FCLIB HDF5 file or a Siconos text file");
  StoredCone stored = is_hdf5(path) ? read_fclib(path) : read_siconos(path);
  const auto contacts = stored.friction.size();
  require(contacts > 0, path, "no contact", "one or more");
  const Sparse& w = stored.delassus;
  require(w.rows() == 3 * contacts && w.cols() == 3 * contacts, path,
          fmt::format("W of {} x {} for {} contacts", w.rows(), w.cols(), contacts),
          "three rows and columns a contact");
  require(stored.free_velocity.size() == 3 * contacts, path,
          fmt::format("q of {} numbers for {} contacts", stored.free_velocity.size(), contacts),
          "three a contact");
  const std::string allowed = fmt::format("finite numbers, at most {:g}", largest_in_cone);
  require(usable(Eigen::Map<const VectorXd>(w.valuePtr(), w.nonZeros())), path,
          "W with a number that is too large or none", allowed);
  require(usable(stored.free_velocity), path, "q with a number that is too large or none", allowed);
  for (Eigen::Index i = 0; i < contacts; ++i)
    require(stored.friction(i) >= 0 && stored.friction(i) <= pbd::most_friction, path,
            fmt::format("mu = {} at contact {}", stored.friction(i), i),
            fmt::format("a number from 0 to {:g}", pbd::most_friction));

  ConeFile file;
  file.form = stored.form;
  file.warnings = stored.warnings;
  file.rounding = stored.rounding;
  file.semidefinite = semidefinite(w, stored.rounding);
  if (stored.transposed.size() > 0) {  // both readings are possible
    const bool other = semidefinite(stored.transposed, stored.rounding);
    const bool rows = other && (!file.semidefinite || asymmetry(stored.transposed) < 0.1 * asymmetry(w));
    file.form += rows ? ", blocks read row by row" : ", blocks read column by column";
    if (rows) stored.delassus = stored.transposed, file.semidefinite = true;
  }
  file.asymmetry = asymmetry(stored.delassus);
  file.problem = {stored.delassus, std::move(stored.free_velocity), std::move(stored.friction)};
  return file;
}

pbd::reference::ConeProblem symmetric(const pbd::reference::ConeProblem& problem) {
  return {symmetric_part(problem.delassus), problem.free_velocity, problem.friction};
}

}  // namespace pbdcheck
