// An elastic ball pressed on a rigid plane: the part of it about the contact, in tetrahedra, moved from its
// cut as a half space's far field is.
#include <cmath>

#include <fmt/format.h>

#include "closed_form_solids.h"
#include "ledger/families.h"
#include "ledger/solids.h"
#include "scenes/contacts.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

// A contact of 0.01 m, a thousandth of the ball's radius, within which Hertz takes the ball for a half space.
constexpr double hertz_radius = 10, hertz_depth = 1e-5;  // m
constexpr double hertz_contact = 0.01;                   // m: sqrt(R d)
constexpr double hertz_cut = 6;                          // contact radii
constexpr Material hertz_rubber{1e6, 0.3};
constexpr double hertz_step = 1;  // s: leaves 1/500^2 of motion, no mode is slower than 500 rad/s

double hertz_expected() {
  return reference::hertz_force(hertz_rubber.young, hertz_rubber.poisson, hertz_radius, hertz_depth);
}

/// Of lattice coordinates -1 to 1: finer in the middle by cosh(grading).
constexpr double grading = 2.5;
double graded(double s) {
  return hertz_cut * hertz_contact * std::sinh(grading * s) / std::sinh(grading);
}

/// Edge of a tetrahedron at the edge of the contact, over its radius; `cells` from the middle to the cut.
double coarseness(int cells) {
  return hertz_cut * grading / cells * std::hypot(1 / hertz_cut, 1 / std::sinh(grading));
}

/// The block of 2 x 2 x 1 `cells` above the plane, bent to the ball's surface; what is cut is moved down by
/// the depth and by what the force of the contact, as if in one point, lifts and widens there.
Scene ball_on_plane(int cells) {
  BodyScene build({.friction = 0}, 0);
  build.ground();
  Contact& contact = build.contact();
  TetMesh mesh = kuhn_grid({2 * cells, 2 * cells, cells}, Vec3(2, 2, 1), Vec3(-1, -1, 0));
  const Points lattice = mesh.x;
  mesh.x = lattice.unaryExpr(&graded);
  Points moved = Points::Zero(3, mesh.x.cols());
  std::vector<bool> cut;
  for (int node = 0; node < mesh.x.cols(); ++node) {
    const Vec3 x = mesh.x.col(node);
    const double r = std::hypot(x.x(), x.y());
    mesh.x(2, node) += r * r / (2 * hertz_radius);
    cut.push_back(lattice.col(node).cwiseAbs().maxCoeff() == 1);
    if (cut.back()) {
      const auto far = reference::point_load_displacement(hertz_rubber.young, hertz_rubber.poisson,
                                                          hertz_expected(), x.z(), r);
      moved.col(node).head<2>() = far.outwards * x.head<2>().normalized();
      moved(2, node) = far.inwards - hertz_depth;
    } else if (x.z() == 0) {
      contact.node.push_back(1 + node);
      contact.radius.push_back(0);
      contact.node_material.push_back(0);
    }
  }
  Scene scene = build.finish();
  const int first = add_solid(scene, mesh, 1000, hertz_rubber, Strain::linear);
  scene.initial.x.rightCols(moved.cols()) += moved;
  for (int node = 0; node < moved.cols(); ++node)
    if (cut[static_cast<std::size_t>(node)]) scene.mass[static_cast<std::size_t>(first + node)] = infinity;
  return scene;
}

/// The plane's force and where it acts, after one step from where only the cut is moved.
struct HertzPress {
  double force = 0;   // N, of the plane
  double square = 0;  // N m^2, with the squares of distances from the middle
  HertzPress(const Method& method, int cells) {
    Motion motion(ball_on_plane(cells), method);
    motion.advance(hertz_step);
    for (const ContactForce& each : motion.workspace.contacts()) {
      const double pressing = std::abs(each.force.z());
      force += pressing;
      square += pressing * each.point.head<2>().squaredNorm();
    }
  }
  /// Hertz's pressure falls as sqrt(1 - r^2/a^2): the mean of r^2 is 2/5 a^2.
  double contact_radius() const { return std::sqrt(2.5 * square / force); }
};

}  // namespace

void hertz(Ledger& rows) {
  Method method = direct_method();
  method.outer = "quasi_newton";
  method.tolerance = 1e-8;
  const double far = std::pow(hertz_cut, -3);
  const LedgerRow row{.unit = "N",
                      .formula = "4/3 E/(1 - nu^2) sqrt(R) d^(3/2)",
                      .method = method,
                      .expected = hertz_expected};
  for (const int cells : {8, 16}) {
    LedgerRow force = row, size = row;
    force.id = fmt::format("hertz.force_{}", cells);
    force.statement = "an elastic ball presses a plane by Hertz's force, and somewhat more on a mesh";
    force.quantity = "force";
    force.scene = fmt::format("contact of 1 cm of a ball of 10 m, 1e6 Pa, nu = 0.3, {0} x {0} x {1} bricks",
                              2 * cells, cells);
    force.bound = {.relative = std::pow(coarseness(cells), 2) + far,
                   .derivation =
                       "order 2 in the edges at the contact's edge, its constant taken as 1; the cut, "
                       "at 6 of its radii a, moved by the far field of Hertz's own force, leaves (a/6 a)^3"};
    force.run = [cells](const Method& by) { return HertzPress(by, cells).force; };
    force.tier = cells > 8 ? Tier::full : Tier::quick;
    size = force;
    size.id = fmt::format("hertz.radius_{}", cells);
    size.statement = "and its pressure is spread as Hertz's";
    size.quantity = "contact radius of the forces' mean square distance";
    size.unit = "m";
    size.formula = "sqrt(R d)";
    size.expected = [] { return std::sqrt(hertz_radius * hertz_depth); };
    size.run = [cells](const Method& by) { return HertzPress(by, cells).contact_radius(); };
    rows.push_back(std::move(force));
    rows.push_back(std::move(size));
  }
  for (const int coarse : {5, 8}) {
    LedgerRow limit = row;
    limit.id = fmt::format("hertz.limit_{}", coarse);
    limit.statement = "finer meshes approach Hertz's force";
    limit.quantity = "force";
    limit.scene = fmt::format("the same, {} and {} bricks from the middle to the cut", coarse, 2 * coarse);
    limit.bound = {.relative = std::pow(coarseness(2 * coarse), 3) + far,
                   .derivation =
                       "order 2, two meshes extrapolated: the finer one's edges over a, cubed, its constant "
                       "taken as 1; the cut"};
    limit.run = [coarse](const Method& by) {
      return extrapolated(
          [&](double width) { return HertzPress(by, static_cast<int>(std::lround(1 / width))).force; },
          1.0 / coarse, 2);
    };
    limit.tier = coarse > 5 ? Tier::full : Tier::quick;
    rows.push_back(std::move(limit));
  }
}

}  // namespace pbdcheck::ledger
