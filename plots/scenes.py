"""Scene files as a whole: the paper's three, by one solver, and those with contact, by their own methods."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from common import crossed, figure, footnote, on_log, panels, shared_legend
from finding import finding
from selecting import reasons_note, scene_gates
from strips import strips, within
from styles import BLUE, GREEN, ORANGE
from wording import number, share

LOOKS = {"boxes_on_ground": BLUE, "bunnies_on_cloth": ORANGE, "flexible_cow": GREEN}
INSTANTS = 4


def title(scene):
    return scene.replace("_", " ")


@figure("figure_1", "pictures", table="scenes")
@figure("contact_scenes", "pictures", table="scenes")
def pictures(frame):
    """Four instants of each scene, a row each, as plots/render.py left them, or that it could not."""
    folder = frame.attrs.get("folder", Path())
    scenes = list(frame["scene"].drop_duplicates())
    paths = [[folder / scene / f"instant_{k}.png" for k in range(INSTANTS)] for scene in scenes]
    rows = [np.concatenate([plt.imread(path) for path in row], axis=1) if all(path.exists() for path in row) else None for row in paths]
    height, width = next((row.shape[:2] for row in rows if row is not None), (1, 24))
    fig, ax = plt.subplots(figsize=(7.0, 6.2 * height / width * len(scenes) + 0.4))
    ax.set(xlim=(0, width), ylim=(height * len(rows), 0), xticks=[], aspect="equal")
    for k, row in enumerate(rows):
        if row is not None:
            ax.imshow(row, extent=(0, width, height * (k + 1), height * k))
        else:
            ax.text(width / 2, height * (k + 0.5), "not rendered: that needs VTK", ha="center", va="center", fontsize=7)
    ax.set_yticks(height * (np.arange(len(rows)) + 0.5), [title(scene).replace(" on ", "\non ") for scene in scenes])
    ax.tick_params(length=0)
    ax.grid(False)
    ax.set_frame_on(False)
    refuted = int(frame["refuted_steps"].sum())
    finding(fig, f"{share(int(frame['steps_ok'].sum()), int(frame['steps'].sum()))} steps meet their tolerance, "
            f"{refuted or 'none'} of them {'are' if refuted > 1 else 'is'} refuted")
    return fig


@figure("contact_scenes", "gates", table="scenes")
def gates(frame):
    """Every scene over the bound of each gate, a row a gate."""
    found = scene_gates(frame)
    return strips(found.assign(row=found["gate"], ratio=within(found, "measured", "bound"), who=found["scene"].map(title)), "gate")


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
