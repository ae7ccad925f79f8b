"""Tests of reading, of keeping failures visible, and of every figure:  python3 -m unittest discover -s plots"""

import json
import math
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np
import pandas as pd

import common
import compare
import make
import reading
import sample
import tables

HERE = Path(__file__).parent


class Reading(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name) / "table.csv"

    def read(self, text, columns=()):
        self.path.write_text(text, encoding="utf-8")
        return reading.read_table(self.path, columns)

    def assert_refused(self, text, *words, columns=()):
        with self.assertRaises(reading.InputError) as caught:
            self.read(text, columns)
        for word in (str(self.path), *words):
            self.assertIn(word, str(caught.exception))

    def test_all_17_digits_survive(self):
        self.assertEqual(self.read("error\n0.10000000000000001\n1.0000000000000002\n")["error"].tolist(),
                         [0.1, 1.0000000000000002])

    def test_nan_infinities_and_nothing_are_numbers(self):
        values = self.read("error,status\nnan,ok\ninf,ok\n-inf,ok\n,skipped\n")["error"]
        self.assertTrue(math.isnan(values[0]) and math.isnan(values[3]))
        self.assertEqual(values[1:3].tolist(), [math.inf, -math.inf])

    def test_words_that_look_like_missing_values_stay_words(self):
        self.assertEqual(self.read("scene,reason\nnan,NA\n").loc[0].tolist(), ["nan", "NA"])

    def test_missing_column(self):
        self.assert_refused("scene,sweep\nchain,1\n", "'error'", "needed: scene, error", "found: scene, sweep",
                            columns=["scene", "error"])

    def test_not_a_number(self):
        self.assert_refused("scene,error\nchain,1\nchain,much\n", "line 3", "'error'", "'much'", "allowed",
                            columns=["error"])

    def test_words_in_a_column_nobody_asked_for(self):
        self.assertEqual(self.read("error,colour\n1,red\n", ["error"])["colour"].tolist(), ["red"])

    def test_unknown_status(self):
        self.assert_refused("error,status\n1,fine\n", "line 2", "'fine'", "not_converged")

    def test_unknown_behaviour(self):
        self.assert_refused("behaviour\nfalling\n", "line 2", "'falling'", "converged")

    def test_too_few_and_too_many_cells(self):
        self.assert_refused("scene,error\nchain\n", "line 2", "got 1 cells")
        self.assert_refused("scene,error\nchain,1,2\n", "line 2", "got 3 cells")

    def test_column_twice(self):
        self.assert_refused("error,error\n1,2\n", "'error'", "twice")

    def test_control_characters_and_binary_garbage(self):
        self.assert_refused("scene\na\x00b\n", "line 2", r"'a\x00b'", "printable")
        self.path.write_bytes(bytes(range(256)))
        with self.assertRaises(reading.InputError):
            reading.read_table(self.path)

    def test_settings_that_cannot_be(self):
        for value in ("0", "-1", "nan", "inf", "1e308"):
            self.assert_refused(f"step_s\n{value}\n", "line 2", "'step_s'", "allowed", columns=["step_s"])
        self.assert_refused("sweep\nnan\n", "line 2", "'sweep'", columns=["sweep"])
        self.assertEqual(self.read("sweep\n0\n", ["sweep"])["sweep"].tolist(), [0])

    def verdicts(self, measured, bound, word):
        self.path.write_text(f"measured,bound,verdict\n{measured},{bound},{word}\n", encoding="utf-8")
        return reading.read_verdicts(self.path, ["measured", "bound", "verdict"])["verdict"].tolist()

    def test_verdicts_are_what_their_numbers_say(self):
        for measured, bound, word in ((1, 1, "holds"), (2, 1, "fails"), ("nan", 1, "fails"), ("inf", 1, "fails"), ("", 1, "fails")):
            self.assertEqual(self.verdicts(measured, bound, word), [word])
        for measured, bound, word, allowed in ((2, 1, "holds", "'fails'"), (1, 1, "fails", "'holds'"), ("nan", 1, "holds", "'fails'"),
                                               (1, "nan", "fails", "a finite number"), (1, "inf", "holds", "a finite number"),
                                               (1, 2, "passes", "holds, fails"), (1, 2, "", "holds, fails")):
            with self.assertRaisesRegex(reading.InputError, f"table.csv: line 2: .*allowed: {allowed}"):
                self.verdicts(measured, bound, word)

    def test_empty_and_absent_file(self):
        self.assert_refused("", "header")
        with self.assertRaises(reading.InputError):
            reading.read_table(self.path.with_name("absent.csv"))

    def run_json(self, text):
        (self.path.parent / "run.json").write_text(text, encoding="utf-8")
        return reading.read_run(self.path.parent)

    def test_bad_runs(self):
        for text, said in (("{", "JSON"), ("[" * 99999, "JSON"), ('{"status": "\\ud800"}', "JSON"), ("[1]", r"got \[1\]"),
                           ('"x"', 'got "x"'), ("{}", "'status': got nothing"), ('{"status": 1}', "'status': got 1")):
            with self.assertRaisesRegex(reading.InputError, f"run.json: .*{said}"):
                self.run_json(text)

    def test_a_complete_run_has_every_fact(self):
        sample.write_run(self.path.parent, ".")
        run = reading.read_run(self.path.parent)
        self.assertEqual(reading.shortfall(run), "")
        for key in reading.RUN:
            for value in (None, [1]):
                with self.assertRaisesRegex(reading.InputError, f"'{key}': got .*; allowed: "):
                    self.run_json(json.dumps(run | {key: value}))
        for key, value in (("wall_s", True), ("wall_s", math.nan), ("dirty", 1)):
            with self.assertRaisesRegex(reading.InputError, f"'{key}': got "):
                self.run_json(json.dumps(run | {key: value}))

    def test_runs_that_are_not_complete(self):
        self.assertIn("no run.json", reading.shortfall(reading.read_run(self.path.parent)))
        self.assertEqual(reading.shortfall(self.run_json('{"status": "interrupted"}')), "interrupted")
        self.assertEqual(reading.shortfall(self.run_json('{"status": "failed", "reason": "why"}')), "failed: why")


class Failures(unittest.TestCase):
    def test_every_row_is_good_or_failed(self):
        frame = reading.pd.DataFrame({"error": [1.0, np.nan, 1e308, -1.0, 0.0, 2.0],
                                     "status": ["ok", "ok", "ok", "ok", "ok", "diverged"], "reason": [""] * 5 + ["far"]})
        self.assertEqual(reading.good(frame, "error").index.tolist(), [0, 4])
        self.assertEqual(reading.failed(frame, "error").index.tolist(), [1, 2, 3, 5])

    def test_reasons_are_counted(self):
        frame = reading.pd.DataFrame({"status": ["diverged", "diverged", "ok"], "reason": ["far", "far", ""]})
        self.assertEqual(reading.reasons_note(frame), "Crossed, not ok: 2 x diverged: far; 1 x ok, but no number that can be drawn")

    def test_traces_that_fail_are_crossed(self):
        for values, place in (([1.0, np.nan], (0.1, 1.0)), ([1.0, 3.0], (0.2, 2.0)), ([np.nan, np.nan], (0.2, 0.97))):
            rows = reading.pd.DataFrame({"time_s": [0.1, 0.2], "status": ["ok", "diverged"]})
            figure, (ax,) = common.panels(1)
            common.trace(ax, rows, np.array(values), "bdf2", high=2.0)
            crosses = [line for line in ax.lines if line.get_marker() == "x"]
            self.assertEqual([(line.get_xdata()[0], line.get_ydata()[0]) for line in crosses], [place])
            common.plt.close(figure)

    def test_steps_read_as_fractions(self):
        self.assertEqual([reading.step_text(h) for h in (1 / 60, 0.2, 0.013)], ["1/60 s", "0.2 s", "0.013 s"])


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

    def test_every_figure_draws_the_sample(self):
        for entry in common.FIGURES:
            with self.subTest(entry.experiment + "_" + entry.name):
                figure = entry.draw(self.table(entry))
                self.assertIsNotNone(figure)
                with warnings.catch_warnings(action="error"):
                    figure.draw_without_rendering()
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
                    common._give_empty_axes_limits(figure)
                    figure.draw_without_rendering()
                    common.plt.close(figure)

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

    def test_saving_twice_gives_the_same_bytes(self):
        entry = next(e for e in common.FIGURES if e.experiment == "mesh_refinement" and e.name == "mms")
        written = []
        for _ in range(2):
            common.save(entry.draw(self.table(entry)), self.directory / "figures", "twice", "foot")
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
            result = self.run_plots("make.py", folder)
            self.assertEqual(result.returncode, 0)
            self.assertIn("skipped: judges_agreement", result.stderr)

    def test_no_folder_exits_with_2(self):
        self.assertEqual(self.run_plots("make.py", "/nonexistent/results").returncode, 2)

    def test_compare(self):
        with tempfile.TemporaryDirectory() as folder:
            sample.write_all(folder)
            self.assertEqual(self.run_plots("compare.py", folder).returncode, 0)
            self.assertTrue((Path(folder) / "figures" / "compare_seconds.svg").exists())

    def test_compare_tells_methods_apart_that_differ_in_a_parameter_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            sample.write_all(folder)
            frame = reading.read_table(Path(folder) / "compare.csv")
            one = frame[frame["outer"] == "proximal"]
            axes = compare.draw(pd.concat([one.assign(method="memory=0"), one.assign(method="memory=20")])).axes
            curves = {line.get_label(): line for line in axes[0].lines if line.get_label().startswith("memory")}
            self.assertEqual(sorted(curves), ["memory=0", "memory=20"])
            self.assertNotEqual(curves["memory=0"].get_color(), curves["memory=20"].get_color())


if __name__ == "__main__":
    unittest.main()
