// quasi_newton: v <- v - t H grad phi(v) on the potential that remains when compliant rows are eliminated
// (potential.h), L-BFGS in a constant metric, backtracking on phi. Where other rows are left they stay dual:
// hard ones (hard_rows.h), or contacts alone (metric_contacts.h). v is then the argmin of the potential's
// model in the metric P under them, accelerated by Anderson's method, which begins anew where its residual
// does not fall, and of sheets wherever it grows. P knows nothing of those rows' geometric stiffness. While
// the residual is above a hundredth of the scale, contacts guard the way by a merit (contact_merit.h), where
// no gyroscopic torque acts: an acceleration that doubles it is taken back, a step that does is halved, five
// times at most. Where that does not help the whole step is taken.
//
// The metric is that of the rest shapes (of bending, which states none, that of the scene's initial
// positions) until 30 iterations of a step were not enough: it is then factored anew at the current shape,
// which allocates; in scenes with contact the next step begins by the rest shapes again. Of sheets, whose
// stiffness across themselves is their tension, it is that of the current shape. Where it descends, by line
// searches, it is Newton's tangent (`Constraint::geometric_stiffness`), without what is not convex where that
// is not positive definite, and a step that is warm-started begins with the last one's; under rows, which
// have no line search, it is the convex part. It is factored anew wherever a descent leaves more than 0.7 of
// the residual, under rows more than a tenth. Above 1e10 block products (about 70000 nodes of a beam four
// times as long as high) it falls back to one number a pair of nodes, which takes several times the
// iterations (measured: `rival_newton`).
#pragma once

#include <algorithm>
#include <optional>

#include "outer/acceleration.h"
#include "outer/contact_merit.h"
#include "outer/free_components.h"
#include "outer/hard_rows.h"
#include "outer/lbfgs.h"
#include "outer/metric_contacts.h"
#include "outer/potential.h"
#include "outer/settle.h"

namespace pbd {

class QuasiNewton {
 public:
  static constexpr bool solves_step = true;

  /// Marks the slots that it eliminates. Throws SetupError where there is no potential.
  explicit QuasiNewton(StepSystem& system);

  /// True if `auto` takes it: rows are compliant and of points, or contacts.
  static bool suits(const StepSystem& system);

  /// True where the metric is that of the current shape.
  bool follows() const { return follows_; }

  /// Contacts that have an impulse at the iterate, or ask for one.
  std::int64_t pressed_contacts(StepSystem& system) const {
    return dual_ == Dual::contacts ? MetricContacts::pressed(system.rows, potential_.eliminated, system.at.v)
                                   : 0;
  }

  /// True where nothing is left dual: it goes down the potential by line searches.
  bool descends(const StepSystem& system) const;

  void begin(StepSystem& system);
  void end(StepSystem& system) { components_.restore_momentum(system); }
  RowResidual refresh(StepSystem& system);
  void iterate(StepSystem& system, Progress& progress);

  /// The iterate or the impulses have been changed from outside.
  void forget() {
    evaluated_ = false;
    acceleration_.forget();
    last_residual_ = 0;
    fall_ = {};
  }

  /// The stiffness of an effect is another now.
  void forget_stiffness() { potential_.metric.forget(); }

  /// The rows' own impulses answer for what rounding makes of x, times the stiffness. Where the iteration has
  /// arrived, or may not go on, takes v and them to the solution of the linear rows at v and returns the
  /// residual there. `unsettle` comes back.
  std::optional<RowResidual> settle(StepSystem& system, const Progress& progress, bool stalled);
  void unsettle(StepSystem& system);

 private:
  RowResidual evaluate(StepSystem& system);
  double find_direction();
  std::optional<RowResidual> rest_as_it_is(StepSystem& system, const Progress& progress);
  bool arrived(const StepSystem& system, const Progress& progress);
  bool start_low(StepSystem& system);
  bool outlived(const Progress& progress, double well);
  void descend(StepSystem& system, const Progress& progress);
  void project(StepSystem& system, Progress& progress);
  void search(StepSystem& system);

  enum class Dual : std::uint8_t { none, hard_rows, contacts };  // besides what is eliminated

  /// The lowest residual, sqrt(J), and iterations since one was below a share of the lowest before it.
  struct Fall {
    double lowest = infinity;
    int iterations_since = 0;

    void note(double residual, double share = 1) {
      iterations_since = residual < share * lowest ? 0 : iterations_since + 1;
      lowest = std::min(lowest, residual);
    }
  };

  Dual dual_ = Dual::none;
  bool bodies_move_ = false;
  bool follows_ = false;  // the metric is that of the current shape
  bool pressed_ = false;  // the metric is that of a shape in contact; the next step forgets it
  FreeComponents components_;
  Potential potential_;
  Lbfgs lbfgs_;
  Settling settling_;
  double last_residual_ = 0;  // sqrt(J), of the last iteration
  bool evaluated_ = false;    // the potential and the rows are those of v
  RowResidual sums_;          // of the rows there
  double slope_ = 0;          // of the potential along `direction`, J
  Points last_gradient_, direction_, search_from_, rest_;
  Fall fall_;  // of this step's residual, where it descends the primal one

  // Where rows are left dual.
  HardRows hard_rows_;
  MetricContacts contacts_;
  Acceleration acceleration_;
  ContactMerit merit_;
  ContactMerit::Sliding at_image_, at_accelerated_;
  Points image_;
};

}  // namespace pbd
