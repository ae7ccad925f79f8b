#include "outer/contact_merit.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace pbd;

namespace {

constexpr double mu = 0.3, pressed = 0.5;  // N s

/// One node in touch, whose rows are its velocity.
Rows one_contact(Friction law, double compliance) {
  RowBlock<3, 1> block;
  block.resize_contacts(1);
  block.node[0] = {0};
  block.jacobian[0].setIdentity();
  block.bias[0].setZero();
  block.compliance.set(0, compliance);
  block.impulse[0] = {pressed, 0, 0};
  block.friction[0] = mu;
  block.law = law;
  Rows rows;
  rows.inverse_mass = {1};
  rows.blocks.add(std::move(block));
  return rows;
}

/// J, what the contacts add to the potential at v, or a share of the way there, from rest. By bisection: the
/// largest potential that is no leap is 2 at_rest less it.
double added(const Rows& rows, const Points& v, double share = 1) {
  const std::vector<bool> eliminated{false};
  constexpr double at_rest = 10;
  ContactMerit merit;
  merit.begin(rows, eliminated, at_rest, Points::Zero(3, 1));
  ContactMerit::Sliding sliding;
  ContactMerit::find_sliding(rows, eliminated, v, sliding);
  double stays = 0, leaps = 2 * at_rest;
  while (leaps - stays > 1e-9) {
    const double middle = (stays + leaps) / 2;
    (merit.leaps(rows, eliminated, middle, v, sliding, share) ? leaps : stays) = middle;
  }
  return 2 * at_rest - stays;
}

}  // namespace

TEST_CASE("the merit of iterates under contacts weighs what is passed and what slides") {
  const Points closing = Vec3(-2, 3, 4), opening = Vec3(2, 3, 4);
  const double sliding = mu * 5, most = 2 * pressed;
  CHECK(added(one_contact(Friction::coulomb, 0), closing) == Approx(most * 2 + pressed * sliding));
  CHECK(added(one_contact(Friction::coulomb, 0), opening) == Approx(pressed * sliding));
  CHECK(added(one_contact(Friction::coulomb, 0), opening, 0.5) == Approx(pressed * sliding / 2));
  CHECK(added(one_contact(Friction::box, 0), opening) == Approx(pressed * mu * 7));
  CHECK(added(one_contact(Friction::cone, 0), closing) == Approx(most * (2 + sliding)));
  // A spring of compliance 4 is pressed by 2/4, one of 0.1 by no more than is weighed.
  CHECK(added(one_contact(Friction::coulomb, 4), closing) == Approx(2 * 2 / (2 * 4.0) + pressed * sliding));
  CHECK(added(one_contact(Friction::coulomb, 0.1), closing) ==
        Approx(most * 2 - 0.1 * most * most / 2 + pressed * sliding));
}

TEST_CASE("no merit of iterates under contacts that is not a number is taken") {
  const std::vector<bool> eliminated{false};
  const Rows rows = one_contact(Friction::coulomb, 0);
  const Points rest = Points::Zero(3, 1);
  ContactMerit merit;
  merit.begin(rows, eliminated, 1, rest);
  CHECK_FALSE(merit.leaps(rows, eliminated, 2, rest, {0}, 1));
  CHECK(merit.leaps(rows, eliminated, NAN, rest, {0}, 1));
}
