// Counts heap allocations by taking malloc's place, so not under sanitizers, which do the same.
#if !defined(__SANITIZE_ADDRESS__)

#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>

#include "scenes.h"
#include "step/integrators.h"

namespace {
std::atomic<long> allocations{0};
}

extern "C" {
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)

void* malloc(std::size_t bytes) {
  ++allocations;
  return __libc_malloc(bytes);
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
  ++allocations;
  return __libc_memalign(alignment, bytes);
}
}

using namespace pbd;
using namespace pbd::test;

namespace {

/// Allocations of five steps after the first one.
long allocations_of(const Scene& scene, const Method& method) {
  Workspace workspace(scene, method);
  State state = scene.initial;
  step(workspace, 0.001, state);
  const long before = allocations;
  for (int frame = 0; frame < 5; ++frame) step(workspace, 0.001, state);
  return allocations - before;
}

/// A solid, a sheet and an anchor: every kind of rows, hard and compliant ones, with damping and without.
Scene all_rows() {
  Scene scene = cantilever(8, {1e5, 0.3}, Strain::corotational);
  std::get<TetStrain>(scene.effects[1]).damping = Material{10, 0.3};
  const TriangleMesh mesh = grid_sheet({6, 6}, {1, 1});
  const int first = add_sheet_nodes(scene, mesh, 0.2);
  scene.effects.emplace_back(sheet_links(mesh, first, 0));
  scene.effects.emplace_back(sheet_strain(mesh, first, {1e5, 0.3}, 1e-3));
  auto bending = sheet_bending(mesh, first, 1e2);
  bending.damping.assign(bending.node.size(), 0.001);
  scene.effects.emplace_back(std::move(bending));
  scene.effects.emplace_back(Anchor{.node = {first}, .target = {Vec3::Zero()}, .compliance = {0.0}});
  return scene;
}

}  // namespace

TEST_CASE("the counter counts") {
  const long before = allocations;
  std::vector<double> numbers(1000);
  numbers[7] = 1;
  CHECK(numbers[7] == 1);
  CHECK(allocations > before);
}

TEST_CASE("a step allocates nothing on the heap after the first frame") {
  const std::string relaxation = GENERATE("gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients");
  // auto may come to need proximal in a later frame
  const std::string outer = GENERATE("plain", "incremental", "frozen", "proximal");
  Method method;
  method.relaxation = relaxation;
  method.outer = outer;
  method.max_outer = 5;
  INFO(relaxation << " " << outer);
  CHECK(allocations_of(all_rows(), method) == 0);
}

TEST_CASE("no integrator allocates after the first frame, whatever its history and its directions") {
  const double blend = GENERATE(1.0, 0.5);
  const std::string outer = GENERATE("plain", "proximal");
  const Scene scene = all_rows();
  for (const auto& integrator : integrators()) {
    Method method;
    method.integrator = integrator.name;
    method.direction_blend = blend;
    method.outer = outer;
    method.max_outer = 5;
    INFO(integrator.name << ", " << outer << ", blend " << blend);
    CHECK(allocations_of(scene, method) == 0);
  }
}

#endif
