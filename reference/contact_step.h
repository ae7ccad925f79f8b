// The implicit Euler step of a scene with contact (rigid_step.h), with impulses r = h lambda of its contacts:
//
//   load - J^T gamma - C^T lambda = 0,  c + A gamma = 0
//   K contains r, perpendicular to u~ in K*  (cone_problem.h, the laws coulomb and cone)
//
// by other integrators' IntegratorMap with h/s C^T lambda for C^T lambda.
// Limits of joints and motors of limited force are bounded rows of the same problem: the impulse is h gamma,
// and what the row sees (c + A gamma)/h.
// C are the directions of a contact at the step's end: its normal n and two tangents. What the law sees of a
// contact is, in m/s,
//   u_n = (gap - target)/h + A r_n/h^2,  where the surfaces collide the smaller of that, with another target,
//         and n . (u + e u_l), u their velocities against each other; in u_l a body's spin is what it is
//         where the step begins, in the body's own axes
//   u_t = t . (u + s), s the velocity at which surfaces that move along themselves go against each other
//
// by an integrator's map with d for h, and A r_n/(h d).
// The targets and what collides are those of solver/model/contact_effect.h and README.md: overlaps part at
// `recovery` at most, those of deformable surfaces by a tenth of the thickness a step; what would meet in
// free motion, by features that are there when their gap closes, and what is parting too slowly for its e,
// collides.
#pragma once

#include "cone_problem.h"
#include "feature_search.h"
#include "rigid_step.h"
#include "step_claim.h"
#include "step_equations.h"

namespace pbd::reference {

/// One contact of a step.
struct JudgedContact {
  FeaturePair pair;
  ContactLaw law;
  Vec3 reference = Vec3::UnitX();  // tangents are seen from it
  double target = 0, rebound = 0;  // m, gaps aimed at, the second where it collides
  double bounce = 0;               // restitution, if it may collide in this step
  double closing = 0;              // m/s, where the step begins
  bool collides = false;
  double compliance = 0;      // m/N
  Vec3 force = Vec3::Zero();  // lambda h/s, N: along the normal and both tangents
};

/// A contact's directions and how its law sees it at one pose.
struct ContactRow {
  std::vector<std::pair<int, Eigen::Matrix3d>> parts;  // C by each three unknowns, (dx, d)
  double normal_velocity = 0;                          // n . u, m/s
  Vec3 seen = Vec3::Zero();  // what the law sees, without the compliance's part, m/s
};

/// A limit of a joint or a motor of limited force (solver/model/body_effects.h): c + A gamma >= 0 where gamma
/// is at the lower bound, <= 0 at the upper one, else 0.
struct BoundedRow {
  int row = 0;                     // of the model's rows, of which it is no equation
  std::array<double, 2> bounds{};  // of gamma, N or N m
};

/// Where a step ends by some velocities, and what all of its contacts' rows need of that.
struct ContactPose {
  State end;
  Placement at;
  /// Of each contact the least gap of its pair of sides, or if it collides of what is over the same face, m.
  std::vector<double> level{};
};

struct ContactStep {
  RigidStep step;
  Contact contact;
  FeatureSearch search;
  std::vector<JudgedContact> contacts;
  std::vector<BoundedRow> bounded;
  WaysOut deep;  // of what was found in each other where the step was thought to end

  /// Throws SetupError for what the judge does not know.
  ContactStep(const Scene& scene, const State& state, double h, const std::optional<IntegratorMap>& map = {});

  /// How far a node goes in the free motion, without joints and contacts, m.
  double free_displacement() const { return (free_end_.x - start_.x).cwiseAbs().maxCoeff(); }

  /// A contact's compliance for what `force` is: it acts over s, not h. What collides does not yield.
  double compliance_of(const JudgedContact& own) const {
    return own.collides ? 0 : own.compliance * step.s() / step.h;
  }

  /// Takes the features that are valid at `velocity`, and `also_start` where the step begins; known contacts
  /// keep their forces.
  void find_contacts(const Vector& velocity, bool also_start);

  /// Gives the contacts the forces that somebody claims, each to the nearest one of its sides.
  void take_forces(const std::vector<ClaimedContact>& claimed, const Vector& velocity);

  ContactPose pose_at(const Vector& velocity) const;

  /// Forces on a body's face act in one plane, so that all of them can stick at once: `level` off it. `at` is
  /// the pose's, or next to it.
  ContactRow row_of(const JudgedContact& contact, const ContactPose& pose, const Placement& at) const;
  ContactRow row_of(const JudgedContact& contact, const ContactPose& pose) const {
    return row_of(contact, pose, pose.at);
  }

  /// Lets those collide that touch at `velocity` and part by less than their e; returns whether any do anew.
  bool collide(const Vector& velocity);

  /// C^T lambda (N, N m), and the sum of its absolute contributions.
  Vector push(const Vector& velocity, Vector& magnitude) const;

  /// - d(C^T lambda) by (dx, d), by central differences of the forces: of each contact the symmetric part,
  /// and of that what is positive semidefinite, inertia being one. The rest would make pressed faces unstable
  /// but for what holds them together.
  SparseMatrix stiffness(const Vector& velocity) const;

  /// The largest |r - P_K(r - m u~)|/m of a contact, m/s, m the mass that its sides' centres have together.
  double law_residual(FrictionLaw law, const Vector& velocity) const;

  /// The largest |p - clamp(p - m (c + A gamma)/h)|/m of a bounded row, p = h gamma, m the row's effective
  /// mass, over the length of its gradient: m/s.
  double bounds_residual(const RigidSystem& system, const Vector& gamma) const;

 private:
  ContactStep(StepModel stated, const Scene& scene, const State& state, double h,
              const std::optional<IntegratorMap>& map);

  JudgedContact begun(const FeaturePair& pair) const;

  bool can_move(const ContactFeature& feature) const;
  Placement freely(double share) const;
  bool meets_freely(const FeaturePair& pair, double gap, double ahead) const;

  Placement start_, free_end_;
  State free_;     // where the step begins, with the velocities that lead to its free motion's end
  State shifted_;  // likewise to where the step's map begins
};

}  // namespace pbd::reference
