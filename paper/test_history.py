"""Tests of what changed between runs."""

import json
import tempfile
import unittest
from pathlib import Path

import history
from results import Results


def line(commit, measured=0.1, verdict="holds", **changes):
    entry = {"status": "complete", "run_s": 2.0, "work": {"sweeps": 100, "row_updates": 1000},
             "verdicts": [{"id": "a.b", "class": "code", "measured": measured, "bound": 1.0, "verdict": verdict},
                          {"id": "effects.linear.x", "class": "theory", "measured": measured, "bound": 1.0, "verdict": "holds"}]}
    entry |= changes.pop("entry", {})
    return {"date": "2026-01-01T00:00:00Z", "commit": commit, "dirty": False, "changes": "", "tier": "quick", "processor": "p",
            "threads": 1, "experiments": {"a": entry}} | changes


class History(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "history.jsonl"

    def section(self, *lines):
        self.path.write_text("".join(f"{each if isinstance(each, str) else json.dumps(each)}\n" for each in lines), encoding="utf-8")
        return history.history_section(Results(self.path.parent), ["a"])

    def table(self, section, caption):
        return next(table.rows for table in section.tables if table.caption.startswith(caption))

    def test_nothing_to_compare_with(self):
        for lines in ((), (line("one"),), (line("one"), line("one")), (line("one", tier="full"), line("two")),
                      (line("one", processor="q"), line("two")), (line("one", threads=2), line("two")),
                      (line("one", entry={"status": "failed"}), line("two"))):
            section = self.section(*lines)
            self.assertEqual(len(section.tables), 0, lines)
            self.assertIn("nothing to compare with", section.paragraphs[-1])

    def test_a_verdict_that_turns_a_number_that_moves_and_work(self):
        section = self.section(line("one"), line("two", 2.0, "fails", entry={}), line("two", 2.0, "fails"))
        self.assertIn("`two` (2026-01-01) beside `one` (2026-01-01): 1 verdict turned", section.paragraphs[0])
        self.assertIn("1 grew and 0 shrank", section.paragraphs[0])
        self.assertEqual(self.table(section, "Verdicts"), [["`a.b`", "holds", "fails", "[#a]"]])
        self.assertEqual(self.table(section, "Numbers"), [["`a.b`", "0.1", "2", "20", "[#a]"]])  # the time is not among them
        self.assertEqual(self.table(section, "Work"), [["[#a]", "1", "1", "1", "2", "1"]])

    def test_work_and_time_ratios(self):
        section = self.section(line("one"), line("two", entry={"run_s": 3.0, "work": {"sweeps": 50, "row_updates": 1000}}))
        self.assertEqual(self.table(section, "Work"), [["[#a]", "1", "0.5", "1", "3", "1.5"]])
        self.assertEqual(len(section.tables), 1)

    def test_uncommitted_changes_are_another_program(self):
        self.assertIn("with changes", self.section(line("one"), line("one", 0.5, dirty=True, changes="x")).paragraphs[0])

    def test_a_verdict_that_comes_or_goes_is_told(self):
        gone = self.section(line("one"), line("two", entry={"verdicts": []}))
        self.assertEqual([row[1:3] for row in self.table(gone, "Verdicts")], [["holds", "not there"]] * 2)

    def test_what_is_no_number_is_told(self):
        section = self.section(line("one"), line("two", None, "fails"))
        self.assertEqual(self.table(section, "Numbers"), [["`a.b`", "0.1", "not a number", "not a number", "[#a]"]])
        self.assertIn("1 grew", section.paragraphs[0])

    def test_a_number_that_was_zero(self):
        section = self.section(line("one", 0.0), line("two", 0.5))
        self.assertEqual(self.table(section, "Numbers")[0][3], "inf")

    def test_lines_that_cannot_be_read_are_told_and_left_alone(self):
        for broken in ("{", "[]", "3", '{"date": 1}', json.dumps(line("x", experiments={"a": 3})), json.dumps(line("x"))[:-40], "\x00",
                       json.dumps(line("x", entry={"verdicts": [{"id": "a"}]}))):
            section = self.section(line("one"), broken, line("two", 0.5))
            self.assertIn("1 line cannot be read and is left alone: 2", section.paragraphs[0])
            self.assertEqual(len(self.table(section, "Numbers")), 1)


if __name__ == "__main__":
    unittest.main()
