// How a frame's time grows with the scene, from an eighth of the paper's scenes to eight times them: until
// the first iterate (contacts found, rows made), and then by iterations, of which there may be more, and each
// may take longer.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/order_fit.h"
#include "harness/processor_time.h"
#include "studies/cost/sized_scenes.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// s: until the first one strikes, until most have come to rest, and the end; the quick tier ends before.
struct Times {
  double strikes, quick_end, rests, end;
};
constexpr std::array<Times, 3> times{{{0.2, 0.7, 2, 3}, {0.1, 0.2, 2, 3}, {0.2, 0.6, 1.5, 2}}};

/// Of the frames of one part of a motion.
struct Part {
  std::int64_t frames = 0, missed = 0, iterations = 0, contacts = 0, rows = 0;
  double begin = 0, iterating = 0;  // s

  /// A frame.
  double mean(double sum) const { return sum / static_cast<double>(frames); }
  double iterations_a_frame() const { return mean(static_cast<double>(iterations)); }
  double seconds() const { return mean(begin + iterating); }
  double an_iteration() const { return iterating / static_cast<double>(iterations); }
};
constexpr std::array<std::string_view, 4> part_names{"begins", "falls", "strikes", "rests"};
using Parts = std::array<Part, part_names.size()>;

void add_frame(Part& part, Workspace& workspace, double h, State& state) {
  const double start = processor_seconds();
  double first = start;
  const Report report = step(workspace, h, state, [&](const Iterate& iterate) {
    if (iterate.outer_iteration == 0) first = processor_seconds();
  });
  ++part.frames;
  part.missed += report.status != Status::ok;
  part.iterations += report.outer_iterations;
  part.begin += first - start;
  part.iterating += processor_seconds() - first;
  part.contacts += std::ssize(workspace.contacts());
  for (const EffectCost& cost : workspace.costs()) part.rows += cost.rows;
}

/// The first frame, which sets up what all use, is a part of its own.
std::size_t part_at(double time, const Times& until) {
  if (time == 0) return 0;
  return time < until.strikes ? 1 : time < until.rests ? 2 : 3;
}

Parts run(const SceneFile& file, const Times& until, double end) {
  Parts parts;
  Workspace workspace = file.workspace();
  State state = file.scene.initial;
  while (state.time < end - file.step_s / 2) {
    throw_if_interrupted();
    add_frame(parts[part_at(state.time, until)], workspace, file.step_s, state);
  }
  return parts;
}

/// The slope of log y over log x and twice its standard error, by least squares.
Measured exponent_of(const std::vector<double>& x, const std::vector<double>& y) {
  const double slope = fitted_order(x, y), count = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, squared = 0, left = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    mean_x += std::log(x[i]) / count, mean_y += std::log(y[i]) / count;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = std::log(x[i]) - mean_x;
    squared += dx * dx;
    left += std::pow(std::log(y[i]) - mean_y - slope * dx, 2);
  }
  const double spread = 2 * std::sqrt(left / (count - 2) / squared);
  return Measured({slope - spread, slope, slope + spread});
}

/// An exponent that falls below 0 is within any bound; a verdict's size is not negative.
Measured not_negative(const Measured& exponent) {
  const auto cut = [](double value) { return value < 0 ? 0 : value; };  // what is no number stays so
  return Measured({cut(exponent.low), cut(exponent.value), cut(exponent.high)});
}

struct FrameQuantity {
  std::string_view name;
  double (*of)(const Part&);
};
constexpr std::array<FrameQuantity, 5> frame_quantities{
    {{"frame", [](const Part& part) { return part.seconds(); }},
     {"until the first iterate", [](const Part& part) { return part.mean(part.begin); }},
     {"iterations", [](const Part& part) { return part.iterations_a_frame(); }},
     {"an iteration", [](const Part& part) { return part.an_iteration(); }},
     {"rows", [](const Part& part) { return part.mean(static_cast<double>(part.rows)); }}}};

/// The parts of one scene that have frames, over its sizes.
struct Growth {
  std::string scene;
  std::vector<double> sizes{};
  std::vector<Parts> parts{};

  bool has(std::size_t part) const { return parts.front()[part].frames > 0; }
};

Growth measured_growth(Context& context, std::size_t scene, int largest) {
  Growth growth{std::string(sized_names[scene])};
  for (int level = least_level; level <= largest; ++level) {
    const SizedScene sized = sized_scene(growth.scene, level, context.directory());
    const Times& until = times[scene];
    growth.sizes.push_back(static_cast<double>(sized.size));
    growth.parts.push_back(run(sized.file, until, context.full() ? until.end : until.quick_end));
    context.advance(fmt::format("{} {}", growth.scene, sized.size));
  }
  return growth;
}

void add_frames(Table& table, const Growth& growth, std::size_t p) {
  for (std::size_t i = 0; i < growth.sizes.size(); ++i) {
    const Part& part = growth.parts[i][p];
    table.row({growth.scene, std::string(part_names[p]), static_cast<std::int64_t>(growth.sizes[i]),
               part.frames, part.missed, part.mean(static_cast<double>(part.contacts)),
               part.mean(static_cast<double>(part.rows)), part.iterations_a_frame(), part.seconds(),
               part.mean(part.begin), part.an_iteration(),
               std::string(part.missed == 0 ? "ok" : "not_converged"),
               part.missed == 0 ? "" : fmt::format("{} of {} frames missed", part.missed, part.frames)});
  }
}

/// All exponents of a part, and the verdict on the frame's.
void add_exponents(Context& context, Table& table, const Growth& growth, std::size_t p) {
  for (const FrameQuantity& quantity : frame_quantities) {
    std::vector<double> values;
    for (const Parts& parts : growth.parts) values.push_back(quantity.of(parts[p]));
    const Measured exponent = exponent_of(growth.sizes, values);
    table.row({growth.scene, std::string(part_names[p]), std::string(quantity.name), exponent.value,
               exponent.low, exponent.high});
    if (quantity.name != "frame") continue;
    context.verdict(Basis::goal, fmt::format("frame_scaling.{}.{}", growth.scene, part_names[p]),
                    "a frame's time grows with at most the power 1.1 of the scene",
                    fmt::format("exponent, {} where it {}, from {:g} to {:g}", growth.scene, part_names[p],
                                growth.sizes.front(), growth.sizes.back()),
                    not_negative(exponent), 1.1);
  }
}

}  // namespace

void frame_scaling(Context& context) {
  const int largest = context.full() ? most_level : 0;
  context.begin(std::ssize(sized_names) * (largest - least_level + 1));
  Table frames = context.table(
      "frames", {"scene", "part", "size", "frames", "missed_frames", "contacts", "rows", "iterations",
                 "frame_cpu_s", "begin_cpu_s", "iteration_cpu_s", "status", "reason"});
  Table exponents = context.table("exponents", {"scene", "part", "quantity", "exponent", "low", "high"});
  for (std::size_t scene = 0; scene < sized_names.size(); ++scene) {
    const Growth growth = measured_growth(context, scene, largest);
    for (std::size_t p = 0; p < part_names.size(); ++p) {
      if (!growth.has(p)) continue;
      add_frames(frames, growth, p);
      add_exponents(context, exponents, growth, p);
    }
  }
  frames.close();
  exponents.close();
}

}  // namespace pbdcheck
