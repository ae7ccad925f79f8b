#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "harness/files.h"
#include "harness/judges.h"
#include "known_answers.h"
#include "scenes/choices.h"
#include "scenes/scene_file.h"
#include "step/integrators.h"

namespace pbdcheck {
namespace {

struct Item {
  std::string name;
  std::string text;  // what it is, may be empty
};

std::vector<Item> named(const std::vector<std::string>& names) {
  std::vector<Item> items;
  for (const auto& name : names) items.push_back({name, ""});
  return items;
}

std::vector<Item> experiment_items() {
  std::vector<Item> items;
  for (const auto& experiment : experiments())
    items.push_back({std::string(experiment.name), std::string(experiment.question)});
  return items;
}

/// The scenes that come with the program, by path so that the name can be given to `simulate`.
std::vector<Item> scene_items() {
  std::vector<Item> items;
  if (std::filesystem::is_directory(scenes_folder()))
    for (const auto& entry : std::filesystem::directory_iterator(scenes_folder()))
      if (entry.path().extension() == ".toml")
        items.push_back({entry.path().string(), scene_description(entry.path())});
  std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.name < b.name; });
  return items;
}

std::vector<Item> integrator_items() {
  std::vector<Item> items;
  for (const auto& integrator : pbd::integrators())
    items.push_back({std::string(integrator.name), std::string(integrator.text)});
  return items;
}

std::vector<Item> reference_items() {
  std::vector<Item> items;
  for (const auto& judge : pbd::reference::judges())
    items.push_back({std::string(judge.name), "steps without contact or damping"});
  items.push_back({"cone_interior_point",
                   "steps with contact, and contact problems with friction: interior point, then Newton"});
  items.push_back({"cone_ipopt", "the same by Ipopt on two smooth forms"});
  items.push_back({"ode", "trajectories of compliant scenes and planar hard chains in continuous time"});
  items.push_back({"finer_steps", "trajectories of all scenes: the solver's own by far smaller steps"});
  items.push_back({"closed_form", "formulas and their checks, see `list cases`"});
  return items;
}

std::vector<Item> case_items() {
  std::vector<Item> items;
  for (const auto& known : pbd::reference::known_answers())
    items.push_back({known.family, fmt::format("{}: {:.10g} {}", known.statement, known.value, known.unit)});
  return items;
}

struct Kind {
  std::string name;
  std::vector<Item> (*items)();
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list{
      {"experiments", experiment_items},
      {"scenes", scene_items},
      {"effects", [] { return named(effect_names()); }},
      {"integrators", integrator_items},
      {"outers", [] { return named(outer_choices()); }},
      {"relaxations", [] { return named(relaxation_choices()); }},
      {"frictions", [] { return named(friction_choices()); }},
      {"references", reference_items},
      {"rivals", [] { return named(rival_names()); }},
      {"cases", case_items},
  };
  return list;
}

nlohmann::ordered_json to_json(const std::vector<Item>& items) {
  auto array = nlohmann::ordered_json::array();
  for (const auto& item : items) {
    nlohmann::ordered_json object{{"name", item.name}};
    if (!item.text.empty()) object["text"] = item.text;
    array.push_back(object);
  }
  return array;
}

void print_items(const std::vector<Item>& items, std::string_view indent) {
  for (const auto& item : items)
    fmt::print("{}{}{}{}\n", indent, item.name, item.text.empty() ? "" : "  ", item.text);
}

}  // namespace

std::vector<std::string> list_kinds() {
  std::vector<std::string> names;
  for (const auto& kind : kinds()) names.push_back(kind.name);
  return names;
}

int list(const ListOptions& options) {
  if (!options.kind.empty()) require_name("list", options.kind, list_kinds());
  auto all = nlohmann::ordered_json::object();
  for (const auto& kind : kinds()) {
    if (!options.kind.empty() && options.kind != kind.name) continue;
    const auto items = kind.items();
    if (options.json) {
      all[kind.name] = to_json(items);
    } else {
      if (options.kind.empty()) fmt::print("{}:\n", kind.name);
      print_items(items, options.kind.empty() ? "  " : "");
    }
  }
  if (options.json) fmt::print("{}\n", (options.kind.empty() ? all : all[options.kind]).dump(2));
  return exit_done;
}

}  // namespace pbdcheck
