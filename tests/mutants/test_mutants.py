"""Tests of the planted faults:  python3 -m unittest discover -s tests/mutants"""

import re
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import mutants
from mutants import ROOT, NoAnswer, apply, commands_of, examine, read_faults

CASE = re.compile(r'TEST_CASE\(\s*((?:"(?:[^"\\]|\\.)*"\s*)+)')


class List(unittest.TestCase):
    def test_each_fault_changes_one_place(self):
        for fault in read_faults():
            with self.subTest(fault.name):
                text = (ROOT / fault.file).read_text(encoding="utf-8")
                self.assertNotEqual(apply(fault, text), text)

    def test_names_differ(self):
        names = [fault.name for fault in read_faults()]
        self.assertEqual(len(set(names)), len(names))

    def test_every_check_exists(self):
        known = set()
        for source in ROOT.glob("tests/*/**/*.cpp"):
            folder = source.relative_to(ROOT / "tests").parts[0]
            for name in CASE.findall(source.read_text(encoding="utf-8")):
                known.add(f"{folder}: " + re.sub(r'"\s*"', "", name.strip())[1:-1])
        for folder in ("plots", "paper"):
            for source in (ROOT / folder).glob("test_*.py"):
                known |= {f"{folder}/{source.name} {name}" for name in re.findall(r"def (test_\w+)", source.read_text(encoding="utf-8"))}
        for fault in read_faults():
            if not fault.check.startswith("verify "):
                with self.subTest(fault.name):
                    self.assertIn(fault.check, known)


class Tool(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name)
        (self.tree / "sum.cpp").write_text("a + b", encoding="utf-8")
        self.addCleanup(mock.patch.stopall)
        mock.patch.object(mutants, "TREE", self.tree).start()

    def fault(self, old="a + b", **more):
        return mutants.Fault("sum", "sum.cpp", old, "a - b", "it subtracts", "solver: sums", **more)

    def examined(self, fault, answers):
        """The result where `answers` has what each check says with the fault; all pass without it."""
        def passes(check, longest_s=0):
            answer = answers.get(check, True) if (self.tree / "sum.cpp").read_text(encoding="utf-8") == "a - b" else answers.get("before", True)
            if isinstance(answer, Exception):
                raise answer
            return answer
        with mock.patch.object(mutants, "passes", passes):
            result = examine(fault, "tree", mutants.Limits())
        self.assertEqual((self.tree / "sum.cpp").read_text(encoding="utf-8"), "a + b")
        return result.result, result.check

    def test_a_fault_is_caught_by_the_first_check_that_fails(self):
        self.assertEqual(self.examined(self.fault(), {"solver: sums": False}), ("caught", "solver: sums"))
        self.assertEqual(self.examined(self.fault(), {"ctest": False}), ("caught", "ctest"))
        self.assertEqual(self.examined(self.fault(), {}), ("survived", ""))

    def test_what_cannot_be_judged_is_never_caught(self):
        self.assertEqual(self.examined(self.fault("a * b"), {"solver: sums": False}), ("error", "its text occurs 0 times in sum.cpp"))
        self.assertEqual(self.examined(self.fault(), {"solver: sums": NoAnswer("does not compile: x")}), ("error", "does not compile: x"))
        self.assertEqual(self.examined(self.fault(), {"before": False, "solver: sums": False}), ("error", "fails without the fault: solver: sums"))
        self.assertEqual(self.examined(self.fault(), {"solver: sums": "too long"})[0], "error")
        self.assertEqual(self.examined(self.fault(hangs=True), {"solver: sums": "too long"}), ("caught", "solver: sums (does not end)"))

    def test_results_survive(self):
        path = self.tree / "results.csv"
        results = {"sum": mutants.Result("sum", "d", "t", "caught", "solver: sums, of all", "1")}
        mutants.write_results(path, results)
        self.assertEqual(mutants.read_results(path), results)

    def test_below_95_per_cent_is_a_failure(self):
        def exit_code(*found):
            faults = [mutants.Fault(str(i), "f", "o", "n", "w", "c") for i, _ in enumerate(found)]
            results = {str(i): mutants.Result(str(i), "", "t", result, "", "") for i, result in enumerate(found)}
            with mock.patch("sys.stdout"):
                return mutants.print_table(faults, results, "t")
        self.assertEqual(exit_code(*["caught"] * 19, "survived"), 0)
        self.assertEqual(exit_code(*["caught"] * 18, "survived"), 1)
        self.assertEqual(exit_code("caught", "error"), 2)

    def test_a_name_is_a_name_to_catch(self):
        self.assertEqual(commands_of("solver: a, b [c]")[0], "test_solver")
        self.assertEqual(commands_of("solver: a, b [c]")[1][-1], "a\\, b \\[c\\]")


if __name__ == "__main__":
    unittest.main()
