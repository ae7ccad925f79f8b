"""Contact with friction beside known answers."""

from content import Figure, Section, Table, number, share, span
from selecting import failed, good

ANSWERS = ("Every error over its bound, of each relaxation and law of friction; at the right how many are within it. Crossed: above "
           "the bound, some step was not solved, or the run diverged.")
RECURRENCE = (
    "The quantities are: `creep`, the speed that a box has left where it should stick, which is how far friction drifts; `threshold`, the speed "
    "that it gains where mu is just below tan a; `acceleration` where it slides; and `mass`, the same for light and heavy boxes. "
    "A box on a plane tilted by a sticks where mu >= tan a. Below that a constant force pulls it, and implicit Euler gives exactly "
    "v' = v + h g (sin a - mu cos a), x' = x + h v'. By the convex law it hovers at h mu v. While it speeds up it rises, so that the plane "
    "presses harder, and the growth d of its speed in a step obeys d' = h g (sin a - mu cos a) - mu^2 (d' - d).")
OFFSET = (
    "Slowed by a = mu g from v0 = (n + f) h a, n whole and 0 <= f < 1, implicit Euler stops h v0/2 before the v0^2/(2 a) of "
    "continuous time, up to h^2 a (f - f^2)/2. A body that rolls at v0/(1 + I/(m R^2)) slips by the same recurrence until it "
    "does. A cube that starts to slide on the ground must not take off. By the convex law it does, because its gap is h mu v at once.")
SQUARE = (
    "The box law bounds friction along two axes, each by mu p_n, and so slows by mu g (|cos| + |sin|) along the heading, up to "
    "sqrt(2) mu g at 45 degrees, and turns it towards the nearer axis. The other laws have no axes. The convex law's box "
    "begins where it hovers steadily.")
HOVER = (
    "The convex law asks for r_n >= mu |r_t| of the rows' residuals, so that a sliding contact keeps a gap of h mu v. "
    "On a plane whose tangent is mu a sliding box neither speeds up nor slows down.")
BOUNCE = (
    "With the trapezoidal rule (`newmark`, alpha = 1/2) flight keeps z + v^2/(2 g). A step that turns a ball round may begin "
    "v h above the ground and end (1 - e) v h/2 below, so that its next height H' is within (1 - e^2) v h of e^2 H. Impacts one "
    "after the other, without gravity, are exact whatever the step. When five balls touch, the order of their impacts is not determined; "
    "their answer is shown, and no verdict judges it.")
LIMITS = (
    "Bricks of length L stand while the overhang is below L/2 (1 + 1/2 + ... + 1/n). A semicircular arch stands while a line "
    "of thrust fits into its stones; the least thickness for these stones, prisms between radial cuts, is that of the linear "
    "programme over the thrust and its height at the crown.")

CAPSTAN = (
    "A cube under a plate, without friction or weight, is stressed uniformly: it yields by F/(E A) of its height by linear and corotational "
    "strain, and by Green's as E (l^3 - l)/2 says, whatever the mesh. A rope of n links round a half turn is bent by d = pi/n at each node, where "
    "friction bears a ratio of (1 + mu tan(d/2))/(1 - mu tan(d/2)) of the pulls, and all of them that to the nth power. Its exponent is above "
    "mu pi, that of a smooth rope, by a share of d^2 (1 + mu^2)/12. The rope is pulled by 1e-4 less than that, and by 5 % more, where its mass "
    "bounds how far it goes at least.")


def errors_table(frame):
    """The largest error of each quantity, one column a relaxation."""
    judged = frame[frame["bound"].notna()]
    names = list(judged["relaxation"].unique())
    rows = []
    for quantity, here in judged.groupby("quantity", sort=False):
        largest = here.groupby("relaxation")["error"].agg(lambda errors: errors.max(skipna=False))
        rows.append([quantity.replace("_", " "), here["unit"].iloc[0], number(here["bound"].min()),
                     *(number(largest[name]) if name in largest else "" for name in names)])
    return Table("Largest error of each quantity, beside its bound (the smallest of its runs).",
                 ["quantity", "unit", "bound", *names], rows, first=True)


def answers_table(frame):
    """The largest error of each quantity and relaxation, and the work."""
    rows = []
    for (quantity, relaxation), here in frame.groupby(["quantity", "relaxation"], sort=False):
        judged = here[here["bound"].notna()]
        if len(judged):
            rows.append([quantity.replace("_", " "), f"`{relaxation}`", number(judged["error"].max(skipna=False)), judged["unit"].iloc[0], number(judged["bound"].iloc[0]),
                         f"{here['sweeps'].sum() / max(here['steps'].sum(), 1):.3g}", number(here["missed_steps"].sum())])
    return Table("Largest errors beside their bounds, sweeps a step, and steps that missed their tolerance.",
                 ["quantity", "relaxation", "error", "unit", "bound", "sweeps", "missed"], rows)


def answers_text(frame):
    bad = failed(frame, "error")
    over = good(frame, "error")
    over = over[over["error"] > over["bound"]]
    text = (f"{share(len(frame) - len(bad), len(frame))} runs solve every step; of these {len(over)} have an error above the bound")
    return text + (": " + "; ".join(f"{r['quantity']}, {r['scene']}, `{r['relaxation']}` with `{r['friction']}` "
                                    f"({number(r['error'])} {r['unit']})" for _, r in over.head(8).iterrows()) if len(over) else "") + "."


def told(results, experiment, title, question, theory, figures=()):
    section = Section(title, question, figures=[Figure(f"{experiment}_answers", ANSWERS), *figures])
    return section.tell(results.table(experiment, "answers"), lambda frame: theory, answers_text, errors_table, answers_table)


def incline(results):
    section = told(results, "incline", "Does a box on a plane stick and slide as Coulomb's law says?",
                "Boxes of 1e-6 to 1e6 kg rest and slide on planes of several angles. Friction is a millionth above the tangent of the angle, a "
                "millionth below it, and well below it.", RECURRENCE)
    return section.tell(results.table("incline", "answers"), creep_text)


def creep_text(frame):
    """How far each law lets a box drift that should stick."""
    creep = frame[frame["quantity"] == "creep"]
    parts = [f"`{law}` {number(rows['error'].where(rows['status'] == 'ok').max(skipna=False))}" for law, rows in creep.groupby("friction", sort=False)]
    return f"The fastest creep by each law, in m/s: {', '.join(parts)}. With friction at the end of the step boxes creep visibly: [#late_friction]."


def stopping(results):
    return told(results, "stopping", "Do sliding bodies come to rest, or to roll, where they should?",
                "Boxes slide to rest, a ball, a cylinder and a hoop slip until they roll, and a cube is set off at 6 m/s.", OFFSET)


def friction_isotropy(results):
    section = Section("Is friction the same in every direction?", "A box slides on a floor at 36 headings, by each law.",
                      figures=[Figure("friction_isotropy_headings", "Deceleration along the heading, and the errors of it and "
                                      "of the heading over their bounds. Crossed: above it, or the run did not end well.")])
    return section.tell(results.table("friction_isotropy", "headings"), lambda frame: SQUARE, headings_text)


def headings_text(frame):
    parts = [f"`{law}` {span(rows['deceleration_share'])}, errors up to {number(rows['share_error'].max())} and "
             f"{number(rows['heading_error_rad'].max())} rad" for law, rows in good(frame, "share_error").groupby("friction", sort=False)]
    return f"Deceleration over mu g by law, and errors of it and the heading: {'; '.join(parts)}."


def convex_gap(results):
    section = Section("How high does a sliding body hover by the convex law?", "A box slides at a steady speed, by each law.",
                      figures=[Figure("convex_gap_gaps", "Gap over the step: at the end by the convex law, largest of all steps by "
                                      "the others. Line: h mu v. Crossed: the run did not end well.")])
    return section.tell(results.table("convex_gap", "gaps"), lambda frame: HOVER, gaps_text)


def gaps_text(frame):
    rows = good(frame, "gap_m")
    convex = rows[rows["friction"] == "cone"]
    return (f"By `cone` the gap is h mu v within a share of {number(convex['error'].max())}. At the largest step it is "
            f"{number(convex['gap_m'].max())} m, at the smallest {number(convex['gap_m'].min())} m. By the other laws it is at most "
            f"{number(rows[rows['friction'] != 'cone']['gap_m'].max())} m.")


def restitution(results):
    return told(results, "restitution", "Do bodies bounce as high and push each other as they should?",
                "A ball bounces and comes to rest; two balls, a heavy one below, fall on the ground; Newton's cradle; a ball "
                "strikes the ground at an angle.", BOUNCE,
                [Figure("restitution_heights", "Heights of a ball's bounces, by `direct`.")])


def stack(results):
    section = told(results, "stack", "Do stacks, overhangs and arches stand and fall where they should?",
                   "Columns, pyramids and slabs on many points at rest; then bricks that overhang and arches of radial stones "
                   "just inside and just outside of their limits.", LIMITS,
                   [Figure("stack_thresholds", "Largest displacement of a body. Below the lower line a structure stands, above "
                           "the upper one it falls. Crossed: the run did not end well.")])
    return section.tell(results.table("stack", "thresholds"), thresholds_table)


def coupling(results):
    section = told(results, "coupling", "Do rigid and deformable bodies carry and push each other as they should?",
                   "A ball strikes a soft cube of 1e-3 to 1e3 times its mass, and two soft cubes each other; a plate is pressed on a cube; a box "
                   "rests on a cube, and that on the ground; a rope lies half round a cylinder and is pulled.", CAPSTAN)
    return section.tell(results.table("coupling", "answers"), missed_text)


def missed_text(frame):
    """How far off the answers of runs are that missed steps."""
    missed = frame[frame["missed_steps"] > 0]
    if missed.empty:
        return "No run missed a step."
    return "Runs that missed steps: " + "; ".join(
        f"{r['scene']}, `{r['relaxation']}`: {r['missed_steps']:.0f} of {r['steps']:.0f} steps, {r['quantity'].replace('_', ' ')} off by "
        f"{number(r['error'])} ({r['unit']})" for _, r in missed.iterrows()) + "."


def thresholds_table(frame):
    return Table("Structures at their limits: share of the limit, displacement over the size, sweeps, missed steps.",
                 ["structure", "bodies", "share", "relaxation", "outcome", "moved", "right", "sweeps", "missed"],
                 [[r["structure"], number(r["count"]), f"{r['share']:g}", f"`{r['relaxation']}`", r["outcome"], number(r["moved"]),
                   "yes" if r["right"] else "no", f"{r['sweeps']:.0f}", number(r["missed_steps"])] for _, r in frame.iterrows()])
