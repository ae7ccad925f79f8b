"""Tests of the report:  python3 -m unittest discover -s paper"""

import hashlib
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import report
import sections
from failed import cause, failed_section, failures, stripped
from reading import InputError
from results import Results
from sections.trajectories import choice, practised
from tables import VERDICTS

import reading
import sample
from common import FIGURES
import make  # noqa: F401  (registers the figures)

DRAWN = {"svg": b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1 1"/>', "png": b"", "pdf": b""}


class Report(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.directory = Path(folder.name)

    def html(self):
        with mock.patch("sys.stdout"), mock.patch("sys.stderr"):
            report.main(self.directory)
        return (self.directory / "report.html").read_text(encoding="utf-8")

    def draw(self, name):
        (self.directory / "figures").mkdir(exist_ok=True)
        for kind, data in DRAWN.items():
            (self.directory / "figures" / f"{name}.{kind}").write_bytes(data)

    def test_all_experiments(self):
        sample.write_all(self.directory)
        for figure in FIGURES:
            self.draw(f"{figure.experiment}_{figure.name}")
        with mock.patch.object(report, "write_pdf"):
            text = self.html()
        for absent in (sections.NO_TABLE, "Not drawn", "incomplete", "stem from different", "[#", "is missing"):
            self.assertNotIn(absent, text)
        count = len(sections.SECTIONS)  # each has one verdict that does not hold
        holds = count + sum(map(len, sample.CLAIMED.values()))
        self.assertIn(f"{holds} of {holds + count} verdicts hold", text)
        self.assertIn("theory predicts contraction in 4; 4 of these converge", text)
        self.assertNotIn("http://", text)

    @unittest.skipUnless(shutil.which("latexmk"), "latexmk is not installed")
    def test_pdf(self):
        sample.write_all(self.directory)
        self.html()
        self.assertTrue((self.directory / "report.pdf").read_bytes().startswith(b"%PDF"))

    def test_nothing_run(self):
        with self.assertRaisesRegex(InputError, "got no experiment"):
            report.main(self.directory)

    def test_without_latex_html_is_still_written(self):
        sample.write_all(self.directory)
        (self.directory / "report.pdf").write_text("of an earlier run", encoding="utf-8")
        with mock.patch.object(report.shutil, "which", return_value=None), \
                self.assertRaisesRegex(InputError, "latexmk is not installed"):
            self.html()
        self.assertEqual(sorted(path.name for path in self.directory.glob("report*")), ["report.html"])

    def change_run(self, experiment, **values):
        path = self.directory / experiment / "run.json"
        path.write_text(json.dumps(json.loads(path.read_text(encoding="utf-8")) | values), encoding="utf-8")

    def test_a_run_that_is_not_complete_shows_its_reason_and_no_results(self):
        sample.write_all(self.directory)
        self.change_run("judges", status="failed", reason="out of memory")
        (self.directory / "effects_cost" / "run.json").unlink()
        self.draw("judges_agreement")
        with mock.patch.object(report, "write_pdf"):
            text = self.html()
        self.assertIn("This report is incomplete. No result is shown of <code>judges</code> (failed: out of memory), "
                      "<code>effects_cost</code> (no run.json, the run did not come to its end)", text)
        count = len(sections.SECTIONS) - 2
        holds = count + sum(len(ids) for name, ids in sample.CLAIMED.items() if name != "effects_cost")
        self.assertIn(f"{holds} of {holds + count} verdicts hold", text)
        for shown in ("could be compared", "Agreement of the judges", "judges/agreement"):
            self.assertNotIn(shown, text)
        self.assertNotIn("<svg", text)

    def test_a_figure_older_than_its_run_is_not_shown(self):
        sample.write_all(self.directory)
        self.draw("judges_agreement")
        for path in self.directory.glob("figures/*"):
            os.utime(path, (0, 0))
        with mock.patch.object(report, "write_pdf"):
            self.assertNotIn("<svg", self.html())

    def test_files_are_told_by_their_hashes(self):
        sample.write_all(self.directory)
        with mock.patch.object(report, "write_pdf"):
            text = self.html()
        for path in self.directory.glob("*/*.csv"):
            self.assertIn(hashlib.sha256(path.read_bytes()).hexdigest(), text)
        self.assertIn("2026-01-02T03:04:05Z", text)
        self.assertIn("0123456789abcdef; <code>CITATION.cff</code>", text)

    def test_different_programs_are_named(self):
        sample.write_all(self.directory)
        self.change_run("judges", commit="fedcba")
        with mock.patch.object(report, "write_pdf"):
            self.assertIn("stem from different programs", self.html())

    def test_counts_of_verdicts_must_agree(self):
        sample.write_all(self.directory)
        self.change_run("judges", verdicts={"holds": 2, "fails": 0})
        with self.assertRaisesRegex(InputError, "judges/run.json: key 'verdicts': got holds = 2; allowed: 1"):
            self.html()
        self.change_run("judges", verdicts={"holds": 1, "fails": 0})
        with self.assertRaisesRegex(InputError, "judges/run.json: key 'verdicts': got fails = 0; allowed: 1"):
            self.html()

    def test_special_characters_everywhere(self):
        sample.write_all(self.directory)
        path = self.directory / "judges" / "agreement.csv"
        nasty = "*[x]$ % & # _ ^ ~ { } < > | ` [@key] é ☃ \\end"
        path.write_text(path.read_text(encoding="utf-8").replace("pendulum", nasty), encoding="utf-8")
        if shutil.which("latexmk"):
            self.html()
            self.assertFalse((self.directory / "report.log").exists())

    def test_the_report_is_a_folder(self):
        sample.write_all(self.directory)
        (self.directory / "report.html").mkdir()
        done = subprocess.run([sys.executable, report.HERE / "report.py", self.directory], capture_output=True, text=True,
                              check=False)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
        self.assertIn("report.html: cannot be read or written", done.stderr)
        self.assertEqual([path.name for path in self.directory.glob(".*")], [])

    def test_nothing_but_failures(self):
        sample.write_all(self.directory)
        for path in self.directory.glob("*/*.csv"):
            if path.stem not in ("verdicts", "mms"):
                path.write_text(path.read_text(encoding="utf-8").replace(",ok,", ",diverged,"), encoding="utf-8")
        with mock.patch.object(report, "write_pdf"):
            self.assertIn("In no case is <code>plain</code> ok", self.html())

    def test_it_prints_its_answers(self):
        sample.write_all(self.directory)
        with mock.patch.object(report, "write_pdf"), mock.patch("sys.stdout", io.StringIO()) as said:
            report.main(self.directory)
        lines = said.getvalue().splitlines()[-3:]
        self.assertEqual([line.split("?")[0] for line in lines], [
            "What does accuracy cost in time", "Do hard cases stay numerically stable",
            "Does a scene pay only for the effects it calls for"])
        self.assertNotRegex(said.getvalue(), "[`#]")

    def test_a_long_table_is_folded_and_not_in_the_pdf(self):
        sample.write_all(self.directory)
        body = report.compose(Results(self.directory))
        tables = {table.caption: table for section in body.sections for table in section.tables}
        self.assertTrue(all(table.detail for caption, table in tables.items() if caption.endswith(" verdicts.")))
        for section in body.sections:
            for table in section.tables if section.name in sections.SECTIONS else ():
                self.assertEqual(table.detail, len(table.rows) > report.LONGEST, table.caption)
        with mock.patch.object(report, "write_pdf"):
            self.assertEqual(self.html().count("<details><summary>"), sum(table.detail for section in body.sections for table in section.tables))

    def test_animations_are_part_of_the_page_and_missing_ones_are_told(self):
        sample.write_all(self.directory)
        for scene in ("stack", "dominoes", "of an earlier run"):
            (self.directory / "contact_scenes" / scene).mkdir()
            (self.directory / "contact_scenes" / scene / "simulation.pvd").touch()
        (self.directory / "contact_scenes" / "stack" / "animation.webp").write_bytes(b"RIFF")
        with mock.patch.object(report, "write_pdf"):
            text = self.html()
        self.assertEqual(text.count('src="data:image/webp;base64,UklGRg=="'), 1)
        self.assertIn("Not rendered, which needs VTK: dominoes.", text)

    def test_unknown_experiment_is_shown(self):
        sample.write(self.directory, "brand_new", "verdicts", VERDICTS, [sample.verdict("n.1", "It <works>", "share", 1.0, 2.0)])
        sample.write_run(self.directory, "brand_new", holds=1)
        with mock.patch.object(report, "write_pdf"):
            text = self.html()
        self.assertIn("Brand new", text)
        self.assertIn("It &lt;works&gt;", text)

    def test_the_guide_tells_step_time_memory_and_margin_of_the_quickest_method(self):
        sample.trajectories(self.directory)
        sample.write_run(self.directory, "trajectories")
        (table,) = choice(Results(self.directory))
        # bdf2 with the longest step has 0.005; direct to 0.01 takes three times as long as ten iterations
        self.assertEqual(table.rows[0][:2], ["`pendulum`", "`incremental gauss_seidel bdf2 x10`, 0.1 s: 0.1 ms, 0.02 MB (x 3.00)"])
        self.assertEqual(table.rows[1][3], "not told")

    def test_runs_as_engines_make_them_are_told_beside_the_quickest(self):
        sample.trajectories(self.directory)
        sample.write_run(self.directory, "trajectories")
        told = practised(Results(self.directory).table("trajectories", "runs"))
        # To 0.01 ten iterations are the quickest method of both scenes; of velocity steps there are none.
        self.assertIn("(`incremental`, a sweep's rows linearised together), reach an error of 0.01 in 2 of 2 scenes that tell it (as the quickest in 2, in 1 times", told)
        self.assertIn("(`frozen`), reach an error of 0.01 in 0 of 2 scenes that tell it,", told)

    def test_failures_are_counted_by_method_without_their_numbers(self):
        sample.write(self.directory, "a", "t", "outer error status reason",
                     [("plain", 1.0, "diverged", f"far by {k}.5e-3") for k in range(3)] + [("plain", 1.0, "ok", ""), ("auto", 1.0, "ok", "")])
        sample.write_run(self.directory, "a")
        self.assertEqual(failures(Results(self.directory), ["a"]), [["`a`, [#a]", "`diverged`", "far by #", "3 of 5", ["`plain` 3 of 4"]]])

    def test_skipped_solves_are_counted(self):
        sample.write(self.directory, "a", "t", "outer error status reason",
                     [("plain", 1.0, "ok", ""), ("plain", float("nan"), "skipped", "too large")])
        sample.write_run(self.directory, "a")
        self.assertEqual(failures(Results(self.directory), ["a"]), [["`a`, [#a]", "`skipped`", "too large", "1 of 2", ["`plain` 1 of 2"]]])

    def test_a_verdict_on_nan_fails(self):
        nan = float("nan")
        sample.write(self.directory, "a", "verdicts", VERDICTS,
                     [("a.b", "code", "It works", "share", nan, nan, nan, 2.0, "fails", ""),
                      ("a.c", "code", "It works", "share", 1.0, 1.0, 1.0, 2.0, "holds", "")])
        sample.write_run(self.directory, "a", holds=1, fails=1)
        section = failed_section(Results(self.directory), ["a"])
        self.assertIn("1 of 2 verdicts hold; 1 fail, 0 miss a goal and 0 are not decided.", section.paragraphs)
        self.assertEqual([row[0] for row in section.tables[1].rows], ["`a.b`"])

    def test_names_with_digits_stay(self):
        self.assertEqual(stripped("node 4 of chain20 fell 1e-3 m in 20 steps"), "node # of chain20 fell # m in # steps")

    def test_failures_of_traces_are_counted_by_solve(self):
        sample.write(self.directory, "inner_convergence", "errors", "scene relaxation sweep wall_s error status reason",
                     [(scene, "jacobi", sweep, 0.0, 1.0, "diverged", "far") for scene in "ab" for sweep in range(9)])
        sample.write_run(self.directory, "inner_convergence")
        self.assertEqual([row[3] for row in failures(Results(self.directory), ["inner_convergence"])], ["2 of 2"])

    def test_a_failed_verdict_has_a_cause(self):
        sample.write(self.directory, "a", "t", "scene error status reason",
                     [("ball", 1.0, "diverged", "far by 3"), ("ball", 1.0, "ok", ""), ("rod", 1.0, "ok", ""), ("box", 1.0, "diverged", "late")])
        sample.write_run(self.directory, "a")
        verdict = {"experiment": "a", "id": "a.b", "quantity": "overlap", "measured": 3.0, "measured_low": 3.0, "measured_high": 3.0, "bound": 2.0,
                   "verdict": "fails"}
        for change, told in (
                ({}, "The number is 1.5 times its bound."),
                ({"quantity": "overlap (ball)"}, "The number is 1.5 times its bound; of `ball` 1 of 2 rows are not ok, most often: diverged: far by 3."),
                ({"quantity": "overlap (rod)"}, "The number is 1.5 times its bound; no row of `rod` is missed.")):
            self.assertEqual(cause(Results(self.directory), verdict | change), told)

    def test_other_work_is_blamed_only_where_a_repeat_meets_the_bound(self):
        verdict = {"experiment": "a", "id": "effects.idle.free", "measured": 3.0, "bound": 2.0, "verdict": "missed"}
        for low, blamed in ((2.5, False), (1.5, True)):
            told = cause(Results(self.directory), verdict | {"measured_low": low, "measured_high": 4.0})
            self.assertIn("A measured time, 1.5 times", told)
            self.assertEqual("Other work" in told, blamed)

    def told(self, *verdicts):
        """The section of failures of an experiment with these verdicts: its sentences and its tables by their captions."""
        sample.write(self.directory, "a", "verdicts", VERDICTS, verdicts)
        sample.write_run(self.directory, "a")
        self.change_run("a", verdicts={word: [row[8] for row in verdicts].count(word) for word in reading.VERDICTS})
        section = failed_section(Results(self.directory), ["a"])
        return section.paragraphs[0], {table.caption: table.rows for table in section.tables}

    def test_what_does_not_hold_is_counted_by_class_and_told_by_kind(self):
        said, tables = self.told(sample.verdict("a.1", "x", "y", 1.0, 2.0), sample.verdict("a.2", "x", "y", 3.0, 2.0, "theory"),
                                 sample.verdict("a.3", "x", "y", 3.0, 2.0, "goal"), sample.verdict("a.4", "x", "y", 2.0, 2.0, spread=1.0))
        self.assertEqual(said, "1 of 4 verdicts hold; 1 fail, 1 miss a goal and 1 are not decided.")
        self.assertEqual([row[:1] + row[2:] for row in tables["Verdicts by what they rest on."]],
                         [["code", "2", "1", "0", "0", "1"], ["theory", "1", "0", "1", "0", "0"], ["goal", "1", "0", "0", "1", "0"]])
        self.assertEqual([row[0] for row in tables["Verdicts that fail."]], ["`a.2`"])
        self.assertEqual([row[0] for row in tables["Goals that are missed."]], ["`a.3`"])
        self.assertEqual([row[0] for caption, rows in tables.items() if "not decided" in caption for row in rows], ["`a.4`"])

    def test_skipped_solves_are_counted(self):
        sample.write(self.directory, "a", "t", "outer error status reason",
                     [("plain", 1.0, "skipped", "too large"), ("plain", 1.0, "skipped", "too large"), ("plain", 1.0, "ok", "")])
        sample.write_run(self.directory, "a")
        self.assertEqual(failures(Results(self.directory), ["a"]), [["`a`, [#a]", "`skipped`", "too large", "2 of 3", ["`plain` 2 of 3"]]])

    def test_no_folder(self):
        with self.assertRaises(InputError):
            report.main(self.directory / "absent")


if __name__ == "__main__":
    unittest.main()
