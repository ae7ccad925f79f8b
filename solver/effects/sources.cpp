#include "effects/sources.h"

#include "effects/contact.h"
#include "effects/effects.h"

namespace pbd {

std::unique_ptr<Source> make_source(const Scene& scene, const Effect& effect, Friction law) {
  return std::visit(
      [&]<class E>(const E& stated) -> std::unique_ptr<Source> {
        if constexpr (RowEffect<E>)
          return make_source(scene, stated);
        else if constexpr (std::is_same_v<E, Contact>)
          return std::make_unique<ContactRows>(scene, stated, law);
        else
          return nullptr;
      },
      effect);
}

std::vector<Slot> make_slots(const Scene& scene, Friction law, bool hard_alone, Rows& rows) {
  std::vector<Slot> slots;
  rows.inverse_mass = Bodies(scene).inverse_masses(scene);
  for (std::size_t index = 0; index < scene.effects.size(); ++index) {
    Slot slot;
    slot.source = make_source(scene, scene.effects[index], law);
    slot.effect = index;
    if (!slot.source) continue;
    slot.first = rows.blocks.size();
    slot.source->allocate(hard_alone, rows.blocks);
    slot.count = rows.blocks.size() - slot.first;
    rows.contacts |= slot.source->kind().contacts && slot.count > 0;
    slot.cost.effect = std::visit([](const auto& effect) { return effect.name; }, scene.effects[index]);
    slot.count_rows(rows);
    slots.push_back(std::move(slot));
  }
  return slots;
}

void set_given_accelerations(const Scene& scene, const ForceBegin& begin, Points& acceleration) {
  acceleration.setZero(3, begin.bodies.columns());
  for (const auto& any : scene.effects)
    std::visit(
        [&]<class E>(const E& effect) {
          if constexpr (ForceEffect<E>) Force<E>::add(effect, scene, begin, acceleration);
        },
        any);
}

}  // namespace pbd
