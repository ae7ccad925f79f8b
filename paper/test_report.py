"""Tests of the report:  python3 -m unittest discover -s paper"""

import shutil
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import report
import sections
from content import Results, Table, counted, failures, listed, number, span  # makes plots/ importable
from reading import InputError

import sample


class Texts(unittest.TestCase):
    def test_latex_escapes_everything_special(self):
        self.assertEqual(report.to_latex("50 % of a_b & c #1 {x} $y$ ~^\\"),
                         r"50 \% of a\_b \& c \#1 \{x\} \$y\$ \textasciitilde{}\textasciicircum{}\textbackslash{}")

    def test_marks(self):
        self.assertEqual(report.to_latex("`a_b` [@key]"), r"\texttt{a\_\allowbreak{}b} \citep{key}")
        self.assertEqual(report.to_html("`a<b` [@key]", {"key": ""}), '<code>a&lt;b</code> [<a href="#key">1</a>]')

    def test_html_escapes(self):
        self.assertEqual(report.to_html("<script>&", {}), "&lt;script&gt;&amp;")

    def test_every_citation_is_in_the_bibliography(self):
        known = report.references((report.HERE / "refs.bib").read_text(encoding="utf-8"))
        cited = report.re.findall(r"\[@(\w+)\]", (report.HERE / "sections.py").read_text(encoding="utf-8"))
        self.assertEqual(set(cited) - set(known), set())
        self.assertEqual(len(known), (report.HERE / "refs.bib").read_text(encoding="utf-8").count("\n@") + 1)

    def test_numbers(self):
        self.assertEqual([number(v) for v in (1e-6, 0.25, float("nan"), float("-inf"))],
                         ["1e-6", "0.25", "not a number", "-inf"])
        self.assertEqual([span([1, 2, float("nan")]), span([3, 3]), span([])], ["1 to 2", "3", "no finite number"])
        self.assertEqual([counted(1, "case"), counted(2, "case")], ["1 case", "2 cases"])
        self.assertEqual([listed([]), listed(["a"]), listed(["a", "b", "c"])], ["none", "`a`", "`a`, `b` and `c`"])

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

    def test_all_experiments(self):
        sample.write_all(self.directory)
        with mock.patch.object(report, "write_pdf"):
            text = self.html()
        self.assertNotIn(sections.NOT_RUN, text)
        self.assertIn("7 of 14 verdicts hold", text)
        self.assertIn("theory predicts contraction in 4; 4 of these converge", text)
        self.assertNotIn("http://", text)

    @unittest.skipUnless(shutil.which("latexmk"), "latexmk is not installed")
    def test_pdf(self):
        sample.write_all(self.directory)
        self.html()
        self.assertTrue((self.directory / "report.pdf").read_bytes().startswith(b"%PDF"))

    def test_nothing_run(self):
        with mock.patch.object(report, "write_pdf"):
            self.assertEqual(self.html().count(sections.NOT_RUN), len(sections.SECTIONS))

    def test_without_latex_html_is_still_written(self):
        with mock.patch.object(report.shutil, "which", return_value=None):
            self.assertIn("Not run", self.html())
        self.assertFalse((self.directory / "report.pdf").exists())

    def test_nothing_but_failures(self):
        sample.write_all(self.directory)
        for path in self.directory.glob("*/*.csv"):
            if path.stem not in ("verdicts", "mms"):
                path.write_text(path.read_text(encoding="utf-8").replace(",ok,", ",diverged,"), encoding="utf-8")
        with mock.patch.object(report, "write_pdf"):
            self.assertIn("In no case is <code>plain</code> ok", self.html())

    def test_unknown_experiment_is_shown(self):
        sample.write(self.directory, "brand_new", "verdicts", "id statement quantity measured bound verdict",
                     [("n.1", "It <works>", "share", 1.0, 2.0, "holds")])
        with mock.patch.object(report, "write_pdf"):
            text = self.html()
        self.assertIn("Brand new", text)
        self.assertIn("It &lt;works&gt;", text)

    def test_failures_are_counted(self):
        sample.write(self.directory, "a", "t", "error status reason", [(1.0, "diverged", "far")] * 3 + [(1.0, "ok", "")])
        self.assertEqual(failures(Results(self.directory), ["a"]), [["`a/t`", "`diverged`", "far", "3"]])

    def test_no_folder(self):
        with self.assertRaises(InputError):
            report.main(self.directory / "absent")


if __name__ == "__main__":
    unittest.main()
