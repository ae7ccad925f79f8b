#include "commands/contender.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

#include "commands/arguments.h"
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

std::string value_of(const std::string& word) {
  return word.substr(std::min(word.find('='), word.size() - 1) + 1);
}

/// "rival=NAME", with a tolerance and a number of iterations (`max_outer`) at most.
Contender parsed_rival(const std::string& text, Words words, const pbd::Method& base) {
  const std::string option = "--method", name = value_of(words.extract("rival").mapped());
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

constexpr const char* own_answers =
    ": each integrator has its own answer to one step; --until T compares whole motions";

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
                            (file.method.integrator == "implicit_euler"
                                 ? "implicit_euler, which leads to the step"
                                 : "implicit_euler, or the integrator that leads to the step, `" +
                                       file.method.integrator + "`, with its parameters") +
                                own_answers);
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

/// Those of different integrators are no answers to one question.
void require_same_question(const Contender& contender, const std::vector<Contender>& earlier) {
  if (!earlier.empty() && earlier.front().method.integrator != contender.method.integrator)
    throw pbd::SetupError("--method", "`" + contender.text + "`",
                          "the integrator of `" + earlier.front().text + "`" + own_answers);
}

/// Rows of the same method could not be told apart.
void require_another(const Contender& contender, const std::vector<Contender>& earlier) {
  for (const auto& other : earlier)
    if (other.steps == contender.steps && method_text(other.method) == method_text(contender.method))
      throw pbd::SetupError("--method", "`" + contender.text + "`, the same as `" + other.text + "`",
                            "methods that differ");
}

/// How many steps of `step` (s) lead to `until`.
std::int64_t steps_until(double until, double step, const std::string& where, const std::string& allowed) {
  constexpr double most = 1e9;      // more are a slip of the keyboard
  constexpr double rounded = 1e-6;  // a share that people round steps by
  const double steps = std::round(until / step);
  if (!(steps >= 1 && steps <= most && std::abs(until / step - steps) <= rounded * steps))
    throw pbd::SetupError(where, fmt::format("{:g} s in steps of {:g} s", until, step), allowed);
  return static_cast<std::int64_t>(steps);
}

/// A --method of a motion.
Contender parsed_mover(const std::string& text, const SceneFile& file, double until) {
  auto words = words_of(text);
  if (words.contains("rival"))
    throw pbd::SetupError("--method rival", "`" + text + "` with --until",
                          "methods of the solver: a rival does single steps");
  Contender contender{text, {}};
  if (const auto word = words.extract("step_s")) {
    const std::string option = "--method step_s", step = value_of(word.mapped());
    if (const auto refusal = number_between(0, until)(step); !refusal.empty())
      throw pbd::SetupError(option + ": " + refusal);
    contender.steps = steps_until(until, std::stod(step), option, "a whole number of steps, up to 1e9");
  } else {
    contender.steps = steps_until(until, file.step_s, "--until",
                                  "a whole number of the scene's steps, or step_s=VALUE in --method");
  }
  std::string settings;
  for (const auto& [key, setting] : words) settings += setting + " ";
  contender.method = parse_method(settings, file.method, "--method");
  located("--method \"" + text + "\"", [&] { pbd::Workspace(file.scene, contender.method); });
  return contender;
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
    if (words.contains("step_s"))
      throw pbd::SetupError("--method step_s", "`" + text + "`", "with --until: one step is compared");
    auto contender = words.contains("rival") ? parsed_rival(text, words, file.method)
                                             : Contender{text, parse_method(text, file.method, "--method")};
    require_possible(contender, words, file);
    require_same_question(contender, contenders);
    require_another(contender, contenders);
    contenders.push_back(std::move(contender));
  }
  return contenders;
}

std::vector<Contender> parsed_movers(const std::vector<std::string>& texts, const SceneFile& file,
                                     double until) {
  std::vector<Contender> contenders;
  for (const auto& text : texts) {
    contenders.push_back(parsed_mover(text, file, until));
    require_another(contenders.back(), {contenders.begin(), contenders.end() - 1});
  }
  return contenders;
}

}  // namespace pbdcheck
