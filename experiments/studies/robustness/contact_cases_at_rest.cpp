// Scenes that stand, or fall where they should: heavy on light, cards, arches, more places of contact than
// rest determines.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "harness/probes.h"
#include "scenes/arch.h"
#include "studies/robustness/contact_cases.h"

namespace pbdcheck {
namespace {

using namespace pbd;

using std::numbers::pi;

ContactCase at_rest(std::string name, Scene scene, double h, double duration, double size) {
  const double carried = finite_mass(scene) * gravity;
  return {std::move(name), std::move(scene), h, duration, size, true, true, -1, carried};
}

/// Made the same way as what stands.
ContactCase falls(ContactCase standing) {
  ContactCase made = std::move(standing);
  made.settles = made.stays = false;
  made.falls = true;
  made.reaction = -1;
  return made;
}

/// A cube of 1 m and 1e4 kg/m^3 on one of 0.1 m and 1e3 kg/m^3 (li2020incremental, figure 12, as rigid
/// bodies).
ContactCase heavy_cube() {
  BodyScene build({.friction = 0.5});
  build.ground();
  build.box(Vec3::Constant(0.1), 1, {Vec3(0, 0, 0.05)});
  build.box(Vec3::Constant(1), 1e4, {Vec3(0, 0, 0.6)});
  return at_rest("heavy cube on a small one, 1e4:1", build.finish(), 0.025, 1, 0.1);
}

/// Box2D's HighMassRatio1: a pyramid whose top box is `ratio` times as dense.
ContactCase heavy_top(int base, double ratio, double duration) {
  Scene scene = pyramid(base);
  const auto top = static_cast<std::size_t>(scene.bodies.back().node);
  scene.mass[top] *= ratio;
  scene.bodies.back().inertia *= ratio;
  return at_rest(fmt::format("pyramid of base {} with a top {}:1", base, ratio), std::move(scene),
                 video_frame, duration, 0.2);
}

/// Box2D's HighMassRatio2: 400:1 dropped on two small boxes.
ContactCase dropped_box() {
  BodyScene build({.friction = 0.5});
  build.ground();
  for (const double x : {-9.0, 9.0}) build.box(Vec3::Constant(1), 1, {Vec3(x, 0, 0.5)});
  build.box(Vec3(20, 4, 20), 400, {Vec3(0, 0, 11 + 15)});
  return {"box of 400:1 dropped on two small ones", build.finish(), video_frame, 4, 1};
}

ContactCase heavy_cylinder(double mass) {
  BodyScene build({.friction = 0.5});
  build.ground();
  build.box(Vec3::Constant(0.5), 1, {Vec3(0, 0, 0.25)});
  build.cylinder(0.5, 1, mass, {Vec3(0, 0, 1)});
  return at_rest(fmt::format("cylinder of {:g} kg on a cube of 1 kg", mass), build.finish(), video_frame, 1,
                 0.5);
}

/// A leaning card of 1 m: how far its corners are from its centre, m.
struct Card {
  static constexpr double length = 1, thickness = 0.02, width = 0.5;
  double lean;  // rad, from upright
  double half_height = (length * std::cos(lean) + thickness * std::sin(lean)) / 2;
  double half_width = (length * std::sin(lean) + thickness * std::cos(lean)) / 2;
};

/// A card that leans on a smooth wall at `degrees` from the ground. The wall pushes m g (cot -
/// thickness/length)/2 (moments about the edge on the ground), which the ground's friction holds up to mu m
/// g.
ContactCase leaning_card(double degrees, double beyond_limit) {
  const Card card{(90 - degrees) * pi / 180};
  const double limit = (std::tan(card.lean) - Card::thickness / Card::length) / 2;
  BodyScene build({});
  build.materials(2, {.friction = limit + beyond_limit});
  build.law(0, 1, {.friction = 0});
  build.ground();
  build.fixed(Box{Vec3(0.2, 1, 2)}, {Vec3(card.half_width + 0.1, 0, 1)}, 1);
  build.box(Vec3(Card::thickness, Card::width, Card::length), 0.1,
            {Vec3(0, 0, card.half_height), about_y(card.lean)});
  ContactCase made = at_rest(
      fmt::format("card on a smooth wall, {:g} degrees, mu {:+g} off the limit", degrees, beyond_limit),
      build.finish(), 0.01, 2, Card::thickness);
  return beyond_limit > 0 ? made : falls(std::move(made));
}

/// An arch `share` times as thick as it has to be.
ContactCase arch(int stones, double share) {
  const double thickness = share * limit_thickness(stones);
  ContactCase made = at_rest(fmt::format("arch of {} stones, {:g} of the limit thickness", stones, share),
                             Arch{thickness, stones}.scene(), 0.01, 3, thickness);
  return share > 1 ? made : falls(std::move(made));
}

/// A body of a top and four legs without mass: how they share the weight is not determined.
ContactCase table() {
  BodyScene build({.friction = 0.5});
  build.ground();
  constexpr double height = 0.7, leg = 0.05;
  const int top = build.box(Vec3(1, 1, leg), 10, {Vec3(0, 0, height + leg / 2)});
  for (const double x : {-0.4, 0.4})
    for (const double y : {-0.4, 0.4})
      build.contact().collider.push_back(
          {Box{Vec3(leg, leg, height)}, top, {Vec3(x, y, -(height + leg) / 2)}, 0});
  return at_rest("table on four legs", build.finish(), video_frame, 1, leg);
}

/// A-frames of two cards each, `levels` high, floors between them (65 degrees, friction 0.5).
ContactCase card_house(int levels) {
  BodyScene build({.friction = 0.5});
  build.ground();
  constexpr double mass = 0.1, thickness = Card::thickness, width = Card::width;
  const Card card{25 * pi / 180};  // its lower outer corner on the floor, its upper inner one at the middle
  double floor = 0;
  for (int level = levels; level >= 1; --level) {
    for (int k = 0; k < level; ++k) {
      const double middle = (2 * k - (level - 1)) * 2 * card.half_width;
      for (const double side : {-1.0, 1.0})
        build.box(
            Vec3(thickness, width, Card::length), mass,
            {Vec3(middle + side * card.half_width, 0, floor + card.half_height), about_y(-side * card.lean)});
    }
    floor += 2 * card.half_height;
    for (int k = 0; k + 1 < level; ++k)
      build.box(Vec3(4 * card.half_width, width, thickness), mass,
                {Vec3((2 * k - (level - 2)) * 2 * card.half_width, 0, floor + thickness / 2)});
    floor += thickness;
  }
  return at_rest(fmt::format("house of cards, {} levels", levels), build.finish(), 0.01, 2, thickness);
}

/// A slab on a grid of fixed cubes: `side` x `side` places where it touches.
ContactCase slab(int side) {
  BodyScene build({.friction = 0.5});
  build.ground();
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) build.fixed(Box{Vec3::Constant(0.05)}, {Vec3(i * 0.1, j * 0.1, 0.025)});
  build.box(Vec3(0.1 * side, 0.1 * side, 0.1), 10, {Vec3(0.05 * (side - 1), 0.05 * (side - 1), 0.1)});
  ContactCase made =
      at_rest(fmt::format("slab on {} cubes", side * side), build.finish(), video_frame, 1, 0.1);
  made.reaction = -1;  // the cubes carry it
  return made;
}

}  // namespace

std::vector<ContactCase> cases_at_rest(bool full) {
  std::vector<ContactCase> all;
  all.push_back(heavy_cube());
  for (const double ratio : {100.0, 200.0, 300.0})
    if (full || ratio == 300) all.push_back(heavy_top(full ? 10 : 5, ratio, full ? 10 : 1));
  all.push_back(dropped_box());
  for (const double mass : {60.0, 100.0}) all.push_back(heavy_cylinder(mass));
  all.push_back(at_rest("cubes, each twice as heavy", column(10, 2), video_frame, 1, 0.2));
  for (const double degrees : {60.0, 75.0})
    for (const double beyond_limit : {0.01, -0.01}) all.push_back(leaning_card(degrees, beyond_limit));
  for (const int levels : {2, 3, 4})
    if (full || levels == 2) all.push_back(card_house(levels));
  for (const int stones : {7, 25})
    for (const double share : {1.02, 0.98})
      if (full || stones == 7) all.push_back(arch(stones, share));
  all.push_back(table());
  for (const int side : {2, 4, 10})
    if (full || side < 4) all.push_back(slab(side));
  return all;
}

}  // namespace pbdcheck
