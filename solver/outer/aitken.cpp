#include "outer/aitken.h"

#include <algorithm>

namespace pbd {

void Aitken::iterate(StepSystem& system, Progress& progress) {
  CurrentIterate& at = system.at;
  change_ = -at.v;
  at.v = at.rebuilt;
  relax(system, progress);
  change_ += at.v;
  if (known_)
    suggest_shares(system.problem);
  else
    share_.assign(static_cast<std::size_t>(change_.cols()), 1.0);
  for (Eigen::Index column = 0; column < change_.cols(); ++column)
    if (const double share = share_[column]; share < 1) at.v.col(column) -= (1 - share) * change_.col(column);
  last_change_.swap(change_);
  known_ = true;
}

void Aitken::suggest_shares(const Problem& problem) {
  // A smaller share would hold a body back for long where not it, but a neighbour, has turned its change
  // round.
  constexpr double least = 0.2;
  const Bodies& bodies = problem.bodies;
  along_.assign(static_cast<std::size_t>(bodies.nodes()), 0.0);
  square_ = along_;
  const auto add = [&](int node, Eigen::Index column) {
    const double inverse = problem.inverse_mass[column];
    if (inverse == 0) return;
    const Vec3 difference = change_.col(column) - last_change_.col(column);
    along_[node] += last_change_.col(column).dot(difference) / inverse;
    square_[node] += difference.squaredNorm() / inverse;
  };
  for (int node = 0; node < bodies.nodes(); ++node) add(node, node);
  for (int body = 0; body < bodies.count(); ++body) add(bodies.node(body), bodies.column(body));
  for (int node = 0; node < bodies.nodes(); ++node) {
    const bool turned_back = along_[node] < 0 && square_[node] > 0;
    share_[node] = turned_back ? std::clamp(-share_[node] * along_[node] / square_[node], least, 1.0) : 1.0;
  }
  for (int body = 0; body < bodies.count(); ++body) share_[bodies.column(body)] = share_[bodies.node(body)];
}

}  // namespace pbd
