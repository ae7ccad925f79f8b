#include "threads/threads.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "linear/linear_solver.h"
#include "planted_rows.h"
#include "rows/chunks.h"
#include "scenes/contacts.h"
#include "step/step.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("tasks are done once each, whatever the threads") {
  for (const int threads : {1, 2, 5}) {
    std::vector<std::atomic<int>> done(1000);
    each_task(threads, done.size(), [&](std::size_t k) { ++done[k]; });
    CHECK(std::all_of(done.begin(), done.end(), [](const auto& count) { return count == 1; }));
  }
}

TEST_CASE("tasks of a group begin when those of the one before are done, whatever the threads") {
  constexpr int groups = 200;
  std::vector<int> first;
  for (int g = 0; g <= groups; ++g) first.push_back(g * (g + 1) / 2);  // group g of g + 1 tasks
  for (const int threads : {1, 2, 5}) {
    std::atomic<int> done = 0, early = 0;
    std::vector<int> count(static_cast<std::size_t>(first.back()));
    each_of_groups(threads, first, [&](std::size_t k) {
      const int begin = *std::prev(std::upper_bound(first.begin(), first.end(), static_cast<int>(k)));
      early += done < begin;
      ++count[k];
      ++done;
    });
    CHECK(early == 0);
    CHECK(std::all_of(count.begin(), count.end(), [](int times) { return times == 1; }));
  }
}

TEST_CASE("sums are those of their parts in order, whatever the threads") {
  std::vector<double> term(100'000);
  for (std::size_t k = 0; k < term.size(); ++k) term[k] = 1.0 / static_cast<double>(k + 1);
  const auto sum_on = [&](int threads) {
    double sum = 0;
    add_parts(threads, term.size(), sum, [&](std::size_t first, std::size_t last, double& own) {
      for (std::size_t k = first; k < last; ++k) own += term[k];
    });
    return sum;
  };
  const double harmonic = std::log(1e5) + std::numbers::egamma + 0.5e-5;  // to 1e-11
  CHECK(sum_on(1) == Approx(harmonic).epsilon(1e-12));
  CHECK(sum_on(1) == sum_on(2));
  CHECK(sum_on(1) == sum_on(7));
}

TEST_CASE("chunks of one colour share no column, but fixed ones where these are shared") {
  constexpr int columns = 500, of_each = 3, constraints = 4000;
  constexpr std::size_t length = 20;
  const bool fixed_are_shared = GENERATE(false, true);
  const int spread = GENERATE(5, 400);  // neighbours, or nearly any
  std::mt19937 random(7);
  std::vector<double> inverse_mass(columns, 1.0);
  for (int column = 0; column < columns; column += 10) inverse_mass[static_cast<std::size_t>(column)] = 0;
  std::vector<int> column;
  for (int i = 0; i < constraints * of_each; ++i)
    column.push_back(static_cast<int>(
        (static_cast<unsigned>(i) / 24 + random() % static_cast<unsigned>(spread)) % columns));
  Chunks chunks;
  divide(column, of_each, length, inverse_mass, fixed_are_shared, chunks);
  REQUIRE(std::set(chunks.order.begin(), chunks.order.end()).size() == constraints / length);
  REQUIRE(chunks.order.size() == constraints / length);
  REQUIRE(chunks.colour.front() == 0);
  REQUIRE(chunks.colour.back() == static_cast<int>(chunks.order.size()));
  for (std::size_t c = 0; c + 1 < chunks.colour.size(); ++c) {
    std::vector<int> owner(columns, -1);
    for (int k = chunks.colour[c]; k < chunks.colour[c + 1]; ++k) {
      const int chunk = chunks.order[static_cast<std::size_t>(k)];
      for (std::size_t n = 0; n < length * of_each; ++n) {
        const auto own =
            static_cast<std::size_t>(column[static_cast<std::size_t>(chunk) * length * of_each + n]);
        if (fixed_are_shared && inverse_mass[own] == 0) continue;
        CHECK((owner[own] < 0 || owner[own] == chunk));
        owner[own] = chunk;
      }
    }
  }
}

TEST_CASE("coloured Gauss-Seidel finds a planted solution in an order of its own") {
  Planted solid(cantilever(16, {1e5, 0.3}, Strain::corotational));
  divide(solid.rows, 2);
  REQUIRE(std::get<RowBlock<6, 4>>(solid.rows.blocks.at(0)).chunks.colour.size() > 2);
  const auto coloured = errors(solid, "coloured_gauss_seidel", 2000);
  CHECK(coloured.back() < 1e-9);
  CHECK(coloured.front() != errors(solid, "gauss_seidel", 1).front());
}

TEST_CASE("coloured Gauss-Seidel goes through a single chunk as Gauss-Seidel does") {
  Planted links(chain(20, 3));
  divide(links.rows, 2);
  CHECK(errors(links, "coloured_gauss_seidel", 10) == errors(links, "gauss_seidel", 10));
}

namespace {

/// The state after some steps.
State stepped(const Scene& scene, Method method, int threads) {
  method.threads = threads;
  Workspace workspace(scene, method);
  State state = scene.initial;
  for (int k = 0; k < 4; ++k) step(workspace, 0.01, state);
  return state;
}

bool same(const State& a, const State& b) {
  return a.x == b.x && a.v == b.v && a.spin == b.spin;
}

}  // namespace

TEST_CASE("a step of a solid ends in the same bits on any number of threads") {
  const Scene solid = cantilever(8, {1e5, 0.3}, Strain::corotational);
  Method method;
  method.outer = GENERATE("plain", "proximal", "quasi_newton");
  method.relaxation = GENERATE("coloured_gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients");
  INFO(method.outer << " " << method.relaxation);
  method.max_outer = 10;
  method.max_sweeps = 20;
  const State one = stepped(solid, method, 1);
  CHECK(same(one, stepped(solid, method, 2)));
  CHECK(same(one, stepped(solid, method, 5)));
}

TEST_CASE("a step of boxes in contact ends in the same bits on any number of threads") {
  pbdcheck::BodyScene build({.friction = 0.5});
  build.ground();
  for (int k = 0; k < 128; ++k)  // eight by eight, two high, askew
    build.box({0.1, 0.1, 0.1}, 1 + k % 3,
              {.position = {0.105 * (k % 8), 0.105 * (k / 8 % 8), 0.05 + 0.1 * (k / 64)},
               .velocity = {0.1 * std::sin(k), 0.1 * std::cos(k), 0}});
  const Scene boxes = build.finish();
  Method method;
  method.relaxation = GENERATE("coloured_gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients");
  INFO(method.relaxation);
  method.max_outer = 3;
  method.max_sweeps = 30;
  const State one = stepped(boxes, method, 1);
  CHECK(same(one, stepped(boxes, method, 2)));
  CHECK(same(one, stepped(boxes, method, 5)));
}
