// What a simulation writes down after every step.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/experiment.h"
#include "scenes/scene_file.h"

namespace pbdcheck {

/// Column names of the file's probes, units as suffixes.
std::vector<std::string> probe_columns(const SceneFile& file);

/// Appends the probes' values at `state` to a row; `stepped` is the workspace whose last step ended there,
/// null at the start.
void append_probes(const SceneFile& file, const pbd::State& state, const pbd::Workspace* stepped,
                   std::vector<Cell>& row);

/// Sum of the finite masses, kg.
double finite_mass(const pbd::Scene& scene);

/// Sum of 1/2 m v^2 over the nodes of finite mass and 1/2 w . I w over the bodies of finite inertia, J.
double kinetic_energy(const pbd::Scene& scene, const pbd::State& state);

/// Minus the sum of m a . x over the nodes of finite mass, J; zero at the origin.
double gravity_energy(const pbd::Scene& scene, const pbd::State& state);

/// Sum of 1/2 c^T A^-1 c over all constraints but contacts with compliance A > 0, J; of one whose force has
/// bounds, what they let it hold.
double elastic_energy(const pbd::Scene& scene, const pbd::State& state);

/// An energy of a scene in a state, J.
struct EnergyTerm {
  std::string_view name;
  double (*of)(const pbd::Scene& scene, const pbd::State& state);
};
/// What simulations tell of a scene's energy.
inline constexpr std::array<EnergyTerm, 3> energy_terms{{{"kinetic_energy", kinetic_energy},
                                                         {"gravity_energy", gravity_energy},
                                                         {"elastic_energy", elastic_energy}}};

/// The sum of these, J.
double total_energy(const pbd::Scene& scene, const pbd::State& state);

/// How the column of an effect's constraint error ends: "_m", "_rad" or, of strains, "". None of an effect
/// without such an error: given forces, and contact, which has probes of its own.
std::optional<std::string_view> error_unit(const pbd::Effect& effect);

/// Largest |c| over the constraints without compliance of one effect, in the unit of c; 0 if there are none.
/// A limit counts where it is passed, a motor of limited force not at all.
double constraint_error(const pbd::Scene& scene, const pbd::Effect& effect, const pbd::State& state);

}  // namespace pbdcheck
