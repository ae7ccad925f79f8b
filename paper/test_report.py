"""Tests of the report:  python3 -m unittest discover -s paper"""

import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import report
import sections
from content import Section, Table, Figure, compared, counted, joined, listed, number, places, share, span
from failed import cause, failed_section, failures, stripped
from marks import BIBLIOGRAPHY, LATEX, plain, references, to_html, to_latex
from reading import InputError
from results import Results
from tables import VERDICTS

import reading
import sample
from common import FIGURES
import make  # noqa: F401  (registers the figures)

PAPER = report.HERE
TEXTS = [path.read_text(encoding="utf-8") for path in PAPER.glob("**/*.py") if not path.name.startswith("test_") and path.name != "marks.py"]
PIXEL = bytes.fromhex("89504e470d0a1a0a0000000d4948445200000001000000010802000000907753de0000000c49444154789c63f8ffff3f0005fe02fe"
                      "0def46b80000000049454e44ae426082")  # a PNG


class Texts(unittest.TestCase):
    def test_latex_escapes_everything_special(self):
        self.assertEqual(to_latex("50 % of a_b & c #1 {x} $y$ ~^\\"),
                         r"50 \% of a\_b \& c \#1 \{x\} \$y\$ \textasciitilde{}\textasciicircum{}\textbackslash{}")

    def test_marks(self):
        key = "liu2017quasi"
        self.assertEqual(to_latex(f"`a_b` [@{key}]"), rf"\texttt{{a\_\allowbreak{{}}b}} \citep{{{key}}}")
        self.assertEqual(to_html(f"`a<b` [@{key}]", {key: ""}), f'<code>a&lt;b</code> [<a href="#{key}">1</a>]')

    def test_tables_are_linked(self):
        self.assertEqual(to_html("`energy/map.csv` `a.csv`", {}),
                         '<a href="energy/map.csv"><code>energy/map.csv</code></a> <code>a.csv</code>')

    def test_references_are_to_what_there_is(self):
        known = places([Section("", name="energy", figures=[Figure("not_drawn", ""), Figure("a_b", "", drawn=True)])])
        self.assertEqual(known, {"energy": "section 1", "a_b": "figure 1"})
        self.assertEqual(to_html("[#energy] [#a_b] [#none]", {}, known),
                         '<a href="#energy">section 1</a> <a href="#a_b">figure 1</a> [#none]')
        self.assertEqual(to_latex("[#a_b] [#none]", known), r"\hyperref[a_b]{figure~1} {[}\#none]")
        self.assertEqual(plain("`x` in [#energy] [#none]", known), "x in section 1 [#none]")

    def test_latex_knows_every_character_of_the_texts(self):
        self.assertEqual({c for c in "".join(TEXTS) if not c.isascii()} - set(LATEX), set())

    def test_a_citation_of_nothing_is_text(self):
        self.assertEqual(to_latex("[@key]\n*"), "{[}@key] {*}")
        self.assertEqual(to_html("[@key]", {}), "[@key]")

    def test_html_escapes(self):
        self.assertEqual(to_html("<script>&", {}), "&lt;script&gt;&amp;")

    def test_every_citation_is_in_the_bibliography(self):
        known = references(BIBLIOGRAPHY)
        cited = re.findall(r"\[@(\w+)\]", "".join(TEXTS))
        self.assertTrue(cited)
        self.assertEqual(set(cited) - set(known) - {"key"}, set())
        self.assertEqual(len(known), BIBLIOGRAPHY.count("\n@") + 1)

    def test_numbers(self):
        self.assertEqual([number(v) for v in (1e-6, 0.25, float("nan"), float("-inf"))],
                         ["1e-6", "0.25", "not a number", "-inf"])
        self.assertEqual([span([1, 2, float("nan")]), span([3, 3]), span([])], ["1 to 2", "3", "no finite number"])
        self.assertEqual([counted(1, "case"), counted(2, "case")], ["1 case", "2 cases"])
        self.assertEqual([listed([]), listed(["a"]), listed(["a", "b", "c"])], ["none", "`a`", "`a`, `b` and `c`"])
        self.assertEqual([joined([]), joined("a"), joined("abc"), share(1, 2)], ["", "a", "a, b and c", "1 of 2"])

    def test_numbers_that_differ_look_different(self):
        self.assertEqual(compared(1.10185, 1.1), ("1.102", "1.1"))
        self.assertEqual(compared(1.0, 1.0), ("1", "1"))
        self.assertEqual(compared(float("nan"), 1.0), ("not a number", "1"))

    def test_wide_tables_wrap(self):
        self.assertEqual(report.column_widths(Table("", ["a", "b"], [["1", "2"]])), "ll")
        self.assertIn("p{", report.column_widths(Table("", ["a", "b"], [["x" * 200, "2"]])))


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
        for kind in ("png", "svg", "pdf"):
            (self.directory / "figures" / f"{name}.{kind}").write_bytes(PIXEL)

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
        self.assertNotIn("<img", text)

    def test_a_figure_older_than_its_run_is_not_shown(self):
        sample.write_all(self.directory)
        self.draw("judges_agreement")
        for path in self.directory.glob("figures/*"):
            os.utime(path, (0, 0))
        with mock.patch.object(report, "write_pdf"):
            self.assertNotIn("<img", self.html())

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
            self.assertEqual(self.html().count("<details>"), sum(table.detail for section in body.sections for table in section.tables))

    def test_unknown_experiment_is_shown(self):
        sample.write(self.directory, "brand_new", "verdicts", VERDICTS, [sample.verdict("n.1", "It <works>", "share", 1.0, 2.0)])
        sample.write_run(self.directory, "brand_new", holds=1)
        with mock.patch.object(report, "write_pdf"):
            text = self.html()
        self.assertIn("Brand new", text)
        self.assertIn("It &lt;works&gt;", text)

    def test_failures_are_counted_by_method_without_their_numbers(self):
        sample.write(self.directory, "a", "t", "outer error status reason",
                     [("plain", 1.0, "diverged", f"far by {k}.5e-3") for k in range(3)] + [("plain", 1.0, "ok", ""), ("auto", 1.0, "ok", "")])
        sample.write_run(self.directory, "a")
        self.assertEqual(failures(Results(self.directory), ["a"]), [["`a`, [#a]", "`diverged`", "far by #", "3 of 5", ["`plain` 3 of 4"]]])

    def test_names_with_digits_stay(self):
        self.assertEqual(stripped("node 4 of chain20 fell 1e-3 m in 20 steps"), "node # of chain20 fell # m in # steps")

    def test_failures_of_traces_are_counted_by_solve(self):
        sample.write(self.directory, "inner_convergence", "errors", "scene relaxation sweep wall_s error status reason",
                     [(scene, "jacobi", sweep, 0.0, 1.0, "diverged", "far") for scene in "ab" for sweep in range(9)])
        sample.write_run(self.directory, "inner_convergence")
        self.assertEqual([row[3] for row in failures(Results(self.directory), ["inner_convergence"])], ["2 of 2"])

    def test_a_failed_verdict_has_a_cause(self):
        sample.write(self.directory, "a", "t", "error status reason", [(1.0, "diverged", "far by 3")] * 2)
        sample.write_run(self.directory, "a")
        verdict = {"experiment": "a", "id": "a.b", "measured": 3.0, "bound": 2.0, "verdict": "fails"}
        self.assertEqual(cause(Results(self.directory), verdict),
                         "The number is 1.5 times its bound; most rows that are not ok say: diverged: far by #.")
        self.assertIn("A measured time, 1.5 times", cause(Results(self.directory), verdict | {"id": "effects.empty.free"}))

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
        self.assertTrue(said.startswith("1 of 4 verdicts hold."))
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
