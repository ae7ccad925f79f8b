// Known answers that the solver does not run, and why.
#include "closed_form.h"
#include "closed_form_solids.h"
#include "ledger/families.h"
#include "scenes/standard.h"

namespace pbdcheck::ledger {

void unreachable(Ledger& rows) {
  rows.push_back({.id = "unreachable.cycloid",
                  .statement = "a bead on a cycloid has the same period from everywhere",
                  .quantity = "period",
                  .unit = "s",
                  .formula = "4 pi sqrt(r/g)",
                  .scene = "bead on a cycloid of a circle of 1 m",
                  .expected = [] { return pbd::reference::tautochrone_period(1, gravity); },
                  .cannot = "no effect holds a point on a given curve; line_joint knows straight lines"});
  rows.push_back({.id = "unreachable.neo_hookean",
                  .statement = "a neo-Hookean bar at twice its length",
                  .quantity = "nominal stress",
                  .unit = "Pa",
                  .formula = "mu (l - 1/l) + lambda ln(J)/l, lateral stress 0",
                  .source = "bathe2014finite",
                  .scene = "bar, E = 1e6 Pa, nu = 0.3",
                  .expected = [] { return pbd::reference::neo_hookean_bar(1e6, 0.3, 2).stress; },
                  .cannot = "strains are green, corotational and linear; none is neo-Hookean"});
  rows.push_back(
      {.id = "unreachable.pulled_2",
       .statement = "a cube of St Venant-Kirchhoff's material that dead loads pull to twice its length",
       .quantity = "stretch",
       .unit = "1",
       .formula = "P = E l (l^2 - 1)/2",
       .source = "bathe2014finite",
       .scene = "free unit cube, E = 1e6 Pa, nu = 0.3, dead loads raised in 20 steps",
       .expected = [] { return 2.0; },
       .cannot = "from stretch 1.7 on, where the cube is 0.6 thick, steps of 0.1 s miss 1e-8 by direct and "
                 "by conjugate_gradients"});
  rows.push_back(
      {.id = "unreachable.turek_csm1",
       .statement = "Turek and Hron's beam behind a cylinder under its weight, CSM1",
       .quantity = "drop of its tip",
       .unit = "m",
       .formula = "66.1023e-3, published",
       .scene = "beam of 0.35 x 0.02 m, plane strain, 1.4e6 Pa, nu = 0.4, 2 m/s^2",
       .expected = [] { return 66.1023e-3; },
       .cannot = "nothing holds nodes in a plane alone, and triangle_strain takes no Poisson's ratio of 2/3, "
                 "which plane strain of 0.4 would need"});
  rows.push_back({.id = "unreachable.nafems_fv52",
                  .statement = "NAFEMS's thick plate whose lower edges keep their height, FV52",
                  .quantity = "lowest frequency",
                  .unit = "Hz",
                  .formula = "45.897, published",
                  .scene = "plate of 10 x 10 x 1 m, 200 GPa, nu = 0.3, 8000 kg/m^3",
                  .expected = [] { return 45.897; },
                  .cannot = "nothing holds one coordinate of a node: anchors hold all three"});
}

}  // namespace pbdcheck::ledger
