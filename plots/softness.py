"""How soft do constraints get where the solver is stopped early?"""

from common import curve_points, figure, footnote, on_log, panels, shared_legend, ticks
from finding import fewer, finding
from selecting import failed, good, reasons_note, step_text
from styles import BLACK, BLUE, GREEN, RED, style
from wording import counted, number, span

STEP = 1 / 60


def hung(rows):
    """Scene and compliance of some rows, as a panel's title."""
    compliance = rows["compliance_m_per_n"].iloc[0]
    return f"{rows['scene'].iloc[0]}, {compliance:g} m/N" if compliance else f"{rows['scene'].iloc[0]}, hard"


@figure("softness", "sweeps", table="stretches")
def sweeps(frame):
    """Stretch at rest over the sweeps of a step of 1/60 s; dashed: at equilibrium."""
    frame = frame[(frame["variant"] == "stopped") & (abs(frame["step_s"] - STEP) < 1e-9)]
    groups, left = fewer(frame.groupby(["scene", "compliance_m_per_n"], sort=False))
    if not groups:
        return None
    fig, axes = panels(len(groups), columns=3, height=2.3)
    for ax, (_, here) in zip(axes, groups):
        for relaxation, rows in here.groupby("relaxation", sort=False):
            curve_points(ax, rows, "sweeps", "stretch_m", relaxation, style(relaxation))
        formula = here[(here["relaxation"] == "gauss_seidel") & (here["scene"] == "chain")].sort_values("sweeps")
        if len(formula):
            ax.plot(formula["sweeps"], on_log(formula["expected_m"]), color=BLACK, linewidth=0.8, label="formula, gauss_seidel")
        if here["physical_m"].iloc[0] > 0:
            ax.axhline(here["physical_m"].iloc[0], color=BLACK, linestyle="--", linewidth=0.8, label="equilibrium")
        ax.set(xscale="log", yscale="log", title=hung(here), xlabel="sweeps a step")
    axes[0].set_ylabel("stretch at rest (m)")
    shared_legend(fig, axes)
    hard = good(frame[(frame["scene"] == "chain") & (frame["compliance_m_per_n"] == 0) & (frame["relaxation"] == "gauss_seidel")],
                "stretch_m").sort_values("sweeps")
    finding(fig, f"A hard chain of 1 m hangs longer by {number(hard['stretch_m'].iloc[0])} m with "
            f"{counted(int(hard['sweeps'].iloc[0]), 'sweep')} of gauss_seidel a step of 1/60 s, by {number(hard['stretch_m'].iloc[-1])} m with "
            f"{hard['sweeps'].iloc[-1]:.0f}" if len(hard) else f"No hard chain of {counted(len(frame), 'run')} came to rest")
    footnote(fig, left + reasons_note(failed(frame, "stretch_m")))
    return fig


def over_steps(frame, keys):
    """Stretch at the longest step over that at the shortest, of each run: smallest to largest."""
    ratios = [rows.loc[rows["step_s"].idxmax(), "stretch_m"] / rows.loc[rows["step_s"].idxmin(), "stretch_m"]
              for _, rows in good(frame, "stretch_m").groupby(keys) if rows["step_s"].nunique() > 1]
    return span(ratios) if ratios else ""


@figure("softness", "steps", table="stretches")
def steps(frame):
    """Stretch over the step: a relaxation factor for stiffness beside a compliance that is solved to the end."""
    classic = frame[(frame["variant"] == "classic") & (frame["factor"] < 1)]
    solved = frame[frame["variant"] == "converged"]
    fig, axes = panels(2, columns=2, height=2.6, sharey=True)
    colors = dict(zip(classic["factor"].unique(), (BLUE, RED, GREEN)))
    marks = dict(zip(classic["sweeps"].unique(), (("o", "-"), ("s", "--"), ("^", "-."))))
    for (factor, count), rows in classic.groupby(["factor", "sweeps"], sort=False):
        mark, line = marks[count]
        curve_points(axes[0], rows, "step_s", "stretch_m", f"k = {factor:g}, {counted(int(count), 'sweep')}",
                     {"color": colors[factor], "marker": mark, "linestyle": line})
    for relaxation, rows in solved.groupby("relaxation", sort=False):
        curve_points(axes[1], rows, "step_s", "stretch_m", relaxation, style(relaxation))
    if len(solved):
        axes[1].axhline(solved["physical_m"].iloc[0], color=BLACK, linestyle="--", linewidth=0.8, label="sum of m g A")
    for ax, title in zip(axes, ("relaxation factor k, hard links", "compliance, solved to the end")):
        ax.set(xscale="log", yscale="log", title=title, xlabel="step (s)")
        ticks(ax, frame.loc[frame["scene"] == "chain", "step_s"], lambda h: step_text(h).removesuffix(" s"))
    axes[0].set_ylabel("stretch at rest (m)")
    shared_legend(fig, axes)
    ratios = {name: over_steps(rows, keys) for name, rows, keys in (
        ("by a relaxation factor", classic, ["factor", "sweeps"]), ("by a compliance", solved, "relaxation"))}
    finding(fig, "A chain stretches at the longest step " + ", ".join(
        f"{ratio} times as far as at the shortest {name}" for name, ratio in ratios.items()) if all(ratios.values())
        else f"Not both were solved to rest in {counted(len(classic) + len(solved), 'run')}")
    footnote(fig, reasons_note(failed(frame[frame["variant"] != "stopped"], "stretch_m")))
    return fig
