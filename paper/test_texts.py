"""Tests of the texts, their marks, the bibliography and the numbers."""

import re
import unittest

import report
from content import Section, Table, Figure, compared, counted, joined, listed, number, places, share, span
from marks import BIBLIOGRAPHY, LATEX, plain, references, to_html, to_latex

TEXTS = [path.read_text(encoding="utf-8") for path in report.HERE.glob("**/*.py")
         if not path.name.startswith("test_") and path.name != "marks.py"]


class Texts(unittest.TestCase):
    def test_latex_escapes_everything_special(self):
        self.assertEqual(to_latex("50 % of a_b & c #1 {x} $y$ ~^\\"),
                         r"50 \% of a\_b \& c \#1 \{x\} \$y\$ \textasciitilde{}\textasciicircum{}\textbackslash{}")

    def test_marks(self):
        key = "liu2017quasi"
        self.assertEqual(to_latex(f"`a_b` [@{key}]"), rf"\texttt{{a\_\allowbreak{{}}b}} \cite{{{key}}}")
        self.assertEqual(to_html(f"`a<b` [@{key}]", {key: ""}), f'<code>a&lt;b</code> [<a href="#{key}">1</a>]')

    def test_tables_are_linked(self):
        self.assertEqual(to_html("`energy/map.csv` `a.csv`", {}, files={"energy/map.csv"}),
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
        for entry in known.values():
            self.assertNotRegex(entry.text, r"[\\{}]")
            self.assertEqual({c for c in entry.text if not c.isascii()} - set(LATEX), set())
            self.assertRegex(entry.link, r"^(https://\S+)?$")

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


if __name__ == "__main__":
    unittest.main()
