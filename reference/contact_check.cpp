#include "contact_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact_slack.h"

namespace pbd::reference {
namespace {

std::string name_of(int a, int b) {
  return "contact of " + std::to_string(a) + " and " + std::to_string(b);
}

void check_force(const StepClaim& claim, const ClaimedContact& c, const ContactSlack& open,
                 Findings& findings) {
  const std::string name = name_of(c.collider[0], c.collider[1]);
  const double slack = open.impulse / claim.h + step_rounding * c.force.norm();
  const double mu = open.law.friction * (claim.friction == Friction::box ? std::numbers::sqrt2 : 1.0);
  findings.require("contact pulls", name + ", N", -open.normal, slack);
  findings.require("friction", name + ", beyond the cone, N", open.friction.norm() - mu * open.normal,
                   (1 + mu) * slack);
}

/// `slack` is what a gap may be off, m.
void check_rebound(const StepClaim& claim, const ClaimedContact& c, const ContactSlack& open,
                   const Sides& sides, double slack, Findings& findings) {
  const int a = c.collider[0], b = c.collider[1];
  if (!is_euler_step(claim) || explicit_forces(claim) || open.law.compliance > 0 ||
      std::max(a, b) >= sides.count())
    return findings.leave_out("rebound: by this integrator, of what gives way, on surfaces");
  if (!(open.normal * claim.h > open.impulse) || c.gap <= slack) return;
  const auto approach = [&](const State& state) {
    return c.normal.dot(sides.velocity(a, c.point, state) - sides.velocity(b, c.point, state));
  };
  const double missed = claim.h * (approach(claim.end) + open.law.restitution * approach(claim.start));
  findings.require("rebound", name_of(a, b) + ", m", std::abs(missed), slack);
}

void check_gap(const StepClaim& claim, const ClaimedContact& c, const ContactSlack& open, const Sides& sides,
               Findings& findings) {
  const auto& [a, b] = c.collider;
  const std::string name = name_of(a, b) + ", m";
  const double size = claim.end.x.cwiseAbs().maxCoeff() + c.point.norm();
  const double slack =
      step_rounding * size + (1 + open.law.friction) * open.velocity * claim.h +
      (claim.friction == Friction::cone ? open.law.friction * open.slip.norm() * claim.h : 0);
  const bool surface = std::max(a, b) >= sides.count();
  double proved = -infinity;
  if (explicit_forces(claim)) {
    findings.leave_out("gap told: by this integrator");
  } else if (!surface) {
    proved = separation(sides.placed(a, claim.end), sides.placed(b, claim.end), c.normal);
    findings.require("gap told", name, proved - c.gap, step_rounding * size + open.velocity * claim.h);
  }
  if (claim.friction == Friction::cone && (surface || explicit_forces(claim)))
    return findings.leave_out("open contact: where the convex law opens it by a slip that is not known");
  if (open.law.restitution > 0) return check_rebound(claim, c, open, sides, slack, findings);
  if (open.normal * claim.h > open.impulse)
    findings.require("open contact", name, larger(c.gap, proved), slack);
}

void check_sliding(const StepClaim& claim, const ClaimedContact& c, const ContactSlack& open,
                   const Sides& sides, Findings& findings) {
  const double mu = open.law.friction;
  if (!(mu > 0)) return;
  if (!is_euler_step(claim) || explicit_forces(claim) || claim.friction == Friction::box)
    return findings.leave_out("sliding: by this integrator or law");
  if (std::max(c.collider[0], c.collider[1]) >= sides.count())
    return findings.leave_out("sliding: on surfaces");
  const double speed = open.slip.norm(), h = claim.h;
  const double bound = 2 * mu * (std::abs(open.normal) * h + open.impulse) * open.velocity +
                       (1 + mu) * speed * open.impulse + step_rounding * speed * c.force.norm() * h;
  findings.require("sliding", name_of(c.collider[0], c.collider[1]) + ", J",
                   h * (mu * open.normal * open.slip + speed * open.friction).norm(), bound);
}

/// Whether the scene lets bodies or nodes touch: `AllowedPairs` of a judge.
bool may_touch(const Scene& scene, const Contact& contact, const Side& a, const Side& b) {
  if (a.node == b.node) return false;
  const auto both = [&](const std::array<int, 2>& pair) {
    return pair == std::array{a.body, b.body} || pair == std::array{b.body, a.body};
  };
  if (std::any_of(contact.apart.begin(), contact.apart.end(), both)) return false;
  for (const Effect& effect : scene.effects) {
    const bool connects = std::visit(
        [&]<class E>(const E& own) {
          if constexpr (std::is_same_v<E, Attachment>) {
            for (std::size_t i = 0; i < own.node.size(); ++i)
              if ((own.node[i] == a.node && own.body[i] == b.body) ||
                  (own.node[i] == b.node && own.body[i] == a.body))
                return true;
          } else if constexpr (requires { own.body[0][1]; }) {
            return std::any_of(own.body.begin(), own.body.end(), both);
          }
          return false;
        },
        effect);
    if (connects) return false;
  }
  return true;
}

class Depths {
 public:
  Depths(const StepClaim& claim, const Contact& contact, double level, Findings& findings)
      : claim_(claim), contact_(contact), sides_(claim, contact), level_(level), findings_(findings) {}

  void check_all();

 private:
  void check(int i, int j);
  bool far(int i, int j, const PlacedShape& a, const PlacedShape& b) const;
  double allowed(int i, int j, const std::vector<Vec3>& ways) const;

  const StepClaim& claim_;
  const Contact& contact_;
  Sides sides_;
  double level_;
  Findings& findings_;
};

/// Quick: the balls around both do not touch.
bool Depths::far(int i, int j, const PlacedShape& a, const PlacedShape& b) const {
  const double reach = size_of(*a.shape).outer + size_of(*b.shape).outer;
  if (std::isfinite(reach)) return (a.frame.origin - b.frame.origin).norm() > reach;
  if (std::isinf(size_of(*a.shape).outer) && std::isinf(size_of(*b.shape).outer)) return true;
  return i == j;
}

double Depths::allowed(int i, int j, const std::vector<Vec3>& ways) const {
  const PlacedShape a = sides_.placed(i, claim_.start), b = sides_.placed(j, claim_.start);
  std::vector<Vec3> all = ways;
  for (const Vec3& way : ways_apart(a, b)) all.push_back(way);
  const double before = std::max(0.0, -separation(a, b, all));
  const Size one = size_of(*a.shape), two = size_of(*b.shape);
  const double round =
      std::min(sides_.is_node(i) ? infinity : one.round, sides_.is_node(j) ? infinity : two.round);
  constexpr double overlooked = 1e-4;  // of the round radius: what is documented of the search of contacts
  const auto reach = [](const Size& size) { return std::isfinite(size.outer) ? size.outer : 0.0; };
  const bool at_start = explicit_forces(claim_);
  const double inverse = sides_.inverse_mass(i, at_start ? sides_.longest_lever(i, j) : reach(one)) +
                         sides_.inverse_mass(j, at_start ? sides_.longest_lever(j, i) : reach(two));
  const double size = claim_.end.x.cwiseAbs().maxCoeff() + reach(one) + reach(two);
  return std::max(before, std::isfinite(round) ? overlooked * round : 0.0) +
         (1 + sides_.law(i, j).friction) * level_ * std::sqrt(inverse) * claim_.h + step_rounding * size;
}

void Depths::check(int i, int j) {
  const PlacedShape a = sides_.placed(i, claim_.end), b = sides_.placed(j, claim_.end);
  if (far(i, j, a, b) || !(sides_.inverse_mass(i, 1) + sides_.inverse_mass(j, 1) > 0)) return;
  if (!may_touch(claim_.scene, contact_, sides_.side(i), sides_.side(j))) return;
  const auto half_space = [](const PlacedShape& own) {
    return std::holds_alternative<HalfSpace>(*own.shape);
  };
  if (!(is_convex(*a.shape) && is_convex(*b.shape)) && !half_space(a) && !half_space(b))
    return findings_.leave_out("depth: closed meshes");
  const ContactLaw& law = sides_.law(i, j);
  if (law.compliance > 0) return findings_.leave_out("depth: where shapes give way");
  if (law.restitution > 0 && !is_euler_step(claim_))
    return findings_.leave_out("depth: where shapes bounce, by this integrator");
  std::vector<Vec3> ways;
  if (!half_space(a) && !half_space(b))
    for (const ClaimedContact& claimed : claim_.contacts) {
      if (claimed.collider == std::array{i, j}) ways.push_back(claimed.normal);
      if (claimed.collider == std::array{j, i}) ways.emplace_back(-claimed.normal);
    }
  const double most = allowed(i, j, ways);
  double apart = separation(a, b, ways);
  if (!(apart >= -most)) {
    for (const Vec3& way : ways_apart(a, b)) ways.push_back(way);
    if (!deeper_than(a, b, most, ways, apart)) apart = std::max(apart, -most);
  }
  findings_.require("depth", name_of(i, j) + ", m", -apart, most);
}

void Depths::check_all() {
  const auto colliders = static_cast<int>(contact_.collider.size());
  for (int i = 0; i < colliders; ++i)
    for (int j = i + 1; j < sides_.count(); ++j) check(i, j);
  if (!contact_.triangle.empty()) findings_.leave_out("depth: surfaces");
}

}  // namespace

void check_contacts(const StepClaim& claim, const Contact& contact, double level, Findings& findings) {
  const Sides sides(claim, contact);
  for (const ClaimedContact& claimed : claim.contacts) {
    const ContactSlack open = slack_of(claim, claimed, sides, level);
    check_force(claim, claimed, open, findings);
    check_gap(claim, claimed, open, sides, findings);
    check_sliding(claim, claimed, open, sides, findings);
  }
}

void check_depths(const StepClaim& claim, const Contact& contact, double level, Findings& findings) {
  Depths(claim, contact, level, findings).check_all();
}

}  // namespace pbd::reference
