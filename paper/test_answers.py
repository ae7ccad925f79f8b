"""Tests of the answers on the first page: each says what the data say, whichever way."""

import re
import unittest

import numpy as np

import answers
import claims
import test_claims
from failed import all_verdicts
from results import Results
from sections.cost import LEVELS


class Answers(unittest.TestCase):
    setUpClass = classmethod(lambda cls: test_claims.Claims.setUpClass.__func__(cls))

    def told(self, changes):
        return [answer.sentence for answer in answers.answers(test_claims.Changed(self.directory, changes))]

    def test_each_has_a_sentence_a_number_and_a_figure(self):
        for answer in answers.answers(Results(self.directory)):
            self.assertTrue(answer.number and answer.unit and answer.sentence and answer.figure.name, answer)
            self.assertNotIn("nan", answer.sentence)

    def test_each_says_what_is_missing(self):
        told = self.told({name: lambda frame: None for name in ("points", "gates", "verdicts")})
        for text, name in zip(told, ("work_precision/points", "point_hard_cases/gates", "effects_cost/verdicts")):
            self.assertIn(f"`{name}.csv`", text)
            self.assertIn("missing", text)

    def test_they_follow_the_data(self):
        before, after = self.told({}), self.told({
            "points": lambda frame: frame.assign(status="not_converged"),
            "gates": lambda frame: frame.assign(holds=0.0), "verdicts": test_claims.FAILS["verdicts"]})
        for old, new in zip(before, after):
            self.assertNotEqual(old, new)
        self.assertIn("In none of", after[0])
        self.assertIn("0 of", after[1])
        self.assertIn("fails", after[2])

    def test_a_case_passes_by_all_of_its_gates_that_were_asked(self):
        def cases_told(change):
            return int(re.search(r"(\d+) of \d+ hard cases", self.told({"gates": change})[1])[1])

        def marked(first, rest):
            def change(frame):
                place = frame.groupby(["scene", "relaxation"]).cumcount()
                return frame.assign(status=np.where(place == 0, first[0], rest[0]), holds=np.where(place == 0, first[1], rest[1]))
            return change
        every = cases_told(marked(("ok", 1.0), ("ok", 1.0)))
        self.assertGreater(every, 0)
        self.assertEqual(cases_told(marked(("ok", 0.0), ("ok", 1.0))), 0)
        self.assertEqual(cases_told(marked(("skipped", 0.0), ("ok", 1.0))), every)

    def test_cases_that_miss_steps_are_counted(self):
        def missed(status):
            told = self.told({"gates": lambda frame: frame.assign(status=status)})[1]
            return int(re.search(r"(\d+) of them miss their tolerance", told)[1])
        self.assertEqual(missed("ok"), 0)
        self.assertGreater(missed("not_converged"), 0)

    def test_a_case_without_a_solved_step_does_not_pass(self):
        def told(reason):
            def change(frame):
                first = frame["scene"] == frame["scene"].iloc[0]
                return frame.assign(status="ok", holds=1.0, reason=np.where(first, reason, ""))
            return self.told({"gates": change})[1]
        passed = [int(re.search(r"(\d+) of \d+ hard cases", told(reason))[1]) for reason in ("", "no judged step has status ok")]
        self.assertLess(passed[1], passed[0])

    def test_a_summary_counts_claims_and_verdicts(self):
        results = Results(self.directory)
        told = answers.summary(claims.findings(results), all_verdicts(results, results.experiments()))
        self.assertIn("Of 32 claims", told)
        self.assertRegex(told, r"of \d+ verdicts \d+ hold, \d+ fail")

    def test_accuracy_costs_the_time_of_the_tightest_over_the_loosest(self):
        def points(frame):
            rows = frame[~frame["outer"].isin(["judge", "rival"])].iloc[[0, 0]]
            return rows.assign(outer="plain", status="ok", wall_s=[1.0, 7.0], error=[0.9 * LEVELS[0], 0.9 * LEVELS[-1]])
        self.assertIn("takes 7 times as long", self.told({"points": points})[0])


if __name__ == "__main__":
    unittest.main()
