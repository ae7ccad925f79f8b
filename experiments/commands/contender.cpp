#include "commands/contender.h"

#include <fmt/format.h>

#include <map>
#include <sstream>
#include <tuple>

#include "error.h"
#include "integrator_map.h"
#include "names.h"
#include "scenes/builder.h"
#include "scenes/choices.h"

namespace pbdcheck {
namespace {

using Words = std::map<std::string, std::string>;  // KEY=VALUE by key

/// The words of a --method; refuses none, and a key that stands twice.
Words words_of(const std::string& text) {
  Words found;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string key = word.substr(0, word.find('='));
    if (!found.emplace(key, word).second)
      throw pbd::SetupError("--method " + key, "`" + text + "`", "each key once");
  }
  if (found.empty()) throw pbd::SetupError("--method", "`" + text + "`", "\"KEY=VALUE ...\"");
  return found;
}

/// "rival=NAME", with a tolerance and a number of iterations (`max_outer`) at most.
Contender parsed_rival(const std::string& text, Words words, const pbd::Method& base) {
  const std::string option = "--method", word = words.extract("rival").mapped();
  const std::string name = word.substr(std::min(word.find('='), word.size() - 1) + 1);
  require_name(option + " rival", name, rival_names());
  std::string settings;
  for (const auto& [key, setting] : words) {
    if (key != "tolerance" && key != "max_outer")
      throw pbd::SetupError(fmt::format("{} {}", option, key), fmt::format("`{}` for a rival", setting),
                            "tolerance, max_outer");
    settings += setting + " ";
  }
  Contender contender{text, parse_method(settings, base, option)};
  contender.method.integrator = pbd::Method{}.integrator;
  contender.method.direction_blend = pbd::Method{}.direction_blend;
  contender.method.outer = "rival";
  contender.method.relaxation = name;
  contender.rival = &pbd::find_named(pbd::rivals::rivals(), "rival", name);
  return contender;
}

/// Refuses steps that the references do not solve, where they are stated, and what the scene does not allow.
void require_possible(const Contender& contender, const Words& words, const SceneFile& file) {
  const auto where = [&](const std::string& key) {
    return words.contains(key) ? "--method " + key : file.method_where.at(key);
  };
  const auto& integrator = contender.method.integrator;
  const auto rule = [](const pbd::Method& own) {
    return std::tie(own.integrator, own.alpha, own.beta, own.gamma, own.rho);
  };
  if (integrator != "implicit_euler") {
    pbd::reference::require_judged(integrator, where("integrator"));
    if (rule(contender.method) != rule(file.method))
      throw pbd::SetupError(where("integrator"), "`" + integrator + "`",
                            "implicit_euler, or the integrator that leads to the step, `" +
                                file.method.integrator + "`, with its parameters");
  }
  if (contender.method.direction_blend != 1)
    throw pbd::SetupError(where("direction_blend"), fmt::format("{}", contender.method.direction_blend),
                          "1, the directions of the step the references solve");
  located("--method \"" + contender.text + "\"", [&] {
    if (contender.rival)
      contender.rival->make(file.scene, file.step_s);
    else
      pbd::Workspace(file.scene, contender.method);
  });
}

/// Rows of the same method could not be told apart; those of different integrators are no answers to one
/// question.
void require_another(const Contender& contender, const std::vector<Contender>& earlier) {
  if (!earlier.empty() && earlier.front().method.integrator != contender.method.integrator)
    throw pbd::SetupError("--method", "`" + contender.text + "`",
                          "the integrator of `" + earlier.front().text + "`: one step is compared");
  for (const auto& other : earlier)
    if (method_text(other.method) == method_text(contender.method))
      throw pbd::SetupError("--method", "`" + contender.text + "`, the same as `" + other.text + "`",
                            "methods that differ");
}

}  // namespace

Trace Contender::measure_once(const SceneFile& file, const pbd::State& state, const pbd::Workspace& before,
                              const pbd::Points& exact) const {
  if (rival)
    return pbdcheck::measure_once(file.scene, state, file.step_s, *rival,
                                  {method.tolerance, method.max_outer}, exact);
  return pbdcheck::measure_once(file.scene, state, file.step_s, method, exact,
                                method.integrator == "implicit_euler" ? nullptr : &before);
}

std::vector<Contender> parsed_contenders(const std::vector<std::string>& texts, const SceneFile& file) {
  std::vector<Contender> contenders;
  for (const auto& text : texts) {
    const auto words = words_of(text);
    auto contender = words.contains("rival") ? parsed_rival(text, words, file.method)
                                             : Contender{text, parse_method(text, file.method, "--method")};
    require_possible(contender, words, file);
    require_another(contender, contenders);
    contenders.push_back(std::move(contender));
  }
  return contenders;
}

}  // namespace pbdcheck
