// Scene files that come with the program, beside what statics and a closed form say of them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "program.h"
#include "results.h"
#include "scenes/standard.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

namespace {

/// What a scene's probes say at the end of each step, all of which are ok and none refuted.
class Probed {
 public:
  explicit Probed(const std::string& scene) {
    const TemporaryFolder folder;
    const auto ran = run_program({"simulate", scenes / (scene + ".toml"), "--check", "-o", folder.path});
    INFO(scene << "\n" << ran.err);
    REQUIRE(ran.exit_code == 0);
    CHECK_THAT(ran.out, Catch::Contains("none refuted"));
    CHECK_THAT(ran.err, !Catch::Contains("missed"));
    rows_ = rows_of(folder.path / "probes.csv");
  }

  std::size_t steps() const { return rows_.size() - 2; }
  double at(std::size_t step, const std::string& column) const {
    const auto& names = rows_.front();
    const auto place = std::find(names.begin(), names.end(), column) - names.begin();
    return std::stod(rows_.at(step + 1).at(static_cast<std::size_t>(place)));
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// How far what sticks may creep, m: in each step one of `bodies` alike may keep all that is not solved of
/// what gravity brings them.
double creep(double tolerance, double h, std::size_t steps, double bodies) {
  return static_cast<double>(steps) * tolerance * std::sqrt(bodies) * gravity * h * h;
}

}  // namespace

// Twelve links hold ((1 + mu t)/(1 - mu t))^12 times the load, t = tan(pi/24).
TEST_CASE("the rope over the drum holds as much as its links may, and slides beyond that") {
  const Probed rope("capstan");
  const double t = 0.3 * std::tan(std::numbers::pi / 24), ratio = std::pow((1 + t) / (1 - t), 12);
  const double reached = 0.2 + 0.2 * (ratio / 2 - 1) / 0.5;  // s: the pull grows from 2 N to 3 N in 0.2 s
  const double start = rope.at(0, "pulled_z_m");
  for (std::size_t k = 0; k <= rope.steps(); ++k)
    if (rope.at(k, "time_s") <= reached)
      REQUIRE(std::abs(rope.at(k, "pulled_z_m") - start) <= creep(1e-8, 0.005, k, 29));
  CHECK(rope.at(rope.steps(), "pulled_z_m") < start - 1e-3);
}

TEST_CASE("the house of cards stands") {
  const Probed house("house_of_cards");
  for (const auto* column : {"upper_first_x_m", "upper_first_y_m", "upper_first_z_m"})
    CHECK(std::abs(house.at(house.steps(), column) - house.at(0, column)) <=
          creep(1e-6, 0.005, house.steps(), 7));
}

TEST_CASE("the table carries the soft cards at rest") {
  const Probed house("house_of_soft_cards");
  const double weight = 3 * 0.012 * gravity;  // three cards of 4 x 60 x 100 mm, 500 kg/m^3
  CHECK(-house.at(house.steps(), "table_contact_force_z_n") == Approx(weight).epsilon(1e-4));
  CHECK(std::abs(house.at(house.steps(), "kinetic_energy_j")) <= 1e-9);
}

TEST_CASE("the mass on the bar moves up and down at the bar's slowest frequency with it") {
  const Probed bar("mass_on_bar");
  std::vector<double> turns;  // s, of the passages down through the middle
  const double middle = -0.55 - gravity * (8 + 2 / 2.0) * 0.5 / (1e6 * 0.0025);
  for (std::size_t k = 1; k <= bar.steps(); ++k) {
    const double before = bar.at(k - 1, "mass_z_m") - middle, after = bar.at(k, "mass_z_m") - middle;
    if (before > 0 && after <= 0)
      turns.push_back(bar.at(k - 1, "time_s") + 0.005 * before / (before - after));
  }
  REQUIRE(turns.size() == 8);
  const double rate = 2 * std::numbers::pi * 7 / (turns.back() - turns.front());
  const double k_l = rate * 0.5 / std::sqrt(1e6 / 1600);
  CHECK(k_l * std::tan(k_l) == Approx(2.0 / 8).epsilon(std::pow(rate * 0.005, 2)));  // order 2 in the step
}
