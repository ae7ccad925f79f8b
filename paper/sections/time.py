"""How the integrators follow the motion in continuous time."""

from content import Figure, Section, Table, number, span
from selecting import failed, good, rule_names, step_text


def time_order(results):
    section = Section(
        "At which order does each integrator approach the motion?",
        "Springs, links, a solid and pendulums move, integrated by ever smaller steps. Their motion is compared at four times with "
        "the judge `ode`, which knows neither steps nor multipliers. Linear problems are solved directly, steps to a tolerance of "
        "1e-12. The observed order is the slope of the logarithm of the error over that of the step, by least squares over the four "
        "finest steps [@roache1994perspective]. `bdf2` begins with a step of implicit Euler. Where there are hard constraints `bdf2`, "
        "`newmark` and `generalised_alpha` begin with three: errors of second order, which leave the order as it is. `newmark` between "
        "0.5 and 1 has an error of first order with the small coefficient alpha - 1/2 beside one of second order; its order is shown, not judged. The pendulum "
        "over 10 s shows what happens to hard constraints in a long time; its orders are not judged either.",
        figures=[Figure("time_order_errors", "Error of the worst node and time over the step, relative to the largest displacement. "
                        "Triangles show the orders 1 and 2. Crossed: the error exceeds the motion, or the simulation failed."),
                 Figure("time_order_orders", "Observed orders of the four finest steps.")])
    section.tell(results.table("time_order", "errors"), resolved_text)
    return section.tell(results.table("time_order", "orders"), lost_text, orders_table)


def resolved_text(errors):
    """How far solves and judge are below the errors."""
    rows = good(errors, "error", "error_solve")
    share = (rows["error_solve"] + rows["error_reference"]) / rows["error"]
    return (f"The error of the solves, found by repeating them at 100 times the tolerance, and the judge's own error add up to {span(share)} "
            f"of the error shown, in the {len(rows)} of {len(errors)} runs that are ok.")


def lost_text(orders):
    bad = failed(orders, "error")
    if bad.empty:
        return "Every integrator follows every motion."
    lost = "; ".join(f"`{name}` on {', '.join(rows['scene'])}" for name, rows in bad.groupby(rule_names(bad), sort=False))
    return (f"These do not follow their motion at the steps fitted: {lost}. The section on energy derives why hard constraints need "
            "damping: alpha = 1/2 and the midpoint rule do not damp an error of their velocity, and turning directions make it grow.")


def orders_table(orders):
    """One row an integrator, one column a motion."""
    scenes = list(orders["scene"].unique())
    rows = []
    for name, group in orders.groupby(rule_names(orders), sort=False):
        found = {row["scene"]: f"{row['order']:.3f}" if row["status"] == "ok" else row["status"] for _, row in group.iterrows()}
        rows.append([f"`{name}`", number(group["order_expected"].iloc[0]), *(found.get(scene, "") for scene in scenes)])
    finest = "; ".join(f"{scene} {step_text(group['step_s'].iloc[0])}" for scene, group in orders.groupby("scene", sort=False))
    return Table(f"Observed orders. Finest steps: {finest}.", ["integrator", "order", *scenes], rows, first=True)
