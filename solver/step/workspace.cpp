#include "step/workspace.h"

#include <algorithm>

#include "effects/sources.h"
#include "names.h"
#include "rows/laws.h"
#include "validate.h"
#include "validate_effect.h"

namespace pbd {
namespace {

void require_contact(const Integrator& integrator, const Method& method) {
  if (!integrator.contact)
    throw SetupError("integrator", std::string(integrator.name) + " with contact",
                     "an integrator that meets constraints where steps end: implicit_euler, newmark by "
                     "alpha, generalised_alpha, bdf2 or symplectic_euler");
  if (method.beta && method.gamma)
    throw SetupError("beta", "Newmark's own family with contact",
                     "newmark by alpha, or generalised_alpha: places of the family may hang on accelerations "
                     "alone, which impacts have none of");
}

double finite_mass_of(const Scene& scene) {
  double sum = 0;
  for (const double mass : scene.mass)
    if (std::isfinite(mass)) sum += mass;
  return sum > 0 ? sum : 1;  // nothing moves, and an unmet constraint still weighs
}

bool implicit_gyroscopic(const Scene& scene, const Integrator& integrator) {
  bool implicit = false;
  for (const Effect& effect : scene.effects)
    if (const auto* torque = std::get_if<Gyroscopic>(&effect)) implicit = torque->implicit;
  return implicit && !integrator.explicit_forces;
}

StepSystem system_of(const Scene& scene, const Method& method) {
  const Integrator& integrator = find_named(integrators(), "integrator", method.integrator);
  require_outer(method.outer);
  StepSystem system(scene, method);
  system.solver = make_linear_solver(method.relaxation);
  system.slots =
      make_slots(scene, friction_by_name(method.friction), integrator.explicit_forces, system.rows);
  divide(system.rows, method.threads);
  Problem& problem = system.problem;
  problem.inverse_mass = system.rows.inverse_mass;
  problem.finite_mass = finite_mass_of(scene);
  problem.direction_blend = integrator.explicit_forces ? 0 : method.direction_blend;
  problem.implicit_gyroscopic = implicit_gyroscopic(scene, integrator);
  for (const Slot& slot : system.slots) problem.hard_constraints |= !slot.source->kind().compliant;
  return system;
}

/// True if the same constraints of both effects, which are of one kind, are hard.
bool same_hard(const Effect& a, const Effect& b) {
  return std::visit(
      [&]<class E>(const E& one) {
        if constexpr (requires { one.compliance; }) {
          const auto& own = one.compliance;
          const auto& other = std::get<E>(b).compliance;
          return std::equal(own.begin(), own.end(), other.begin(), other.end(),
                            [](double x, double y) { return (x == 0) == (y == 0); });
        }
        return true;
      },
      a);
}

/// True if the rows of both effects, which are of one kind, have the same Sigma. False of strains, whose
/// materials are not compared.
bool same_stiffness(const Effect& a, const Effect& b) {
  return std::visit(
      [&]<class E>(const E& one) {
        const E& other = std::get<E>(b);
        if constexpr (requires { one.compliance; })
          return one.compliance == other.compliance && one.damping == other.damping;
        return false;
      },
      a);
}

/// True if the sources' rows are of the same columns.
bool same_rows(Source& source, bool hard_alone, ConstBlockSpan blocks) {
  BlockList stated;
  source.allocate(hard_alone, stated);
  return std::equal(
      stated.begin(), stated.end(), blocks.begin(), blocks.end(), [](const AnyBlock& a, const AnyBlock& b) {
        return std::visit(
            [&]<class Block>(const Block& own) {
              const Block* other = std::get_if<Block>(&b);
              return other != nullptr && own.node == other->node && own.entries == other->entries;
            },
            a);
      });
}

/// Takes what constraints' values were where the last step began.
void take_begin_values(ConstBlockSpan from, BlockSpan blocks) {
  for (std::size_t i = 0; i < blocks.size(); ++i)
    std::visit([&]<class Block>(Block& own) { own.begin_value = std::get<Block>(from[i]).begin_value; },
               blocks[i]);
}

/// What messages call the effect. Throws SetupError where there is none.
std::string require_effect(const Scene& scene, std::size_t index) {
  const std::string where = "effects[" + std::to_string(index) + "]";
  if (index < scene.effects.size()) return where;
  throw SetupError(where, "no such effect", "an index below " + std::to_string(scene.effects.size()));
}

}  // namespace

WorkspaceData::WorkspaceData(Scene stated_scene, Method stated_method)
    : scene(std::move(stated_scene)),
      method(std::move(stated_method)),
      system(system_of(scene, method)),
      history(find_named(integrators(), "integrator", method.integrator)),
      outer(make_outer(method.outer, system)),
      contraction(system),
      effects(system.problem.inverse_mass.size()) {
  if (system.rows.contacts) require_contact(history.integrator(), method);
  require_solvable(system.solver, system.rows, friction_by_name(method.friction));
}

Workspace::Workspace(Scene scene, Method method) {
  validate(scene);
  validate(method);
  data_ = std::make_unique<WorkspaceData>(std::move(scene), std::move(method));
}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

const Scene& Workspace::scene() const {
  return data_->scene;
}

const Method& Workspace::method() const {
  return data_->method;
}

void Workspace::begin_anew() {
  if (data_->system.problem.hard_constraints) data_->history.begin_anew();
}

void Workspace::go_on_from(const Workspace& other) {
  const WorkspaceData& from = *other.data_;
  if (&from.history.integrator() != &data_->history.integrator())
    throw SetupError("integrator", data_->method.integrator,
                     from.method.integrator + ", of the step that is gone on from");
  data_->history = from.history;
  StepSystem& system = data_->system;
  system.at = from.system.at;
  system.problem.map = from.system.problem.map;
  system.problem.coefficients = from.system.problem.coefficients;
  for (std::size_t i = 0; i < system.slots.size(); ++i)
    if (system.slots[i].source->kind().damped)
      take_begin_values(from.system.slots[i].view(from.system.rows), system.slots[i].blocks(system.rows));
}

void Workspace::change(std::size_t index, const Effect& effect) {
  auto& effects = data_->scene.effects;
  const std::string where = require_effect(data_->scene, index);
  const auto name = std::visit([](const auto& own) { return own.name; }, effect);
  if (effects[index].index() != effect.index())
    throw SetupError(where, name, "an effect of the kind that it replaces");
  if (std::holds_alternative<Contact>(effect))
    throw SetupError(where, name, "an effect that may change between steps: not contact");
  const Effect before = effects[index];
  const auto& slots = data_->system.slots;
  const auto slot =
      std::find_if(slots.begin(), slots.end(), [&](const Slot& own) { return own.effect == index; });
  StepSystem& system = data_->system;
  if (slot != slots.end() && slot->source->call_all(system.problem.inverse_mass, slot->blocks(system.rows)))
    ++system.rows.generation;
  effects[index] = effect;  // in place: the sources refer to it
  try {
    validate_effect(data_->scene, index);
    data_->system.problem.implicit_gyroscopic =
        implicit_gyroscopic(data_->scene, data_->history.integrator());
    if (slot == slots.end()) return;
    const auto source = make_source(data_->scene, effects[index], Friction::coulomb);
    if (source->kind() != slot->source->kind() || damped(before) != damped(effect) ||
        !same_hard(before, effect) ||
        !same_rows(*source, data_->history.integrator().explicit_forces, slot->view(data_->system.rows)))
      throw SetupError(
          where, name,
          "the same constraints as before, with or without bounds, damping and compliance as before");
  } catch (...) {
    effects[index] = before;
    throw;
  }
  slot->source->take_effect();
  if (same_stiffness(before, effect)) return;
  ++data_->system.rows.generation;
  forget(data_->system.solver);
  forget_stiffness(data_->outer);
}

std::vector<EffectCost> Workspace::costs() const {
  std::vector<EffectCost> all;
  for (const Slot& slot : data_->system.slots)
    if (slot.count > 0) all.push_back(slot.cost);
  return all;
}

std::vector<double> Workspace::impulses(std::size_t index) const {
  require_effect(data_->scene, index);
  std::vector<double> flat;
  for (const Slot& slot : data_->system.slots) {
    const Source& source = *slot.source;
    if (slot.effect != index || source.kind().contacts) continue;
    for (std::size_t c = 0; c < source.kind().constraints; ++c)
      flat.insert(flat.end(), source.kind().rows_of_each, source.waits(c) ? 0 : std::nan(""));
    for_each_block(slot.view(data_->system.rows), [&]<class Block>(const Block& block) {
      for (std::size_t i = 0; i < block.size(); ++i)
        std::copy(block.impulse[i].begin(), block.impulse[i].end(),
                  flat.begin() + static_cast<std::ptrdiff_t>(Block::rows * block.entry(i)));
    });
  }
  return flat;
}

std::vector<double> Workspace::forces(std::size_t index) const {
  std::vector<double> flat = impulses(index);
  const double s = data_->system.problem.map.s;
  for (double& each : flat) each /= s > 0 ? s : 1;  // before the first step there are none
  return flat;
}

std::vector<ContactForce> Workspace::contacts() const {
  const StepSystem& system = data_->system;
  const Configuration at{system.at.x, system.at.poses, system.problem.x_time};
  std::vector<ContactForce> all;
  for (const Slot& slot : system.slots)
    slot.source->add_contact_forces(system.problem.map, at, system.at.v, slot.view(system.rows), all);
  return all;
}

}  // namespace pbd
