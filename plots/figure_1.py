"""Boxes on the ground, bunnies on cloth and a flexible cow, by one solver."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from common import crossed, figure, footnote, on_log, panels, shared_legend
from finding import finding
from selecting import reasons_note
from styles import BLUE, GREEN, ORANGE
from wording import number, share

TITLES = {"boxes_on_ground": "boxes on the ground", "bunnies_on_cloth": "bunnies on cloth", "flexible_cow": "flexible cow"}
LOOKS = dict(zip(TITLES, (BLUE, ORANGE, GREEN)))
INSTANTS = 4
PICTURED = 1 / 60  # s, the step whose frames are drawn


def title(scene):
    return TITLES.get(scene, scene)


@figure("figure_1", "pictures", table="scenes")
def pictures(frame):
    """Four instants of each scene, a row each, as plots/render.py left them, or that it could not."""
    folder = frame.attrs.get("folder", Path())
    shown = frame[np.isclose(frame["step_s"], PICTURED)]
    shown = shown if len(shown) else frame
    fig, axes = plt.subplots(len(shown), 1, figsize=(7.0, 1.45 * len(shown)), squeeze=False)
    for ax, (_, row) in zip(axes[:, 0], shown.iterrows()):
        paths = [folder / f"{row['scene']}_60" / f"instant_{k}.png" for k in range(INSTANTS)]
        if all(path.exists() for path in paths):
            ax.imshow(np.concatenate([plt.imread(path) for path in paths], axis=1))
        else:
            ax.text(0.5, 0.5, "not rendered: that needs VTK", ha="center", va="center", fontsize=7)
        ax.set_xticks([])
        ax.set_yticks([])
        ax.set_frame_on(False)
        ax.set_ylabel(title(row["scene"]), fontsize=7)
    refuted = int(frame["refuted_steps"].sum())
    finding(fig, f"One solver: {share(int(frame['steps_ok'].sum()), int(frame['steps'].sum()))} steps meet their tolerance, "
            f"{refuted or 'none'} of them {'are' if refuted > 1 else 'is'} refuted")
    return fig


@figure("figure_1", "series", table="series")
def series(frame):
    """Energy, overlap and time a frame over the time; crossed: steps that missed their tolerance."""
    frame = frame[np.isclose(frame["step_s"], frame["step_s"].max())]
    fig, axes = panels(3, columns=3, height=2.2)
    columns = {"energy_change_j": "energy since the start (J)", "overlap_m": "deepest overlap (m)", "wall_s": "time a step (s)"}
    for ax, (column, name) in zip(axes, columns.items()):
        for scene, rows in frame.groupby("scene", sort=False):
            values = rows[column] if column == "energy_change_j" else on_log(rows[column])
            ax.plot(rows["time_s"], values, color=LOOKS.get(scene), label=title(scene), linewidth=0.8)
            for (_, row), value in zip(rows.iterrows(), values):
                if row["status"] != "ok":
                    crossed(ax, row["time_s"], value, {"color": LOOKS.get(scene), "marker": "o"}, ax.transData)
        ax.set(xlabel="time (s)", title=name)
        if column != "energy_change_j":
            ax.set_yscale("log")
    shared_legend(fig, axes)
    ok = frame["status"].eq("ok")
    finding(fig, f"{share(ok.sum(), len(frame))} steps meet their tolerance, in {number(frame['wall_s'].median())} s in the middle")
    footnote(fig, reasons_note(frame[~ok]))
    return fig
