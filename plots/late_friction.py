"""What does friction at the end of the step do?"""

from common import curve_points, figure, footnote, on_log, panels, shared_legend, ticks
from selecting import failed, reasons_note, step_text
from styles import BLACK, style


@figure("late_friction", "creep", table="motions")
def creep(frame):
    """Speed at which bodies creep that friction holds, one panel a scene; line: h a."""
    frame = frame[frame["quantity"] == "creep"]
    scenes = list(frame.groupby("scene", sort=False))
    fig, axes = panels(len(scenes), columns=3, height=2.2, sharey=True)
    for ax, (scene, here) in zip(axes, scenes):
        for variant, rows in here.groupby("variant", sort=False):
            curve_points(ax, rows, "step_s", "measured", f"friction {variant}" + (" of the step" if variant == "inside" else " of it"),
                         style(f"friction {variant}") | {"linestyle": "none"})
        line = here[here["expected"] > 0].sort_values("step_s")
        ax.plot(line["step_s"], on_log(line["expected"]), color=BLACK, linewidth=0.8, label="h a")
        ax.set(xscale="log", yscale="log", title=scene, xlabel="step (s)")
        ticks(ax, here["step_s"], lambda h: step_text(h).removesuffix(" s"))
    for ax in axes[::3]:
        ax.set_ylabel("creep (m/s)")
    shared_legend(fig, axes)
    footnote(fig, reasons_note(failed(frame, "measured")))
    return fig
