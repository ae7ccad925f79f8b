// Solids and cloth that fall and carry: stiff on soft and soft on stiff, knife edges, what is heavy on what
// is light.
#include <cmath>

#include <fmt/format.h>

#include "harness/files.h"
#include "harness/probes.h"
#include "scenes/mesh_file.h"
#include "studies/robustness/contact_cases.h"
#include "studies/robustness/relief.h"
#include "studies/robustness/soft_parts.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double mat_step = 0.025;  // s, of li2020incremental

/// Time (s) in which steps of h leave a millionth of a vibration with frequency `slowest` (rad/s).
double dying(double slowest, double h) {
  return h * 2 * std::log(1e6) / std::log1p(std::pow(slowest * h, 2));
}

ContactCase resting(std::string name, Scene scene, double h, double duration, double size) {
  const double carried = finite_mass(scene) * gravity;
  ContactCase made{std::move(name), std::move(scene), h, duration, size};
  made.reaction = carried;
  return made;
}

/// A board of 0.5 m and 2000 kg/m^3 falls by 1 cm on a mat, friction 0.1; the other way round.
ContactCase board_and_mat(double lower, double upper, int cells) {
  BodyScene build({.friction = 0.1});
  build.ground();
  Scene scene = build.finish();
  constexpr double thick = 0.1, thin = 0.05;  // m
  add_soft(scene, mat({cells, cells, 1}, {0.5, 0.5, thick}, {0, 0, half_thickness}), lower);
  add_soft(scene, mat({cells, cells, 1}, {0.4, 0.4, thin}, {0.01, 0.02, 4 * half_thickness + thick + 0.01}),
           upper, 2000);
  // The slowest: the board's mass on the shear of the mat.
  const double shear = std::min(lower, 1e6) / 2.6 / thick, mass = 2000 * thin * 0.4 * 0.4 / (0.5 * 0.5);
  return resting(fmt::format("board of {:.0e} Pa on a mat of {:.0e} Pa", upper, lower), std::move(scene),
                 mat_step, dying(std::min(std::sqrt(shear / mass), 20.0), mat_step), thin);
}

/// Two mats fall on the ground, one askew over the other.
ContactCase falling_mats(double young, int cells) {
  BodyScene build({.friction = 0.5});
  build.ground();
  Scene scene = build.finish();
  constexpr double thick = 0.1;
  for (const double height : {0.1, 0.4}) {
    TetMesh mesh = mat({cells, cells, 1}, {0.5, 0.5, thick}, Vec3::Zero());
    const Eigen::AngleAxisd turn(height, Vec3(0.3, 0.2, 1).normalized());
    mesh.x = (turn.toRotationMatrix() * mesh.x).colwise() + Vec3(0, 0, height);
    add_soft(scene, mesh, young);
  }
  ContactCase made =
      resting(fmt::format("two falling mats, {:.0e} Pa", young), std::move(scene), mat_step, 2, thick);
  made.settles = young >= 1e4;  // a softer one flows
  if (!made.settles) made.reaction = -1;
  return made;
}

/// A rigid plate a thousand times as heavy on a soft cube whose Poisson's ratio is 0, so that it is strained
/// evenly: by `strain` if that is small, (W + m/2) g/(E A) with the cube's own weight m g, of which
/// no more than half counts.
ContactCase heavy_plate(double strain, int cells) {
  constexpr double side = 0.2, ratio = 1000, half_height = 0.025;
  const double own = 1000 * side * side * side, plate = ratio * own, area = side * side;
  const double young = plate * gravity / (area * strain);
  BodyScene build({.friction = 0.5});
  build.ground();
  build.box(Vec3(side, side, 2 * half_height), plate, {Vec3(0, 0, 2 * half_thickness + side + half_height)});
  Scene scene = build.finish();
  add_touching_solid(scene, mat({cells, cells, cells}, Vec3::Constant(side), {0, 0, half_thickness}), 1000,
                     {young, 0}, Strain::corotational);
  ContactCase made{fmt::format("plate on a cube, 1000:1, {:.1e} Pa", young), std::move(scene), mat_step,
                   strain < 1 ? dying(std::sqrt(gravity / (strain * side)), mat_step) : 1, side};
  made.settles = strain < 1;
  if (!made.settles) return made;
  made.reaction = (plate + own) * gravity;
  made.exact_to = own / (2 * plate);
  made.missed = [=](const State& end, double, std::int64_t) {
    const double shorter = (plate + own / 2) * gravity * side / (young * area);
    const double height = 2 * half_thickness + side - shorter + half_height;
    return std::abs(end.x(2, 1) - height) / shorter;
  };
  return made;
}

/// A mat of 2e4 Pa falls on edges, or points, that stand in rows 0.2 m apart.
ContactCase on_blades(bool edges, int rows) {
  BodyScene build({.friction = 0.5});
  build.ground();
  constexpr double depth = 0.3, thick = 0.05;
  const Eigen::Quaterniond upwards(0, 1, 0, 0);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j)
      build.fixed(pointed(edges, depth),
                  {Vec3(0.2 * (i - 0.5 * (rows - 1)), 0.2 * (j - 0.5 * (rows - 1)), depth / 3), upwards});
  Scene scene = build.finish();
  const double side = 0.2 * rows;
  add_soft(scene, mat({2 * rows, 2 * rows, 1}, {side, side, thick}, {0.013, 0.007, depth + 0.01}), 2e4);
  return {fmt::format("mat on {0} x {0} {1}", rows, edges ? "knife edges" : "pins"), std::move(scene), 0.04,
          2, thick};
}

/// A soft cube of 8 kg on a rigid box of 8 g on cloth that is held at its corners.
ContactCase soft_on_rigid_on_cloth(double young, double h, double duration, int cells) {
  BodyScene build({.friction = 0.5});
  constexpr double height = 0.05;
  build.box(Vec3(0.25, 0.25, height), 0.008, {Vec3(0, 0, half_thickness + height / 2)});
  Scene scene = build.finish();
  add_held_cloth(scene, 6, 1, 0.5, 1e-4);
  add_soft(scene, mat({cells, cells, cells}, Vec3::Constant(0.2), {0.01, 0.02, 2 * half_thickness + height}),
           young);
  ContactCase made{fmt::format("soft cube on a box on cloth, 1000:1, {:.0e} Pa, h = {:.2g} s", young, h),
                   std::move(scene), h, duration, height};
  made.settles = false;
  return made;
}

/// The soft cow on four rigid boxes, all of them a thousandth as heavy, on cloth that is held at its corners.
ContactCase cow_on_boxes_on_cloth(double young, double h) {
  BodyScene build({.friction = 0.5});
  TetMesh cow = read_tet_mesh(scenes_folder() / "meshes/cow.msh");
  constexpr double height = 0.05, density = 1000;
  double volume = 0;
  for (const auto& tet : cow.tets) volume += tet_volume(cow.x(Eigen::all, tet));
  const Vec3 low = cow.x.rowwise().minCoeff(), high = cow.x.rowwise().maxCoeff();
  cow.x.colwise() -= Vec3((low.x() + high.x()) / 2, (low.y() + high.y()) / 2, low.z());
  cow.x.row(2).array() += 2 * half_thickness + height;
  for (const double x : {-0.26, 0.26})
    for (const double y : {-0.13, 0.13})
      build.box(Vec3(0.5, 0.25, height), density * volume / 4000, {Vec3(x, y, half_thickness + height / 2)});
  Scene scene = build.finish();
  add_held_cloth(scene, 8, 1.6, 0.5, 1e-5);
  add_soft(scene, cow, young, density);
  ContactCase made{fmt::format("soft cow on boxes on cloth, 1000:1, {:.0e} Pa, h = {:.2g} s", young, h),
                   std::move(scene), h, 1, height};
  made.settles = false;
  return made;
}

/// Hard links along the sides of squares, held at two corners, fall over a ball.
ContactCase hard_grid(int cells, double duration) {
  BodyScene build({.friction = 0.5});
  build.fixed(Sphere{0.2}, {Vec3(0, 0, -0.25)});
  Scene scene = build.finish();
  const int first = add_touching_cloth(scene, grid_sheet({cells, cells}, {1, 1}, {-0.5, -0.5, 0}), 0.2, 0);
  auto& links = std::get<Distance>(scene.effects.back());
  Distance sides;  // with the diagonals it would be as stiff as a plate
  for (std::size_t i = 0; i < links.node.size(); ++i)
    if (links.rest_length[i] < 1.2 / cells) {
      sides.node.push_back(links.node[i]);
      sides.rest_length.push_back(links.rest_length[i]);
      sides.compliance.push_back(0);
    }
  links = sides;
  for (const int corner : {0, cells}) scene.mass[static_cast<std::size_t>(first + corner)] = infinity;
  ContactCase made{fmt::format("{0} x {0} squares of hard links over a ball", cells), std::move(scene),
                   video_frame, duration, 1.0 / cells};
  made.settles = false;
  return made;
}

/// A ball of 1e8 Pa falls on a mat of 1e6 Pa.
ContactCase ball_on_mat(int cells) {
  BodyScene build({.friction = 0.5});
  build.ground();
  Scene scene = build.finish();
  constexpr double thick = 0.1, radius = 0.1;
  add_soft(scene, mat({cells, cells, 1}, {0.5, 0.5, thick}, {0, 0, half_thickness}), 1e6);
  add_soft(scene, soft_ball(4, radius, {0.01, 0.02, thick + radius + 0.05}), 1e8);
  ContactCase made{"ball of 1e8 Pa on a mat of 1e6 Pa", std::move(scene), mat_step, 1, thick};
  made.settles = false;  // it may roll
  return made;
}

}  // namespace

std::vector<ContactCase> soft_cases(bool full) {
  std::vector<ContactCase> all;
  const int cells = full ? 3 : 2;
  for (const auto& [lower, upper] : {std::pair{1e4, 1e8}, {1e8, 1e4}})
    if (full || lower < upper) all.push_back(board_and_mat(lower, upper, cells));
  for (const double young : {1e2, 1e4, 1e6, 1e8})
    if (full) all.push_back(falling_mats(young, 2));
  const ContactCase plate = heavy_plate(0.05, full ? 2 : 1);
  all.push_back(plate);
  if (full) all.push_back(heavy_plate(100, 1));
  for (const bool edges : {true, false}) all.push_back(on_blades(edges, full ? 5 : 3));
  for (const double young : {1e3, 1e4, 1e5, 1e6, 1e7})
    for (const double h : {1.0 / 30, video_frame, 1.0 / 600})
      if (young == 1e5 ? full || h == video_frame : full && h == video_frame)
        all.push_back(soft_on_rigid_on_cloth(young, h, full ? 1 : 0.25, 2));
  if (full)
    for (const auto& [young, h] : {std::pair{1e3, video_frame},
                                   {1e5, 1.0 / 30},
                                   {1e5, video_frame},
                                   {1e5, 1.0 / 600},
                                   {1e7, video_frame},
                                   {1e9, video_frame}})
      all.push_back(cow_on_boxes_on_cloth(young, h));
  all.push_back(hard_grid(full ? 6 : 4, full ? 1 : 0.25));
  if (full) all.push_back(ball_on_mat(cells));
  ContactCase rigid{"pile", pile(), 0.01, 1, 0.05};
  rigid.settles = false;
  for (const ContactCase& each : {rigid, plate})
    for (const auto& [length, mass] : {std::pair{1e-3, 1e-6}, {1e3, 1e6}, {1e-3, 1e6}, {1e3, 1e-6}})
      if (full || (each.name == "pile" && (length < 1) == (mass < 1)))
        all.push_back(in_other_units(each, length, mass));
  return all;
}

}  // namespace pbdcheck
