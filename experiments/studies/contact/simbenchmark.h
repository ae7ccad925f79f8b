// The parts of `simbenchmark`: its scenes, and what was published of five engines (kang2018simbenchmark).
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

#include "scene.h"

namespace pbdcheck {

/// A scene and the error of a state of it.
struct Benchmark {
  std::string name;
  pbd::Scene scene;
  double duration;         // s
  std::string integrator;  // that suits it
  std::function<double(const pbd::State&)> error;
};

/// A box with balls on it is pushed in the direction at `angle` (rad) from x.
Benchmark rolling_balls(double angle, const std::string& variant);
Benchmark bouncing_balls();
/// 6 x 6 x 6 balls that fall together; elastic ones from 1 m higher.
Benchmark cube_of_balls(bool elastic);

struct Published {
  std::string_view benchmark, engine;
  double step, error, seconds;  // seconds for the whole run, NaN where not given
};

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// ERP 0; rolling by the default number of iterations or 1000 (kang2018simbenchmark, data of 2018).
inline constexpr std::array published{
    Published{"rolling_xy", "RaiSim", 1e-3, 4.14e-7, 0.31},
    Published{"rolling_xy", "Bullet", 1e-3, 5.7e-9, 0.56},
    Published{"rolling_xy", "ODE quick", 1e-3, 3.14497, 0.72},
    Published{"rolling_xy", "DART", 1e-3, 3.14497, 2.8},
    Published{"rolling_xy", "MuJoCo Newton", 1e-3, 6.9e-3, 1.8},
    Published{"rolling_y", "RaiSim", 1e-3, 4.1e-7, 0.31},
    Published{"rolling_y", "Bullet", 1e-3, 4.9e-9, 0.56},
    Published{"rolling_y", "ODE quick", 1e-3, 7.7e-9, 0.72},
    Published{"rolling_y", "DART", 1e-3, 0.4259, 2.8},
    Published{"rolling_y", "MuJoCo Newton", 1e-3, 6.4e-3, 1.8},
    Published{"bouncing", "RaiSim", 1e-4, 1.86e-6, not_given},
    Published{"bouncing", "ODE", 1e-4, 1.85, not_given},
    Published{"bouncing", "Bullet", 1e-4, 752, not_given},
    Published{"bouncing", "DART", 1e-4, 483, not_given},
    Published{"bouncing", "RaiSim", 1e-3, 1.86e-2, 0.235},
    Published{"bouncing", "ODE", 1e-3, 185, 1.86},
    Published{"bouncing", "Bullet", 1e-3, 7.52e4, 0.85},
    Published{"bouncing", "DART", 1e-3, 7.23e4, 3.2},
    Published{"bouncing", "RaiSim", 1e-2, 186, not_given},
    Published{"bouncing", "ODE", 1e-2, 1.88e4, not_given},
    Published{"bouncing", "Bullet", 1e-2, 7.41e6, not_given},
    Published{"bouncing", "DART", 1e-2, 7.38e6, not_given},
    Published{"666", "RaiSim", 1e-4, 1.64e-6, not_given},
    Published{"666", "ODE", 1e-4, 1.55e-6, not_given},
    Published{"666", "DART Dantzig", 1e-4, 1.98e-7, not_given},
    Published{"666", "Bullet", 1e-4, 3.5e-3, not_given},
    Published{"666", "MuJoCo Newton", 1e-4, 1.13e-2, not_given},
    Published{"666", "RaiSim", 1e-3, 1.35e-4, 1.5},
    Published{"666", "ODE", 1e-3, 1.55e-4, 10},
    Published{"666", "DART Dantzig", 1e-3, 2.8e-4, 23},
    Published{"666", "Bullet", 1e-3, 0.382, 12},
    Published{"666", "MuJoCo Newton", 1e-3, 9.5e-2, 12},
    Published{"666", "RaiSim", 1e-2, 1.53e-2, not_given},
    Published{"666", "ODE", 1e-2, 1.61e-2, not_given},
    Published{"666", "DART Dantzig", 1e-2, 215, not_given},
    Published{"666", "Bullet", 1e-2, 37.4, not_given},
    Published{"666", "MuJoCo Newton", 1e-2, 0.934, not_given},
    Published{"elastic_666", "RaiSim", 1e-4, 1.1e-3, not_given},
    Published{"elastic_666", "ODE", 1e-4, 1.10, not_given},
    Published{"elastic_666", "Bullet", 1e-4, 168, not_given},
    Published{"elastic_666", "DART", 1e-4, 2438, not_given},
    Published{"elastic_666", "RaiSim", 1e-3, 8.4, not_given},
    Published{"elastic_666", "ODE", 1e-3, 112, not_given},
    Published{"elastic_666", "Bullet", 1e-3, 4.1e4, not_given},
    Published{"elastic_666", "DART", 1e-3, 3.5e5, not_given},
    Published{"elastic_666", "RaiSim", 1e-2, 5.2e6, not_given},
    Published{"elastic_666", "ODE", 1e-2, 8.6e6, not_given},
    Published{"elastic_666", "Bullet", 1e-2, 9.9e6, not_given},
    Published{"elastic_666", "DART", 1e-2, 1.3e10, not_given},
};

}  // namespace pbdcheck
