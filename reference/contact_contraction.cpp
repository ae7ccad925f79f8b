#include "contact_contraction.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

#include "dense.h"
#include "error.h"
#include "touch.h"

namespace pbd::reference {
namespace {

constexpr auto where = "plain_contraction_of_contacts";

/// F(v, gamma, r; w) of the header.
class LinearisedStep {
 public:
  LinearisedStep(const StepClaim& claim, RigidStep step) : step_(std::move(step)), law_(claim.friction) {
    const auto& contact = contact_of(claim);
    const Placement end{claim.end.x, claim.end.orientation, claim.end.time};
    double largest = 0;
    for (const ClaimedContact& each : claim.contacts)
      largest = std::max(largest, each.force.dot(each.normal));
    for (const ClaimedContact& each : claim.contacts)
      if (each.force.dot(each.normal) > least_force * largest) add(contact, each, end);
    find_lowest(end);
  }

  const RigidStep& step() const { return step_; }
  const std::vector<Touch>& touches() const { return touches_; }
  Eigen::Index velocities() const { return step_.model.unknowns; }
  Eigen::Index size() const { return velocities() + step_.model.rows() + 3 * std::ssize(touches_); }

  /// Velocities and multipliers that the claim tells; normals and tangents at its end.
  Vector claimed(const StepClaim& claim) const {
    Vector all = Vector::Zero(size());
    RigidStep at_end = step_;
    at_end.start.v = claim.end.v, at_end.start.spin = claim.end.spin;
    all.head(velocities()) = at_end.start_velocity();
    const Placement at = step_.placement(all.head(velocities()));
    for (std::size_t k = 0; k < touches_.size(); ++k)
      all.segment<3>(force_at(k)) = touching_at(step_, at, touches_[k]).directions * told_[k];
    return all;
  }

  Vector operator()(const Vector& all, const Vector& w) const {
    const Vector v = all.head(velocities()), gamma = all.segment(velocities(), step_.model.rows());
    const Placement at = step_.placement(w);
    const RigidSystem linear = system_at(step_, w, Vector::Zero(step_.model.rows()));
    Vector found(size());
    found.head(velocities()) =
        system_at(step_, v, Vector::Zero(step_.model.rows())).load - linear.jacobian.transpose() * gamma;
    found.segment(velocities(), step_.model.rows()) =
        (linear.value + step_.h * (linear.jacobian * (v - w)) + linear.compliance * gamma) / step_.h;
    for (std::size_t k = 0; k < touches_.size(); ++k) {
      const TouchingAt here = touching_at(step_, at, touches_[k]);
      const double level = touching_at(step_, at, touches_[touches_[k].lowest]).gap;
      const Vec3 place = touches_[k].b.plane ? Vec3(here.point_b + level * here.directions.row(0).transpose())
                                             : Vec3((here.point_a + here.point_b) / 2);
      const Eigen::MatrixXd rows = rows_of(step_, at, touches_[k], here, place);
      const Vec3 force = all.segment<3>(force_at(k));
      found.head(velocities()) -= rows.transpose() * force;
      const double normal = here.gap / step_.h + rows.row(0).dot(v - w);
      found.segment<3>(force_at(k)) = law(touches_[k], normal, (rows * v).tail<2>(), force);
    }
    return found;
  }

  Eigen::Index force_at(std::size_t touch) const {
    return velocities() + step_.model.rows() + 3 * static_cast<Eigen::Index>(touch);
  }

 private:
  static constexpr double least_force = 1e-6;  // of the largest: what presses less is open
  static constexpr double on_cone = 1e-6;      // of mu r_n: what is nearer to it slides

  static const Contact& contact_of(const StepClaim& claim) {
    for (const auto& effect : claim.scene.effects)
      if (const auto* contact = std::get_if<Contact>(&effect)) return *contact;
    throw SetupError(where, "a scene without contact", "one with contact");
  }

  void add(const Contact& contact, const ClaimedContact& each, const Placement& end) {
    if (each.met) throw SetupError(where, "what met on the way of the step", "contacts where it ends");
    for (const int k : each.collider)
      if (k < 0 || k >= static_cast<int>(contact.collider.size()))
        throw SetupError(where, "a contact of a node or surface", "contacts of bodies");
    const ContactLaw& law = contact.between(static_cast<std::size_t>(each.collider[0]),
                                            static_cast<std::size_t>(each.collider[1]));
    for (const int k : each.collider)
      if (!contact.collider[static_cast<std::size_t>(k)].surface_velocity.isZero(0))
        throw SetupError(where, "a surface that moves along itself", "contacts without");
    if (law.restitution > 0 || law.compliance > 0)
      throw SetupError(where, "restitution or compliance", "contacts without");
    std::array<Feature, 2> side;
    for (const std::size_t k : {0, 1}) {
      const Collider& collider = contact.collider[static_cast<std::size_t>(each.collider[k])];
      side[k] = feature_of(collider, seen_by(step_, end, collider.body, each.point));
    }
    Vec3 force = each.force;
    if (side[0].plane) std::swap(side[0], side[1]), force = -force;
    Touch touch{.a = side[0], .b = side[1], .friction = law.friction, .lowest = touches_.size()};
    const double normal = each.force.dot(each.normal);
    touch.slides =
        (force - force.dot(each.normal) * each.normal).norm() >= (1 - on_cone) * law.friction * normal;
    touch.across = each.normal.unitOrthogonal();
    touches_.push_back(touch);
    told_.push_back(force);
  }

  void find_lowest(const Placement& end) {
    const auto gap = [&](std::size_t k) { return touching_at(step_, end, touches_[k]).gap; };
    for (Touch& touch : touches_)
      for (std::size_t k = 0; k < touches_.size(); ++k)
        if (touches_[k].a.body == touch.a.body && touches_[k].b.body == touch.b.body &&
            gap(k) < gap(touch.lowest))
          touch.lowest = k;
  }

  Vec3 law(const Touch& touch, double normal, const Eigen::Vector2d& slip, const Vec3& force) const {
    if (!touch.slides) return {normal, slip.x(), slip.y()};
    const double speed = slip.norm(), hover = law_ == Friction::cone ? touch.friction * speed : 0;
    const Eigen::Vector2d held = force.tail<2>() + touch.friction * force.x() * slip / speed;
    return {normal - hover, held.x(), held.y()};
  }

  RigidStep step_;
  Friction law_;
  std::vector<Touch> touches_;
  std::vector<Vec3> told_;  // N, forces on a
};

/// Central differences of f, one column for each component of `at`.
Eigen::MatrixXd differences(const std::function<Vector(const Vector&)>& f, const Vector& at) {
  constexpr double share = 1e-5;  // rounding and the third derivative then leave about 1e-10
  Eigen::MatrixXd columns;
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    const double step = share * std::max(1.0, std::abs(at[i]));
    const Vector change = step * Vector::Unit(at.size(), i);
    const Vector column = (f(at + change) - f(at - change)) / (2 * step);
    if (i == 0) columns.resize(column.size(), at.size());
    columns.col(i) = column;
  }
  return columns;
}

/// Newton's method on F(v, gamma, r; v) = 0; the last correction as judge.h measures it.
double solve_step(const LinearisedStep& f, Vector& all) {
  constexpr int most = 20;
  constexpr double settled = 1e-13;
  const auto whole = [&f](const Vector& at) { return f(at, at.head(f.velocities())); };
  double correction = infinity;
  for (int k = 0; k < most && !(correction <= settled); ++k) {
    const Vector change = solve(differences(whole, all), Vector(whole(all)));
    all -= change;
    const Vector moved = f.step().h * change.head(f.velocities()).cwiseProduct(f.step().model.radius);
    correction = moved.cwiseAbs().maxCoeff() / displacement_of(f.step(), all.head(f.velocities()));
  }
  return correction;
}

double margin_of(const LinearisedStep& f, const Vector& all) {
  const Vector v = all.head(f.velocities());
  const Placement at = f.step().placement(v);
  double most = 0, margin = infinity;
  for (std::size_t k = 0; k < f.touches().size(); ++k) most = std::max(most, all[f.force_at(k)]);
  for (std::size_t k = 0; k < f.touches().size(); ++k) {
    const Touch& touch = f.touches()[k];
    const TouchingAt here = touching_at(f.step(), at, touch);
    const Eigen::MatrixXd rows = rows_of(f.step(), at, touch, here, here.point_a);
    const Vec3 force = all.segment<3>(f.force_at(k));
    const double state = touch.slides ? (rows * v).tail<2>().norm() / v.cwiseAbs().maxCoeff()
                                      : 1 - force.tail<2>().norm() / (touch.friction * force.x());
    const double level = touching_at(f.step(), at, f.touches()[touch.lowest]).gap;
    const double apart =
        touch.lowest == k ? infinity : (here.gap - level) / f.step().h / v.cwiseAbs().maxCoeff();
    margin = std::min({margin, state, force.x() / most, apart});
  }
  return margin;
}

}  // namespace

ContactContraction plain_contraction_of_contacts(const StepClaim& claim) {
  if (claim.friction != Friction::coulomb && claim.friction != Friction::cone)
    throw SetupError(where, "another law of friction", "coulomb or cone");
  Scene scene = claim.scene;
  for (Effect& effect : scene.effects)
    if (std::holds_alternative<Contact>(effect)) effect = ExternalForce{};
  RigidStep step{make_rigid_model(scene), claim.start, claim.h};
  if (step.model.gyroscopic != GyroscopicTorque::none)
    throw SetupError(where, "gyroscopic torques", "a scene without");
  const LinearisedStep f(claim, std::move(step));
  Vector all = f.claimed(claim);
  ContactContraction found;
  found.solved.correction = solve_step(f, all);
  const Vector v = all.head(f.velocities());
  State end = f.step().end(v);
  found.solved.x = std::move(end.x), found.solved.v = std::move(end.v);
  found.solved.orientation = std::move(end.orientation), found.solved.spin = std::move(end.spin);
  for (const Touch& touch : f.touches()) ++(touch.slides ? found.sliding : found.sticking);
  found.margin = margin_of(f, all);
  constexpr double accurate = 1e-12;
  constexpr double clear = 1e-4;  // ten times what differences change
  found.rate = {std::nan(""), std::nan("")};
  if (!(found.solved.correction <= accurate)) {
    found.solved.reason = "Newton's method does not settle";
    return found;
  }
  found.solved.outcome = Outcome::ok;
  if (!(found.margin > clear)) return found;
  const Eigen::MatrixXd by_end = differences([&](const Vector& at) { return f(at, v); }, all);
  const Eigen::MatrixXd by_iterate = differences([&](const Vector& w) { return f(all, w); }, v);
  found.rate = extremes(Eigen::MatrixXd(-solve(by_end, by_iterate).topRows(f.velocities())));
  return found;
}

}  // namespace pbd::reference
