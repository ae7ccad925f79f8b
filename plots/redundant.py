"""Does a mechanism move as before when joints hold what others hold already?"""

from common import crossed, curve_points, figure, footnote, panels, shared_legend
from finding import finding, guide
from styles import style
from selecting import missed_note, reasons_note
from wording import number, share, span

COLUMNS = {"position_difference_m": "positions: difference (m)", "net_force_difference": "net forces: difference",
           "split": "joints of one place: difference"}

BOUND = 1e-9  # of the verdicts


@figure("redundant", "motion", table="motion")
def motion(frame):
    """Differences to the motion without redundant joints, and of the impulses that joints of one place share, over the number of
    redundant joints. The run without is what others differ from, and stands on the lower edge where it fails."""
    placed = frame.assign(place=frame["redundant_joints"] + 1)
    plain = frame["redundant_joints"] == 0
    fig, axes = panels(len(COLUMNS), columns=3, height=2.4)
    for ax, (column, title) in zip(axes, COLUMNS.items()):
        for relaxation, rows in placed[~plain].groupby("relaxation", sort=False):
            curve_points(ax, rows, "place", column, relaxation, style(relaxation))
        for _, row in placed[plain & (frame["status"] != "ok")].iterrows():
            look = style(row["relaxation"]) | {"linestyle": "none"}
            crossed(ax, row["place"], 0.03, look, ax.get_xaxis_transform())
        if column != "split":
            guide(ax, BOUND, "bound")
        counts = sorted(frame["redundant_joints"].unique())
        ax.set_xticks([count + 1 for count in counts], [f"{count:.0f}" for count in counts])
        ax.set(yscale="log", title=title, xlim=(counts[0] + 0.7, counts[-1] + 1.3))
    fig.supxlabel("redundant joints", fontsize=8)
    shared_legend(fig, axes)
    held = frame[~plain]
    near = held["status"].eq("ok") & (held["position_difference_m"] <= BOUND) & (held["net_force_difference"] <= BOUND)
    finding(fig, f"With redundant joints the motion is the same to {number(BOUND)} in {share(near.sum(), len(held))} runs; how joints "
            f"of one place share the force differs by {span(held['split'])}")
    footnote(fig, missed_note(frame) + reasons_note(frame[frame["status"] != "ok"]))
    return fig
