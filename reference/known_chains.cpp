#include <cmath>

#include "closed_form.h"
#include "known_answers_rows.h"
#include "numerics.h"

namespace pbd::reference::known {
namespace {

void rates(Rows& rows) {
  struct Case {
    int n;
    const char *kappa, *jacobi, *gauss_seidel, *sor, *gradients;
  };
  for (const Case& c : {Case{10, "48.374", "55.685", "27.842", "3.976", "7.952"},
                        Case{20, "178.064", "205.002", "102.501", "7.667", "15.334"},
                        Case{50, "1053.479", "1212.862", "606.431", "18.678", "37.356"},
                        Case{100, "4133.643", "4759.032", "2379.516", "37.007", "74.015"},
                        Case{1000, "406095.0", "467534.2", "233767.1", "366.83", "733.67"}}) {
    const double jacobi = chain_jacobi_radius(c.n), kappa = (1 + jacobi) / (1 - jacobi);
    const double sor = 2 / (1 + std::sqrt(1 - jacobi * jacobi)) - 1;
    const double gradients = (std::sqrt(kappa) - 1) / (std::sqrt(kappa) + 1);
    const std::string name = "chain of " + number(c.n) + " equal masses: ";
    const std::string decade = "iterations per decade";
    rows.push_back({"chain_rates", name + "condition number", "1", kappa, c.kappa,
                    std::pow(1 / std::tan(pi / (2 * (c.n + 1))), 2)});
    rows.push_back(
        {"chain_rates", name + decade + ", Jacobi", "1", iterations_per_decade(jacobi), c.jacobi, {}});
    rows.push_back({"chain_rates",
                    name + decade + ", Gauss-Seidel",
                    "1",
                    iterations_per_decade(jacobi * jacobi),
                    c.gauss_seidel,
                    {}});
    rows.push_back({"chain_rates", name + decade + ", best SOR", "1", iterations_per_decade(sor), c.sor, {}});
    rows.push_back({"chain_rates",
                    name + decade + ", conjugate gradients",
                    "1",
                    iterations_per_decade(gradients),
                    c.gradients,
                    {}});
  }
}

}  // namespace

void chains(Rows& rows) {
  for (const auto& [mode, stated] : {std::pair{1, "0.599388241"}, {2, "1.37584612"}, {3, "2.15688940"}})
    rows.push_back({"hanging_chain", "hanging chain of 1 m: mode " + number(mode), "Hz",
                    hanging_chain_frequency(mode, 1, g), stated, std::nullopt});
  struct Case {
    double length;
    const char *parameter, *sag, *tension;
  };
  for (const Case& c : {Case{1.2, "0.469541523", "0.292343798", "0.761885321"},
                        Case{1.5, "0.308236470", "0.502633262", "0.810869731"},
                        Case{2.0, "0.229640215", "0.796388356", "1.02602857"}}) {
    const Catenary found = catenary(1, c.length);
    const std::string name = "catenary, span 1 m, length " + number(c.length) + " m: ";
    const double a = found.parameter;
    const double length = integrate([a](double x) { return std::cosh(x / a); }, -0.5, 0.5);
    rows.push_back({"catenary", name + "parameter", "m", a, c.parameter, a * length / c.length});
    rows.push_back({"catenary", name + "sag", "m", found.sag, c.sag,
                    integrate([a](double x) { return std::sinh(x / a); }, 0, 0.5)});
    rows.push_back({"catenary", name + "end tension over weight per length", "m", found.end_tension,
                    c.tension, std::hypot(a, c.length / 2)});
  }
  struct Discrete {
    int links;
    const char *sag, *share;
  };
  for (const Discrete& c :
       {Discrete{10, "0.505945932", "0.205105101"}, Discrete{20, "0.503446634", "0.205393949"},
        Discrete{40, "0.502835773", "0.205466695"}, Discrete{80, "0.502683839", "0.205484907"}}) {
    const DiscreteCatenary found = discrete_catenary(1, 1.5, c.links);
    const std::string name = "catenary of " + number(c.links) + " links, span 1 m, length 1.5 m: ";
    rows.push_back({"discrete_catenary", name + "sag", "m", found.sag, c.sag, {}});
    rows.push_back({"discrete_catenary",
                    name + "horizontal tension over weight",
                    "1",
                    found.horizontal_share,
                    c.share,
                    {}});
  }
  rates(rows);
}

}  // namespace pbd::reference::known
