// Not under sanitizers, whose allocator is another.
#if !defined(__SANITIZE_ADDRESS__)

#include "harness/allocated_memory.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <future>
#include <vector>

#include "harness/trajectory.h"
#include "scenes/standard.h"

using namespace pbdcheck;

namespace {

/// What two iterations of a step of a chain take: memory, and the bytes of its rows, both in MB.
struct Taken {
  double memory_mb, rows_mb;
};

Taken taken_by_chain(int links, const std::string& relaxation) {
  SceneFile file;
  file.scene = chain(links);
  Setting setting{.by_count = true};
  setting.method.relaxation = relaxation;
  setting.method.max_outer = setting.method.max_sweeps = 2;
  const double h = 1e-3;
  return {step_memory_mb(file, h, setting, file.scene.initial),
          static_cast<double>(trajectory(file, h, setting).bytes) / 1e6};
}

/// Of vectors of so many bytes each.
double memory_of_vectors(std::size_t count, std::size_t bytes) {
  std::vector<std::vector<char>> all(count);
  const AllocatedMemory memory;
  for (auto& each : all) each.resize(bytes);
  return memory.megabytes();
}

}  // namespace

TEST_CASE("allocated memory is what was asked for, but for a head of each piece and the rest of a page") {
  const double head = 32e-6, page = static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
  const auto on_new_thread = [](std::size_t count, std::size_t bytes) {
    return std::async(std::launch::async, memory_of_vectors, count, bytes).get();
  };
  const std::size_t large = 64'000'000;  // is mapped apart, whatever was freed before
  CHECK(on_new_thread(1, large) >= 64);
  CHECK(on_new_thread(1, large) <= 64 + page + head);
  CHECK(on_new_thread(100, 1000) >= 0.1);
  CHECK(on_new_thread(100, 1000) <= 0.1 + 100 * head);
}

TEST_CASE("the memory of a step holds its rows, and grows with a scene by more than they do") {
  const auto* relaxation = GENERATE("gauss_seidel", "conjugate_gradients", "direct");
  INFO(relaxation);
  const Taken small = taken_by_chain(500, relaxation), large = taken_by_chain(1000, relaxation);
  CHECK(small.rows_mb > 0);
  CHECK(small.memory_mb >= small.rows_mb);
  // Nothing in a workspace is smaller where the scene is twice as large.
  CHECK(large.memory_mb - small.memory_mb >= large.rows_mb - small.rows_mb);
}

TEST_CASE("the memory of a step is the same again, whatever was freed before") {
  // A piece is up to 16 bytes larger than asked for where no more than that would be left of what it is cut
  // from; the least one has 32.
  const double before = taken_by_chain(4, "direct").memory_mb;
  for (std::size_t bytes = 24; bytes <= 1032; bytes += 16) memory_of_vectors(10, bytes);
  const double after = taken_by_chain(4, "direct").memory_mb;
  CHECK(after <= 1.5 * before);
  CHECK(before <= 1.5 * after);
}

#endif
