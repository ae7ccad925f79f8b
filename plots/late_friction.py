"""What does friction at the end of the step do?"""

from common import curve_points, figure, footnote, on_log, panels, shared_legend, ticks
from finding import fewer, finding
from selecting import failed, good, reasons_note, step_text
from styles import BLACK, style
from wording import counted, number, span


NAMES = {"within": "friction within the step", "end": "friction at the end of the step"}


@figure("late_friction", "creep", table="motions")
def creep(frame):
    """Speed at which bodies creep that friction holds, one panel a scene; line: h a."""
    frame = frame[frame["quantity"] == "creep"]
    scenes, left = fewer(frame.groupby("scene", sort=False))
    fig, axes = panels(len(scenes), columns=3, height=2.2, sharey=True)
    for ax, (scene, here) in zip(axes, scenes):
        for variant, rows in here.groupby("variant", sort=False):
            curve_points(ax, rows, "step_s", "measured", NAMES.get(variant, variant),
                         style(f"friction {variant}") | {"linestyle": "none"})
        line = here[here["expected"] > 0].sort_values("step_s")
        ax.plot(line["step_s"], on_log(line["expected"]), color=BLACK, linewidth=0.8, label="h a, exact for a box that never turns")
        ax.set(xscale="log", yscale="log", title=scene, xlabel="step (s)")
        ticks(ax, here["step_s"], lambda h: step_text(h).removesuffix(" s"))
    for ax in axes[::3]:
        ax.set_ylabel("creep (m/s)")
    shared_legend(fig, axes)
    seen = good(frame, "measured").groupby("variant")["measured"]
    said = {"end": "What friction holds creeps at {} m/s with friction at the end of the step".format,
            "within": "at {} m/s at most with friction within it".format}
    parts = [text(span(seen.get_group(name)) if name == "end" else number(seen.get_group(name).max())) for name, text in said.items()
             if name in seen.groups]
    finding(fig, ", ".join(parts) if len(parts) == len(said) else f"Not both kinds of friction are solved in {counted(len(frame), 'run')}")
    footnote(fig, left + reasons_note(failed(frame, "measured")))
    return fig
