"""Tests of reading and of keeping failures visible:  python3 -m unittest discover -s plots"""

import json
import math
import tempfile
import unittest
from pathlib import Path

import numpy as np

import common
import reading
import selecting
import sample


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

    def verdicts(self, measured, bound, word, basis="code", low=None, high=None):
        low, high = (measured if end is None else end for end in (low, high))
        self.path.write_text("class,measured_low,measured,measured_high,bound,verdict\n"
                             f"{basis},{low},{measured},{high},{bound},{word}\n", encoding="utf-8")
        return reading.read_verdicts(self.path, ["class", "bound", "verdict"])["verdict"].tolist()

    def test_verdicts_are_what_their_numbers_say(self):
        for measured, bound, word in ((1, 1, "holds"), (2, 1, "fails"), ("nan", 1, "fails"), ("inf", 1, "fails"), ("", 1, "fails"),
                                      (-1, 1, "fails")):
            self.assertEqual(self.verdicts(measured, bound, word), [word])
        for measured, bound, word, allowed in ((2, 1, "holds", "'fails'"), (1, 1, "fails", "'holds'"), ("nan", 1, "holds", "'fails'"),
                                               (2, 1, "missed", "'fails'"), (2, 1, "not_decided", "'fails'"), (-1, 1, "holds", "'fails'"),
                                               (1, "nan", "fails", "a finite number"), (1, "inf", "holds", "a finite number"),
                                               (1, 2, "passes", "holds, fails"), (1, 2, "", "holds, fails")):
            with self.assertRaisesRegex(reading.InputError, f"table.csv: line 2: .*allowed: {allowed}"):
                self.verdicts(measured, bound, word)

    def test_a_goal_is_missed_and_a_spread_over_the_bound_is_not_decided(self):
        self.assertEqual(self.verdicts(2, 1, "missed", "goal"), ["missed"])
        self.assertEqual(self.verdicts(1, 1.2, "not_decided", low=0.9, high=1.3), ["not_decided"])
        self.assertEqual(self.verdicts(2, 1.2, "fails", low=1.3, high=3), ["fails"])
        for word, low, high in (("holds", 0.9, 1.3), ("holds", "nan", 1), ("not_decided", 0.9, "nan"), ("not_decided", 1.1, 1.3)):
            with self.assertRaisesRegex(reading.InputError, "column 'verdict'"):
                self.verdicts(1, 1.2, word, low=low, high=high)
        with self.assertRaisesRegex(reading.InputError, "column 'class': got 'taste'"):
            self.verdicts(1, 1, "holds", "taste")

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

    def test_a_table_has_the_rows_that_its_run_counted(self):
        for counted, said in ((2, None), (1, "got 2 rows; allowed: 1"), (3, "got 2 rows; allowed: 3"), ("x", 'allowed: "x"')):
            sample.write_run(self.path.parent, ".")
            self.run_json(json.dumps(reading.read_run(self.path.parent) | {"rows": {"table": counted, "other": 7}}))
            if said:
                self.assert_refused("error\n1\n2\n", said, "run.json")
            else:
                self.assertEqual(len(self.read("error\n1\n2\n")), 2)
        self.run_json('{"status": "interrupted", "rows": [2]}')
        with self.assertRaisesRegex(reading.InputError, "run.json: key 'rows': got"):
            self.read("error\n1\n2\n")

    def test_runs_that_are_not_complete(self):
        self.assertIn("no run.json", reading.shortfall(reading.read_run(self.path.parent)))
        self.assertEqual(reading.shortfall(self.run_json('{"status": "interrupted"}')), "interrupted")
        self.assertEqual(reading.shortfall(self.run_json('{"status": "failed", "reason": "why"}')), "failed: why")


class Failures(unittest.TestCase):
    def test_every_row_is_good_or_failed(self):
        frame = reading.pd.DataFrame({"error": [1.0, np.nan, 1e308, -1.0, 0.0, 2.0],
                                     "status": ["ok", "ok", "ok", "ok", "ok", "diverged"], "reason": [""] * 5 + ["far"]})
        self.assertEqual(selecting.good(frame, "error").index.tolist(), [0, 4])
        self.assertEqual(selecting.failed(frame, "error").index.tolist(), [1, 2, 3, 5])

    def test_reasons_are_counted(self):
        frame = reading.pd.DataFrame({"status": ["diverged", "diverged", "ok"], "reason": ["far", "far", ""]})
        self.assertEqual(selecting.reasons_note(frame), "Crossed, not ok: 2 x diverged: far; 1 x ok, but no number that can be drawn")

    def test_a_long_reason_is_cut_with_a_mark(self):
        frame = reading.pd.DataFrame({"status": ["diverged"], "reason": ["far away " * 30]})
        self.assertRegex(selecting.reasons_note(frame), r"far away \.\.\.$")

    def test_traces_that_fail_are_crossed(self):
        for values, place in (([1.0, np.nan], (0.1, 1.0)), ([1.0, 3.0], (0.2, 2.0)), ([np.nan, np.nan], (0.2, 0.97))):
            rows = reading.pd.DataFrame({"time_s": [0.1, 0.2], "status": ["ok", "diverged"]})
            figure, (ax,) = common.panels(1)
            common.trace(ax, rows, np.array(values), "bdf2", high=2.0)
            crosses = [line for line in ax.lines if line.get_marker() == "x"]
            self.assertEqual([(line.get_xdata()[0], line.get_ydata()[0]) for line in crosses], [place])
            common.plt.close(figure)

    def test_a_cost_ratio_is_auto_s_work_over_plain_s(self):
        frame = reading.pd.DataFrame([("plain", 10.0, 1.0, "ok"), ("auto", 30.0, 1.0, "ok"), ("auto", 0.0, 5.0, "ok"), ("auto", 30.0, 1.0, "diverged")],
                                     columns=["outer", "row_updates", "wall_s", "status"])
        for key in ("scene", "parameter", "value", "step_s", "measured_rate", "relaxation"):
            frame[key] = 1.0
        found = selecting.cost_ratios(frame)
        self.assertEqual(found["ratio"].tolist()[:2], [3.0, 5.0])  # of updates; of times where there are none
        self.assertTrue(math.isnan(found["ratio"][2]))

    def test_a_gate_of_a_scene_holds_up_to_its_bound(self):
        frame = reading.pd.DataFrame({"scene": ["a", "b"], "step_s": 0.01, "steps": 10, "steps_ok": [10, 9], "refuted_steps": 0,
                                      "overlap_share": [1e-2, 2e-2], "overlap_share_at_end": 0.0, "bilateral_error_m": [0.0, math.nan],
                                      "driven": [0, 0], "excess_share": [1e-6, 2e-6], "rest_share": 0.0})
        found = selecting.scene_gates(frame)
        self.assertEqual(len(found), 2 * len(selecting.SCENE_GATES))
        self.assertTrue(found["holds"][found["scene"] == "a"].all())
        self.assertEqual(found["gate"][~found["holds"]].tolist(), ["steps that miss their tolerance", "overlap", "bilateral error",
                                                                 "energy above the start's"])

    def test_scenes_read_with_short_numbers(self):
        for scene, text in (("cantilever E=100000 Pa", "cantilever E=1e5 Pa"), ("cantilever E=1e+06 Pa nu=0.49", "cantilever E=1e6 Pa nu=0.49"),
                            ("chain20 tip x100", "chain20 tip x100")):
            self.assertEqual(selecting.scene_text(scene), text)

    def test_steps_read_as_fractions(self):
        self.assertEqual([selecting.step_text(h) for h in (1 / 60, 0.2, 0.013)], ["1/60 s", "0.2 s", "0.013 s"])


if __name__ == "__main__":
    unittest.main()
