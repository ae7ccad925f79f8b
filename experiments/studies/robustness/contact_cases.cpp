#include "studies/robustness/contact_cases.h"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "step/step.h"
#include "studies/robustness/units.h"

namespace pbdcheck {

ContactCase in_other_units(const ContactCase& each, double length, double mass) {
  ContactCase made = each;
  made.name = fmt::format("{}, lengths x {:g}, masses x {:g}", each.name, length, mass);
  made.scene = in_units(each.scene, length, mass);
  made.size *= length;
  made.lift *= length;
  made.reaction *= length * mass;
  made.apart_for_ever.clear();
  made.missed = [each, length](const pbd::State& end, double h, std::int64_t steps) {
    pbd::Method method;
    method.relaxation = "direct";
    pbd::Workspace workspace(each.scene, method);
    pbd::State state = each.scene.initial;
    for (std::int64_t k = 0; k < steps; ++k) step(workspace, h, state);
    return (end.x / length - state.x).colwise().norm().maxCoeff<Eigen::PropagateNaN>() / each.size;
  };
  made.exact_to = pbd::Method{}.tolerance * std::ceil(each.duration / each.h);
  return made;
}

std::vector<ContactCase> contact_cases(bool full) {
  auto all = cases_at_rest(full);
  const std::pair<std::string_view, std::vector<ContactCase> (*)(bool)> families[]{
      {"", moving_cases},
      {"surfaces", surface_cases},
      {"surfaces", screw_cases},
      {"soft", soft_cases},
      {"soft", driven_soft_cases}};
  for (const auto& [family, make] : families) {
    auto more = make(full);
    for (ContactCase& each : more) each.family = family;
    std::move(more.begin(), more.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace pbdcheck
