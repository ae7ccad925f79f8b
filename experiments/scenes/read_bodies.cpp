// Tables of cloth and solids: a grid or a mesh file, its material, its place and motion, what holds it.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <functional>
#include <numeric>

#include "boundary.h"
#include "scenes/builder.h"
#include "scenes/mesh_file.h"

namespace pbdcheck {
namespace {

/// The mesh file of a table that has no grid.
std::filesystem::path own_mesh_path(Keys& keys) {
  for (const auto* key : {"cells", "size_m"})
    if (keys.has(key)) keys.refuse(key, "a grid and a mesh file", "either file, or cells and size_m");
  return mesh_path(keys);
}

template <std::size_t K>
std::array<int, K> cells(Keys& keys, int elements_a_cell, Builder& builder) {
  const auto found = keys.integers("cells", 1);
  if (found.size() != K) keys.refuse("cells", fmt::format("a list of {} integers >= 1", K));
  builder.reserve(keys, "cells",
                  std::accumulate(found.begin(), found.end(), double(elements_a_cell), std::multiplies<>()));
  std::array<int, K> counts{};
  std::copy(found.begin(), found.end(), counts.begin());
  return counts;
}

pbd::TetMesh solid_mesh(Keys& keys, Builder& builder) {
  if (!keys.has("file")) {
    const auto size = keys.numbers("size_m", 3, Range::positive);
    return pbd::kuhn_grid(cells<3>(keys, 6, builder), {size[0], size[1], size[2]});
  }
  auto mesh = read_tet_mesh(own_mesh_path(keys));
  builder.reserve(keys, "file", static_cast<double>(mesh.tets.size()));
  return mesh;
}

pbd::TriangleMesh cloth_mesh(Keys& keys, Builder& builder) {
  if (!keys.has("file")) {
    const auto size = keys.numbers("size_m", 2, Range::positive);
    return pbd::grid_sheet(cells<2>(keys, 2, builder), {size[0], size[1]});
  }
  auto mesh = read_triangle_mesh(own_mesh_path(keys));
  builder.reserve(keys, "file", static_cast<double>(mesh.triangles.size()));
  return mesh;
}

/// Moves the rest shape: scale, then rotation about the origin by |rotation_rad| about its axis, then
/// translation.
void place(Keys& keys, pbd::Points& x) {
  const double scale = keys.number_or("scale", 1, Range::positive);
  const Eigen::Matrix3d rotation = read_rotation(keys);
  const pbd::Vec3 translation = keys.vector_or("translation_m", pbd::Vec3::Zero());
  if (scale != 1) x *= scale;
  x = rotation * x;
  x.colwise() += translation;
  if (!(x.cwiseAbs().maxCoeff() <= largest_number))
    throw pbd::SetupError(keys.where(), "positions beyond 1e100 m", "positions up to 1e100 m in size");
}

/// Refuses masses that overflow, which would fix their nodes, or vanish.
void require_masses(const Keys& keys, const pbd::Scene& scene, const NodeRange& range) {
  for (int node = range.first; node < range.first + range.count; ++node) {
    const double mass = scene.mass[static_cast<std::size_t>(node)];
    if (!(mass > 0 && mass <= largest_number))
      throw pbd::SetupError(keys.where(), fmt::format("mass {} kg of node {}", mass, node - range.first),
                            "sizes and densities that make masses > 0, up to 1e100 kg");
  }
}

/// Velocities of a rigid motion: velocity_m_s of the centre of mass, angular_velocity_rad_s about it.
void set_velocity(Keys& keys, pbd::Scene& scene, const NodeRange& range) {
  const pbd::Vec3 velocity = keys.vector_or("velocity_m_s", pbd::Vec3::Zero());
  const pbd::Vec3 spin = keys.vector_or("angular_velocity_rad_s", pbd::Vec3::Zero());
  pbd::Vec3 moment = pbd::Vec3::Zero();
  double total = 0;
  for (int node = range.first; node < range.first + range.count; ++node) {
    const double mass = scene.mass[static_cast<std::size_t>(node)];
    moment += mass * scene.initial.x.col(node);
    total += mass;
  }
  const pbd::Vec3 centre = moment / total;
  for (int node = range.first; node < range.first + range.count; ++node)
    scene.initial.v.col(node) = velocity + spin.cross(pbd::Vec3(scene.initial.x.col(node)) - centre);
}

/// The sub-tables `fixed` (infinite mass, at rest) and `anchored` (an Anchor, possibly compliant).
void hold(Keys& keys, Builder& builder, const NodeRange& range) {
  for (auto& fixed : keys.tables("fixed")) {
    for (const int node : select_nodes(fixed, builder.scene, range)) {
      double& mass = builder.scene.mass[static_cast<std::size_t>(node)];
      if (mass == pbd::infinity)
        throw pbd::SetupError(fixed.where(), fmt::format("node {} fixed twice", node - range.first), "once");
      mass = pbd::infinity;
      builder.scene.initial.v.col(node).setZero();
    }
    fixed.refuse_unknown();
  }
  auto tables = keys.tables("anchored");
  if (tables.empty()) return;
  pbd::Anchor anchor;
  for (auto& anchored : tables) {
    const double compliance = read_compliance(anchored), damping = read_damping(anchored);
    const std::size_t first_anchor = anchor.node.size();
    builder.anchor(anchored, select_nodes(anchored, builder.scene, range), compliance, anchor);
    set_damping(anchor, first_anchor, damping);
    anchored.refuse_unknown();
  }
  builder.add(tables[0].line(), std::move(anchor));
}

double read_poisson(Keys& keys) {
  const double poisson = keys.number("poisson", Range::finite);
  if (poisson <= -1 || poisson >= 0.5)
    keys.refuse("poisson", fmt::format("{}", poisson), "-1 < poisson < 0.5");
  return poisson;
}

/// The moduli of the sub-table `damping`, none if it is absent.
std::optional<pbd::Material> read_viscosity(Keys& keys) {
  auto damping = keys.table("damping");
  if (!damping) return std::nullopt;
  const pbd::Material moduli{damping->number("young_pa_s", Range::positive), read_poisson(*damping)};
  damping->refuse_unknown();
  return moduli;
}

void add_cloth_effects(Keys& keys, const pbd::TriangleMesh& mesh, int first, Builder& builder) {
  if (auto links = keys.table("links")) {
    auto effect = pbd::sheet_links(mesh, first, read_compliance(*links));
    set_damping(effect, 0, read_damping(*links));
    builder.add(links->line(), std::move(effect));
    links->refuse_unknown();
  }
  if (auto strain = keys.table("strain")) {
    const double young = strain->number("young_pa", Range::positive_or_infinite);
    const double thickness = strain->number("thickness_m", Range::positive);
    auto effect = pbd::sheet_strain(mesh, first, {young, read_poisson(*strain)}, thickness);
    effect.damping = read_viscosity(*strain);
    builder.add(strain->line(), std::move(effect));
    strain->refuse_unknown();
  }
  if (auto bending = keys.table("bending")) {
    const double compliance = bending->number_or("compliance_rad_per_n_m", 0, Range::not_negative);
    auto effect = located(mesh_name(keys), [&] { return pbd::sheet_bending(mesh, first, compliance); });
    set_damping(effect, 0, read_damping(*bending));
    builder.add(bending->line(), std::move(effect));
    bending->refuse_unknown();
  }
}

}  // namespace

void read_cloths(Keys& root, Builder& builder) {
  for (auto& keys : root.tables("cloth")) {
    pbd::TriangleMesh mesh = cloth_mesh(keys, builder);
    place(keys, mesh.x);
    const double density = keys.number("area_density_kg_m2", Range::positive);
    const int first =
        located(mesh_name(keys), [&] { return pbd::add_sheet_nodes(builder.scene, mesh, density); });
    const NodeRange range{first, static_cast<int>(mesh.x.cols())};
    require_masses(keys, builder.scene, range);
    set_velocity(keys, builder.scene, range);
    add_cloth_effects(keys, mesh, first, builder);
    hold(keys, builder, range);
    read_node_contact(keys, builder, range, mesh.triangles);
    keys.refuse_unknown();
  }
}

void read_solids(Keys& root, Builder& builder) {
  const auto names = std::vector<std::string>(pbd::strain_names.begin(), pbd::strain_names.end());
  for (auto& keys : root.tables("solid")) {
    pbd::TetMesh mesh = solid_mesh(keys, builder);
    place(keys, mesh.x);
    const double density = keys.number("density_kg_m3", Range::positive);
    const double young = keys.number("young_pa", Range::positive);
    const auto strain = keys.choice_or("strain", "corotational", names);
    const auto index = std::find(names.begin(), names.end(), strain) - names.begin();
    const pbd::Material material{young, read_poisson(keys)};
    const int first = located(mesh_name(keys), [&] {
      return pbd::add_solid(builder.scene, mesh, density, material, static_cast<pbd::Strain>(index));
    });
    std::get<pbd::TetStrain>(builder.scene.effects.back()).damping = read_viscosity(keys);
    builder.add(keys.line(), std::move(builder.scene.effects.back()));
    builder.scene.effects.pop_back();
    const NodeRange range{first, static_cast<int>(mesh.x.cols())};
    require_masses(keys, builder.scene, range);
    set_velocity(keys, builder.scene, range);
    hold(keys, builder, range);
    if (keys.has("contact")) read_node_contact(keys, builder, range, pbd::boundary(mesh));
    keys.refuse_unknown();
  }
}

}  // namespace pbdcheck
