"""What do threads gain, and how near are sweeps to what memory gives?"""

import numpy as np

from common import figure, footnote, panels
from finding import finding, guide
from selecting import good
from styles import BLACK, BLUE, ORANGE, style
from wording import counted, number, span


@figure("threads", "gain", table="sweeps")
def gain(frame):
    """How many times as fast sweeps are on all threads, beside what as many would be at best."""
    return gains(frame, "relaxation", "sweep")


@figure("threads", "steps", table="steps")
def steps(frame):
    """The same of whole steps."""
    return gains(frame, "outer", "step")


def gains(frame, bar, what):
    one = frame[frame["threads"] == 1].set_index(["scene", bar])["wall_s_per_" + what]
    several = good(frame[frame["threads"] > 1], "speedup")
    alone = np.array([one.get((row["scene"], row[bar]), np.nan) for _, row in several.iterrows()])
    several = several.assign(slow=alone / several["wall_s_high"], fast=alone / several["wall_s_low"])
    scenes = list(frame["scene"].unique())
    most = several["threads"].max() if len(several) else 1
    fig, axes = panels(len(scenes), columns=2, height=1.0 + 0.25 * frame[bar].nunique(), sharey=True)
    for ax, scene in zip(axes, scenes):
        here = several[(several["scene"] == scene) & (several["threads"] == most)]
        ax.barh(here[bar], here["speedup"], color=[style(name)["color"] for name in here[bar]], height=0.6)
        ax.errorbar(here["speedup"], here[bar], xerr=[(here["speedup"] - here["slow"]).clip(lower=0), (here["fast"] - here["speedup"]).clip(lower=0)],
                    fmt="none", ecolor=BLACK, capsize=2, linewidth=0.8)
        for name, value in zip(here[bar], here["speedup"]):
            ax.text(0.05, name, number(value), va="center", fontsize=7, color="white", fontweight="bold")
        guide(ax, most, f"{number(most)} at best", horizontal=False)
        ax.grid(axis="y", visible=False)
        ax.set(xlabel=f"times as fast, {scene}", xlim=(0, 1.15 * max(most, several["fast"].max())))
    axes[0].invert_yaxis()
    finding(fig, f"{number(most)} threads {what} {span(several['speedup'])} times as fast as one; "
            f"{(several['same_bits'] == 1).sum()} of {len(several)} runs end in the same bits" if len(several)
            else f"None of {counted(len(frame), 'run')} is on several threads")
    footnote(fig, "Whiskers: range of the repeats on several threads." + (
        f" More than {number(most)}: as many cores have as many caches." if (several["speedup"] > most).any() else ""))
    return fig


@figure("threads", "bandwidth", table="sweeps")
def bandwidth(frame):
    """The bytes a second that sweeps move at least, beside what copying memory moves."""
    rows = good(frame, "share_of_copy")
    scenes = list(frame["scene"].unique())
    most = rows["threads"].max() if len(rows) else 1
    fig, axes = panels(len(scenes), columns=2, height=2.6, sharey=True)
    for ax, scene in zip(axes, scenes):
        here = rows[rows["scene"] == scene]
        names = list(dict.fromkeys(here["relaxation"]))
        for shift, threads, color in ((-0.18, 1, BLUE), (0.18, most, ORANGE)):
            own = here[here["threads"] == threads]
            places = [names.index(name) + shift for name in own["relaxation"]]
            ax.barh(places, own["share_of_copy"], height=0.32, color=color, label=f"{number(threads)} thread" + "s" * (threads > 1))
            for place, value in zip(places, own["share_of_copy"]):
                ax.text(value, place, f" {number(value)}", va="center", fontsize=6.5)
            if most == 1:
                break
        ax.set_yticks(range(len(names)), names)
        guide(ax, 1, "copying", horizontal=False)
        ax.grid(axis="y", visible=False)
        ax.set(title=scene, xlabel="share of the bandwidth of copying", xlim=(0, 1.3))
    axes[0].invert_yaxis()
    axes[0].legend(loc="lower right")
    one = rows[rows["threads"] == 1]["share_of_copy"]
    finding(fig, f"On one thread a sweep moves its bytes at {span(one)} of the speed of copying memory" if len(one)
            else f"None of {counted(len(frame), 'run')} has a number")
    footnote(fig, "Bytes: the rows once, their impulses twice, each velocity in and out. What is far below copying is bound by arithmetic "
             "and by waiting for the row before.")
    return fig


@figure("threads", "roofline", table="roofline")
def roofline(frame):
    """What a sweep over each effect's rows does a second, beside what memory and arithmetic allow."""
    rows = good(frame, "share_of_roof").assign(
        intensity=lambda rows: rows["flops"] / rows["bytes"], rate=lambda rows: 1e-9 * rows["flops"] / rows["wall_s_per_sweep"])
    most = rows["threads"].max() if len(rows) else 1
    names = list(dict.fromkeys(rows["effect"]))
    fig, (roof, shares) = panels(2, columns=2, width=6.5, height=1.0 + 0.17 * max(len(names), 6))
    for threads, color in ((1, BLUE), (most, ORANGE)):
        own = rows[rows["threads"] == threads]
        if not len(own) or (threads == 1 and color == ORANGE):
            continue
        label = f"{number(threads)} thread" + "s" * (threads > 1)
        x = np.geomspace(0.05, 20, 100)
        limit = np.minimum(x * own["copied_bytes_per_s"].iloc[0], own["product_flops_per_s"].iloc[0]) * 1e-9
        roof.plot(x, limit, color=color, linewidth=1.0, label=f"roof, {label}")
        for relaxation, points in own.groupby("relaxation", sort=False):
            roof.plot(points["intensity"], points["rate"], style(relaxation)["marker"], color=color, markersize=3.5, markerfacecolor="none")
        sweep = own[own["relaxation"].str.contains("gauss_seidel")]
        shares.plot(sweep["share_of_roof"], [names.index(name) for name in sweep["effect"]], "o", color=color, markersize=4, label=label)
    roof.set(xscale="log", yscale="log", xlabel="operations a byte", ylabel="1e9 operations a second")
    roof.legend(loc="lower right", fontsize=6)
    shares.set_yticks(range(len(names)), names, fontsize=6)
    shares.invert_yaxis()
    guide(shares, 1, "roof", horizontal=False)
    shares.set(xlabel="share of the roof, Gauss-Seidel", xlim=(0, None))
    shares.legend(loc="upper left", fontsize=6)
    one = rows[(rows["threads"] == 1) & (rows["relaxation"] == "gauss_seidel")]
    finding(fig, f"One thread sweeps {number(len(one))} kinds of rows by Gauss-Seidel at {span(one['share_of_roof'])} of what the machine "
            "allows" if len(one) else f"None of {counted(len(frame), 'run')} has a number")
    footnote(fig, "Roof: the lesser of copying memory and of products of dense matrices, in the same run. Bytes and operations: the least that a sweep "
             "needs; laws of friction are not counted. What reads more than it writes may be above copying. Marks by relaxation: " +
             ", ".join(f"{name} {style(name)['marker']}" for name in dict.fromkeys(rows["relaxation"])) + ".")
    return fig
