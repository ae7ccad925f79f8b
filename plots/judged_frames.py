"""Steps of whole scenes against a judge that solves them anew."""

import numpy as np

from common import draw_failed, figure, footnote, on_log, panels, shared_legend
from finding import finding
from reading import NEXT_TO_SOLUTION, solves_as_it_is
from styles import BLACK, BLUE, GREEN, ORANGE
from wording import counted, number, share

LOOKS = {1e-4: ORANGE, 1e-6: GREEN, 1e-8: BLUE}
FILLED = "own"  # the judge's own solution; hollow are those it finds from what the solver claims


@figure("figure_1", "distance", table="frames")
@figure("judged_frames", "distance", table="frames")
def distance(frame):
    """Distance from the nearest solution over the time, a panel a scene, a colour a tolerance."""
    scenes = list(frame["scene"].drop_duplicates())
    fig, axes = panels(len(scenes), columns=3, height=2.0)
    for ax, scene in zip(axes, scenes):
        for tolerance, rows in frame[frame["scene"] == scene].groupby("tolerance", sort=False):
            look = LOOKS.get(tolerance, BLACK)
            judged = rows[rows["status"].eq("ok")]
            values = on_log(judged["nearest_error_of_scale"])
            ax.plot(judged["time_s"], values, color=look, linewidth=0.6, label=f"tolerance {number(tolerance)}")
            as_it_is = solves_as_it_is(judged)
            own = judged["nearest_start"].eq(FILLED).to_numpy()
            for these, marker, fill in ((own & ~as_it_is, ".", "full"), (~own & ~as_it_is, "o", "none")):
                ax.plot(judged["time_s"][these], np.asarray(values)[these], marker, color=look, markersize=4, fillstyle=fill)
            draw_failed(ax, judged[as_it_is], "time_s", "nearest_error_of_scale", {"color": look, "marker": "o"})
            ax.axhline(tolerance, color=look, linewidth=0.5, linestyle="dotted")
        ax.set(xlabel="time (s)", title=scene.replace("_", " "), yscale="log")
    axes[0].set_ylabel("distance over the scale")
    shared_legend(fig, axes)
    last = frame[np.isclose(frame["tolerance"], frame["tolerance"].min()) & frame["status"].eq("ok")]
    near = int((last["nearest_error_of_scale"] <= NEXT_TO_SOLUTION).sum())
    as_they_are = int(solves_as_it_is(last).sum())
    finding(fig, f"{share(near, len(last))} steps solved to {number(frame['tolerance'].min())} end within 1e-6 of a judge's solution"
            + (f"; of the others {as_they_are} solve its equations" if as_they_are else ""))
    unknown = int(frame["reference_status"].eq("not_judged").sum())
    footnote(fig, "Dotted: the tolerance. Circles: a solution that the judge finds from what the solver claims."
             + (" Crossed: a solution by the judge's equations, to 1e-9, next to none that it finds." if solves_as_it_is(frame).any() else "")
             + (f" Not drawn: {counted(unknown, 'step')} that the judge does not know." if unknown else ""))
    return fig
