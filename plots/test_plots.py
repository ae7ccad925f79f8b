"""Tests of every figure and of the commands:  python3 -m unittest discover -s plots"""

import math
import re
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np
import pandas as pd

import common
import finding
import saving
import compare
import make
import reading
import selecting
import sample
import tables
import trajectories

HERE = Path(__file__).parent


def title_of(figure):
    return figure._suptitle.get_text() if figure._suptitle else ""


def broken_rules(figure):
    """What keeps a reader from seeing at once what a figure says."""
    figure.draw_without_rendering()
    axes = [ax for ax in figure.axes if ax.get_label() != "<colorbar>"]
    series = {label for ax in axes for label in ax.get_legend_handles_labels()[1]}
    legends = [*figure.legends, *(ax.get_legend() for ax in axes if ax.get_legend())]
    named = {text.get_text() for legend in legends for text in legend.get_texts()}
    named |= {text.get_text().removesuffix(" (no point)") for ax in axes for text in ax.texts if text.get_gid() == "name"}
    title = title_of(figure)
    wide = figure._suptitle.get_window_extent().width > figure.bbox.width if title else False
    return [broken for broken, is_so in (
        (f"{len(axes)} panels", len(axes) > finding.MOST_PANELS), (f"{len(series)} series", len(series) > finding.MOST_SERIES),
        (f"not named: {series - named}", len(series) > 1 and not series <= named),
        (f"no number in the title: {title}", not re.search(r"\d", title)),
        ("a title of more than three lines", title.count("\n") > 2), ("a title wider than the figure", wide)) if is_so]


class Drawing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.directory = Path(cls.folder.name)
        sample.write_all(cls.directory)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def table(self, entry):
        path = self.directory / entry.experiment / f"{entry.table}.csv"
        return reading.read_table(path, tables.columns(entry.experiment, entry.table))

    def test_every_figure_draws_the_sample_and_can_be_read_in_five_seconds(self):
        for entry in common.FIGURES:
            with self.subTest(entry.experiment + "_" + entry.name):
                figure = entry.draw(self.table(entry))
                self.assertIsNotNone(figure)
                with warnings.catch_warnings(action="error"):
                    self.assertEqual(broken_rules(figure), [])
                self.assertLess(figure.get_tightbbox().width, 1.5 * figure.get_figwidth())  # nothing stands far off
                common.plt.close(figure)

    def test_every_figure_survives_nothing_but_failures(self):
        for entry in common.FIGURES:
            with self.subTest(entry.experiment + "_" + entry.name):
                frame = self.table(entry)
                numbers = [c for c in frame if c not in reading.TEXT and c.startswith(("error", "measured", "value",
                           "wall_s", "bytes", "difference", "residual"))]
                frame[numbers] = np.nan
                frame = frame.assign(status="diverged", reason="non-finite")
                figure = entry.draw(frame)
                if figure:
                    saving.give_empty_axes_limits(figure)
                    figure.draw_without_rendering()
                    common.plt.close(figure)

    def test_the_rules_find_a_figure_that_breaks_them(self):
        figure, axes = common.panels(7)
        for k in range(8):
            axes[0].plot([1, 2], [k, k], label=f"series {k}")
        figure.suptitle("Errors of all methods")
        self.assertEqual(len(broken_rules(figure)), 4)
        common.plt.close(figure)

    def test_findings_are_made_of_the_data(self):
        """Where nothing but failures is left no figure says what it said before, and it still says a number."""
        for entry in common.FIGURES:
            frame = self.table(entry)
            if "status" not in frame:
                continue
            with self.subTest(entry.experiment + "_" + entry.name):
                before = entry.draw(frame)
                numbers = [c for c in frame if c not in reading.TEXT | reading.SETTINGS and c not in (
                    "alpha", "direction_blend", "stabilisation", "friction", "count", "restitution", "bounce", "value", "compliance_m_per_n", "retardation_s", "time_s", "heading_deg")]
                frame = frame.assign(**{c: np.nan for c in numbers}, status="diverged", reason="not finite")
                after = entry.draw(frame)
                if after:
                    self.assertNotEqual(title_of(before), title_of(after))
                    self.assertRegex(title_of(after), r"\d")
                    self.assertNotRegex(title_of(after), r"\bnan\b")
                    common.plt.close(after)
                common.plt.close(before)

    def test_lines_are_named_apart_from_each_other(self):
        figure, (ax,) = common.panels(1)
        for k in range(6):
            ax.plot([1, 2], [1, 1 + 1e-3 * k], label=f"line {k}")
        finding.name_lines(ax)
        figure.draw_without_rendering()
        boxes = [text.get_window_extent() for text in ax.texts]
        self.assertEqual(len(boxes), 6)
        self.assertFalse(any(one.overlaps(other) for one in boxes for other in boxes if one is not other))
        common.plt.close(figure)

    def test_memory_to_an_error_is_the_least_of_all_and_that_of_the_quickest(self):
        runs = pd.DataFrame({"scene": ["a", "a", "a", "a", "b", "c"], "told": [1e-3, 1e-5, 1e-5, 1e-5, 1e-3, 1e-5],
                             "wall_s": [0.1, 3.0, 2.0, 1.0, 1.0, 1.0], "memory_mb": [0.1, 1.0, 4.0, 2.0, 1.0, 1.0],
                             "error_bar": [1e-9] * 5 + [1e-4], "status": "ok"})
        found = trajectories.memories(runs, 1e-4)
        self.assertEqual([(scene, row["least"], row["quickest"]) for scene, row in found.iterrows()], [("a", 1.0, 2.0)])

    def test_every_solver_counts_at_its_own_tightest_tolerance(self):
        frame = pd.DataFrame({"relaxation": ["judge", "a", "a", "b", "b"], "tolerance": [1e-10, 1e-4, 1e-8, 1e-4, 1e-8]})
        self.assertEqual(list(selecting.tightest(frame).index), [0, 2, 4])

    def test_a_map_without_a_single_rate(self):
        entry = next(e for e in common.FIGURES if e.name == "map")
        frame = self.table(entry).assign(measured_rate=np.nan, predicted_rate=np.nan, behaviour="diverging")
        common.plt.close(entry.draw(frame))
        self.assertIsNone(entry.draw(frame[:0]))

    def test_numbers_near_overflow(self):
        for entry in common.FIGURES:
            if entry.name in ("map", "final", "rates"):
                frame = self.table(entry)
                frame[[c for c in frame if c.startswith(("error", "measured", "predicted"))]] = 1e308
                figure = entry.draw(frame)
                figure.draw_without_rendering()
                common.plt.close(figure)

    def test_no_name_is_a_formula(self):
        for entry in common.FIGURES:
            with self.subTest(entry.experiment + "_" + entry.name):
                frame = self.table(entry)
                names = {c: [f"$\\no{{_{text}$ %&^" for text in frame[c]] for c in frame
                         if c in reading.TEXT - {"status", "behaviour", "outer"}}
                figure = entry.draw(common.literal(frame.assign(**names)))
                if figure:
                    figure.draw_without_rendering()
                    common.plt.close(figure)

    def test_logarithmic_axes_have_two_labels(self):
        for low, high in ((3e-16, 2e5), (2e-4, 5e-3), (0.2, 0.9), (2.1e-11, 2.2e-11), (1e-11, 1.5e-11), (4.0, 4.1), (99.0, 101.0)):
            for limits in ((low, high), (high, low)):
                figure, (ax,) = common.panels(1)
                ax.set(xscale="log", yscale="log", xlim=limits, ylim=limits)
                saving.label_log_axes(figure)
                figure.draw_without_rendering()
                for axis in (ax.xaxis, ax.yaxis):
                    first, last = axis.get_view_interval()
                    shown = [tick for tick in axis.get_major_ticks() if tick.label1.get_text()
                             and min(first, last) <= tick.get_loc() <= max(first, last)]
                    self.assertGreaterEqual(len(shown), 2, limits)
                    self.assertEqual(first < last, limits[0] < limits[1])
                    self.assertTrue(min(first, last) <= low and high <= max(first, last))
                common.plt.close(figure)

    def test_the_list_of_experiments_names_every_table(self):
        text = (HERE.parent / "experiments" / "README.md").read_text(encoding="utf-8")
        named = {}
        for experiment, row in re.findall(r"^\| `(\w+)` \| (`.*`) \|$", text, re.M):
            named[experiment] = re.findall(r"`(\w+)`", row)
        known = {}
        for experiment, table in tables.TABLES:
            known.setdefault(experiment, []).append(table)
        self.assertEqual(named, {experiment: names for experiment, names in known.items() if experiment != "."})

    def test_saving_twice_gives_the_same_bytes(self):
        entry = next(e for e in common.FIGURES if e.experiment == "mesh_refinement" and e.name == "mms")
        written = []
        for _ in range(2):
            saving.save(entry.draw(self.table(entry)), self.directory / "figures", "twice", "foot")
            written.append([(self.directory / "figures" / f"twice.{kind}").read_bytes()
                            for kind in ("png", "svg", "pdf")])
        self.assertEqual(written[0], written[1])

    def test_tables_without_a_figure_are_named(self):
        sample.write(self.directory, "judges", "unseen", "scene value", [("a", 1.0)])
        self.assertEqual([path.name for path in make.without_figure(self.directory)], ["unseen.csv"])
        (self.directory / "judges" / "unseen.csv").unlink()


class Commands(unittest.TestCase):
    def run_plots(self, script, *arguments):
        return subprocess.run([sys.executable, HERE / script, *arguments], capture_output=True, text=True, check=False)

    def test_help_and_wrong_usage(self):
        for script in ("make.py", "compare.py", "sample.py", "../paper/report.py"):
            asked = self.run_plots(script, "--help")
            self.assertEqual((asked.returncode, asked.stderr), (0, ""))
            self.assertIn("DIR", asked.stdout)
            wrong = self.run_plots(script, "a", "b")
            self.assertEqual(wrong.returncode, 2)
            self.assertIn("unrecognized arguments: b", wrong.stderr)

    def test_the_sample_never_goes_among_results(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(self.run_plots("sample.py", folder).returncode, 0)
            self.assertEqual(self.run_plots("sample.py", folder).returncode, 2)

    def test_figures_is_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            sample.write_all(folder)
            (Path(folder) / "figures").touch()
            for script in ("make.py", "compare.py"):
                result = self.run_plots(script, folder)
                self.assertEqual((result.returncode, result.stderr.count("\n")), (2, 1))
                self.assertIn("figures", result.stderr)

    def test_a_run_that_is_not_complete_has_no_figures_not_even_old_ones(self):
        with tempfile.TemporaryDirectory() as folder:
            sample.judges(folder)
            (Path(folder) / "figures").mkdir()
            old = Path(folder) / "figures" / "judges_agreement.png"
            old.touch()
            result = self.run_plots("make.py", folder)
            self.assertIn("skipped: judges_agreement: ", result.stderr)
            self.assertIn("no run.json", result.stderr)
            self.assertEqual(result.returncode, 2)
            self.assertFalse(old.exists())

    def test_bad_table_exits_with_2_and_names_the_place(self):
        with tempfile.TemporaryDirectory() as folder:
            sample.write(folder, "judges", "agreement", "scene nodes", [("pendulum", 2)])
            sample.write_run(folder, "judges")
            result = self.run_plots("make.py", folder)
            self.assertEqual(result.returncode, 2)
            self.assertIn("agreement.csv: column 'step_s' is missing", result.stderr)

    def test_missing_experiments_are_skipped_with_a_message(self):
        with tempfile.TemporaryDirectory() as folder:
            sample.judges(folder)
            sample.write_run(folder, "judges")
            result = self.run_plots("make.py", folder)
            self.assertEqual(result.returncode, 0)
            self.assertIn("skipped: outer_convergence_map", result.stderr)

    def test_a_folder_without_any_result_exits_with_2(self):
        with tempfile.TemporaryDirectory() as folder:
            result = self.run_plots("make.py", folder)
            self.assertEqual(result.returncode, 2)
            self.assertIn("got no result to draw", result.stderr)

    def test_sigterm_leaves_no_partial_file(self):
        with tempfile.TemporaryDirectory() as folder:
            begun = f"with command.replacing(command.Path('{folder}/x.png')) as p: p.touch(); print(flush=True); time.sleep(60)"
            script = f"import command, sys, time\ndef main(_):\n  {begun}\nsys.argv = ['x']\ncommand.command(main, '')"
            with subprocess.Popen([sys.executable, "-c", script], cwd=HERE, stdout=subprocess.PIPE) as process:
                process.stdout.readline()
                self.assertEqual(len(list(Path(folder).iterdir())), 1)
                process.terminate()
                self.assertEqual(process.wait(30), 143)
            self.assertEqual(list(Path(folder).iterdir()), [])

    def test_no_folder_exits_with_2(self):
        self.assertEqual(self.run_plots("make.py", "/nonexistent/results").returncode, 2)

    def test_compare(self):
        with tempfile.TemporaryDirectory() as folder:
            sample.write_all(folder)
            self.assertEqual(self.run_plots("compare.py", folder).returncode, 0)
            self.assertTrue((Path(folder) / "figures" / "compare_seconds.svg").exists())

    def test_compare_draws_motions_of_all_steps_and_integrators_in_one_panel(self):
        with tempfile.TemporaryDirectory() as folder:
            rows = [("a", 1.0, "none", "reference", "ode", "none", 0, 0, 0, 1.0, 1e-6, "ok", "", "ode", 1.0, 1e-6, "ODE"),
                    ("a", 0.1, "bdf2", "plain", "direct", "none", 1, 1, 1, 2.0, 1e-7, "ok", "", "x", 1.0, 1e-6, "ODE"),
                    ("a", 0.2, "newmark", "plain", "direct", "none", 1, 1, 1, 1.0, 2e-7, "ok", "", "y", 1.0, 1e-6, "ODE"),
                    ("a", 0.1, "newmark", "plain", "jacobi", "none", 1, 1, 1, 1.0, 0.1, "not_converged", "far", "z", 1.0, 1e-6, "ODE")]
            sample.write(folder, ".", "compare", tables.METHOD + " method duration_s error_bar truth", rows)
            fig = compare.draw(reading.read_table(Path(folder) / "compare.csv"))
            self.assertEqual(len(fig.axes), 1)
            self.assertEqual([text.get_text() for text in fig.legends[0].get_texts()], ["x", "y"])
            self.assertIn("Least error told: 3e-6 in 1 s by y", title_of(fig))

    def test_a_comparison_without_an_error_is_never_ok(self):
        with tempfile.TemporaryDirectory() as folder:
            row = ("a", 0.1, "bdf2", "plain", "direct", "none", 1, 1, 1, 1.0, math.nan, "ok", "", "outer=plain")
            sample.write(folder, ".", "compare", tables.METHOD + " method", [row])
            result = self.run_plots("compare.py", folder)
            self.assertEqual(result.returncode, 2)
            self.assertIn("compare.csv: line 2: column 'error': got nan", result.stderr)

    def test_compare_tells_methods_apart_that_differ_in_a_parameter_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            sample.write_all(folder)
            frame = reading.read_table(Path(folder) / "compare.csv")
            one = frame[frame["outer"] == "proximal"]
            fig = compare.draw(pd.concat([one.assign(method="memory=0"), one.assign(method="memory=20")]))
            entries = dict(zip((text.get_text() for text in fig.legends[0].get_texts()), fig.legends[0].get_lines()))
            self.assertEqual(sorted(entries), ["memory=0", "memory=20"])
            colors = {line.get_color() for line in entries.values()}
            self.assertEqual(len(colors), 2)
            self.assertLessEqual(colors, {line.get_color() for line in fig.axes[0].lines})


if __name__ == "__main__":
    unittest.main()
