// What contacts carry: a rope over a drum, weights, balls on a box that is pushed.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "closed_form_contact.h"
#include "harness/contact_sums.h"
#include "ledger/families.h"
#include "ledger/motion.h"
#include "studies/contact/contact_answers.h"
#include "studies/contact/simbenchmark.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

constexpr double drum = 0.1, speed = 1e-4, h = 1e-4;  // m, m/s, s: a step moves nothing worth the name

Vec3 on_drum(double angle) {
  return drum * Vec3(std::cos(angle), std::sin(angle), 0);
}
Vec3 tangent(double angle) {
  return Vec3(-std::sin(angle), std::cos(angle), 0);
}

/// A chain of hard links with `links` light nodes on a drum, turning by `angle` in all; its first end is
/// pulled back by 1 N, the last one drawn on. Effect 2 is the chain.
Scene rope(double friction, double angle, int links) {
  const double turn = angle / links, chord = 2 * drum * std::sin(turn / 2);
  BodyScene build({.friction = friction}, 0);
  build.fixed(Cylinder{drum, 1}, {Vec3::Zero()});
  Contact& contact = build.contact();
  for (int i = 1; i <= links; ++i) {
    contact.node.push_back(i + 1);
    contact.radius.push_back(0);
    contact.node_material.push_back(0);
  }
  Scene scene = build.finish();
  constexpr double light = 0.1;  // kg: m v^2/r is a hundred millionth of the tension
  const Vec3 first = tangent(-turn / 2), last = tangent((links - 0.5) * turn);
  add_node(scene, on_drum(0) - 10 * drum * first, light, speed * std::cos(turn / 2) * first);
  for (int i = 0; i < links; ++i) add_node(scene, on_drum(i * turn), light, speed * tangent(i * turn));
  add_node(scene, on_drum((links - 1) * turn) + 10 * drum * last, infinity,
           speed * std::cos(turn / 2) * last);
  Distance chain;
  for (int i = 0; i <= links; ++i) {
    chain.node.push_back({i + 1, i + 2});
    chain.rest_length.push_back(i == 0 || i == links ? 10 * drum : chord);
    chain.compliance.push_back(0);
  }
  scene.effects.emplace_back(std::move(chain));
  scene.effects.emplace_back(ExternalForce{{1}, {-first}});
  return scene;
}

double tension_ratio(const Method& method, double friction, double angle, int links) {
  Motion motion(rope(friction, angle, links), method);
  motion.advance(h);
  const auto tension = motion.workspace.forces(3);
  return tension.back() / tension.front();
}

void rope_rows(Ledger& rows) {
  constexpr int links = 32;
  rows.push_back(
      {.id = "capstan.links",
       .statement = "links that slide over a drum hold as each node's equilibrium says",
       .quantity = "ratio of the tensions",
       .unit = "1",
       .formula = "((1 + mu t)/(1 - mu t))^n, t = tan(angle/(2 n))",
       .scene = "32 links over half a turn, friction 0.5",
       .method = direct_method(),
       .bound = {.relative = 1e-6, .derivation = "way of a step over the drum's radius 1e-8; tolerance"},
       .expected = [] { return reference::capstan_ratio_of_links(0.5, std::numbers::pi, links); },
       .run = [](const Method& method) { return tension_ratio(method, 0.5, std::numbers::pi, links); }});
  for (const auto& [mu, turns] : {std::pair{0.1, 0.5},
                                  {0.2, 0.5},
                                  {0.2, 1.0},
                                  {0.3, 0.25},
                                  {0.3, 0.5},
                                  {0.3, 1.0},
                                  {0.5, 0.5},
                                  {0.5, 1.0}}) {
    const double friction = mu, angle = 2 * std::numbers::pi * turns;
    rows.push_back({.id = fmt::format("capstan.rope_{:g}_{:g}", friction, turns),
                    .statement = "ever shorter links over a drum approach a rope",
                    .quantity = "ratio of the tensions",
                    .unit = "1",
                    .formula = "exp(mu angle)",
                    .scene = fmt::format("32 and 64 links over {:g} turns, friction {:g}", turns, friction),
                    .method = direct_method(),
                    .bound = {.relative = std::pow(angle / links, 4),
                              .derivation = "order 2 in the link, 32 and 64 extrapolated: (angle/32)^4"},
                    .expected = [=] { return reference::capstan_ratio(friction, angle); },
                    .run =
                        [=](const Method& method) {
                          return extrapolated(
                              [&](double link) {
                                return tension_ratio(method, friction, angle,
                                                     static_cast<int>(std::lround(1 / link)));
                              },
                              1.0 / links, 2);
                        }});
  }
}

// ---- weights

double ground_force(const Scene& scene, const Method& method, int body) {
  Motion motion(scene, method);
  motion.advance(contact_h, 5);
  return contact_force(*contact_of(scene), motion.workspace.contacts(), body, 0).force.z();
}

void weight_rows(Ledger& rows) {
  const LedgerRow row{.quantity = "force of the ground",
                      .unit = "N",
                      .method = patient_method("conjugate_gradients"),
                      .bound = {.relative = 1e-8, .derivation = "exact at rest; tolerance"}};
  LedgerRow box = row, two = row;
  box.id = "weight.box";
  box.statement = "the ground carries a box by its corners together";
  box.formula = "m g";
  box.scene = "box of 4 kg on the ground";
  box.expected = [] { return 4 * gravity; };
  box.run = [](const Method& method) { return ground_force(sliding_box(0, 0.5, 0), method, 1); };
  two.id = "weight.column";
  two.statement = "and the cube on a cube a hundred times lighter";
  two.formula = "(m + M) g";
  two.scene = "cube of 800 kg on one of 8 kg";
  two.expected = [] { return 808 * gravity; };
  two.run = [](const Method& method) { return ground_force(column(2, 100), method, 1); };
  rows.push_back(std::move(box));
  rows.push_back(std::move(two));
}

// ---- SimBenchmark: 25 balls on a box that is pushed at 60 degrees to the axes

void pushed_rows(Ledger& rows) {
  constexpr double angle = std::numbers::pi / 3, time = 0.1;
  const Vec3 along(std::cos(angle), std::sin(angle), 0);
  const double on_ball = (150 - 137.34) / 10 / (3.5 + 2.5);  // N, at 1 kg a ball and 10 kg of box
  struct Case {
    const char *id, *law, *quantity, *formula;
    int body;
    double expected;
  };
  const double box = (150 - 137.34 - 25 * on_ball) / 10;
  for (const Case& c : {Case{"box", "coulomb", "acceleration of the box", "(F - f1 - 25 f2)/M", 1, box},
                        {"ball", "coulomb", "acceleration of a ball", "f2/m", 2, on_ball},
                        {"box_law", "box", "acceleration of the box", "(F - f1 - 25 f2)/M", 1, box}}) {
    LedgerRow row{
        .id = fmt::format("weight.pushed_{}", c.id),
        .statement = "a box that is pushed from under balls moves, and they roll on it",
        .quantity = c.quantity,
        .unit = "m/s^2",
        .formula = c.formula,
        .source = "kang2018simbenchmark",
        .scene = "25 balls of 1 kg on a box of 10 kg, 150 N at 60 degrees, 0.1 s",
        .method = contact_method("conjugate_gradients", c.law),
        .bound = {.relative = 1e-6, .derivation = "velocities are exact; tolerance of 1e2 contacts"},
        .expected = [c] { return c.expected; },
        .run =
            [=](const Method& method) {
              const Benchmark made = rolling_balls(angle, "xy");
              return along.dot(state_after(made.scene, method, contact_h, 10).v.col(c.body)) / time;
            }};
    if (std::string_view(c.law) == "box")
      row.deviation = {"the law box: neither 75 N nor 130 N along an axis exceeds its 137 N",
                       [] { return 0.0; }};
    rows.push_back(std::move(row));
  }
}

}  // namespace

void carried(Ledger& rows) {
  rope_rows(rows);
  weight_rows(rows);
  pushed_rows(rows);
}

}  // namespace pbdcheck::ledger
