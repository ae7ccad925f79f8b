"""Tests of the claims: each says what the data say, whichever way."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas as pd

import claims
from claims.claim import REFUTED, SUPPORTED, UNTESTED, find, judge, worst
from claims.contact import late
from results import Results

import sample
from reading import SETTINGS

FAILS = {"verdicts": lambda frame: frame.assign(measured=1e9, verdict="fails")}
WRONG = {"answers": lambda frame: frame.assign(error=1e9)}


def where(column, value, **columns):
    """A change of the rows where a column has a value."""
    def change(frame):
        frame = frame.copy()
        rows = frame[column] == value
        for name, content in columns.items():
            frame.loc[rows, name] = content(frame[rows]) if callable(content) else content
        return frame
    return change


# What refutes each claim: how each table that it reads is changed.
CONTRARY = {
    1: {"map": lambda frame: frame.assign(behaviour="oscillating")},
    2: FAILS,
    3: {"largest_steps": where("family", "position", largest_step_s=1e-9)},
    4: {name: where("family", "position", error=1e9) for name in ("equal_work", "contact")},
    5: {"chain20": where("outer", "plain", iterations=np.nan)},
    6: {"errors": where("outer", "incremental", error=1e-16)},
    7: {"stretches": lambda frame: frame.assign(stretch_m=0.0)},
    8: {"series": where("integrator", "newmark", status="diverged")},
    9: FAILS, 10: FAILS, 11: FAILS,
    12: WRONG, 13: WRONG, 14: FAILS | {"solves": lambda frame: frame.assign(error_m_per_s=1.0)},
    15: {"gaps": lambda frame: frame.assign(error=1.0)}, 16: WRONG, 17: WRONG, 18: WRONG,
    19: {"motions": where("variant", "within", measured=9.0)},
    20: {"final": lambda frame: frame.assign(error=1.0)}, 21: FAILS, 22: FAILS, 23: FAILS,
    24: {"beam": where("model", "springs", error_beam=0.0)},
    25: {"sweeps": lambda frame: frame.assign(status="not_converged")},
    26: {"errors": lambda frame: where("relaxation", "nesterov_jacobi", error=1.0)(where("relaxation", "jacobi", error=0.0)(frame))},
    27: {"sweeps": lambda frame: frame.assign(same_bits=0)}, 28: FAILS, 29: {"bounds": where("relaxation", "fista_restarted", rises=1e9)}, 30: FAILS, 31: FAILS, 32: FAILS}

HOLDS = {"verdicts": lambda frame: frame.assign(measured=0.0, verdict="holds")}
RIGHT = {"answers": lambda frame: frame.assign(error=0.0, status="ok", measured=0.0)}
STRAIGHT = {"headings": lambda frame: frame.assign(deceleration_share=1.0, share_error=0.0, heading_error_rad=0.0, status="ok")}

# What supports each claim, as far as it can be: some tests support under a condition at best.
FAVOURABLE = {
    1: {"map": lambda frame: frame.assign(behaviour="converged"), "rates": lambda frame: frame.assign(returns=1, status="ok")},
    2: HOLDS | {"map": where("outer", "plain", measured_rate=lambda frame: frame["step_s"] ** 2),
                "rates": lambda frame: frame.assign(measured_rate=frame["step_s"] ** 2, status="ok")},
    3: {"largest_steps": lambda frame: where("family", "velocity", largest_step_s=1e-9)(frame.assign(missed_steps=0.0))},
    4: {name: lambda frame: where("family", "position", error=1e-12)(frame.assign(status="ok")) for name in ("equal_work", "contact")},
    5: {"chain20": where("outer", "plain", iterations=3.0),
        "contenders": where("outer", "plain", status="ok", missed_steps=0.0, energy_highest=1.0)},
    6: {"errors": lambda frame: frame.assign(error=np.where(frame["outer"] == "incremental", 1.0, 1e-15), status="ok"),
        "residuals": lambda frame: frame.assign(residual_share=np.where(frame["outer"] == "plain", 0.0, 0.1), status="ok")},
    7: {"stretches": lambda frame: frame.assign(status="ok", stretch_m=1 / frame["sweeps"].clip(1), physical_m=0.0, error=0.0)},
    8: {"series": where("alpha", 0.55, energy_j=0.0, status="ok")},
    9: HOLDS | {"series": lambda frame: frame.assign(status="ok")},
    10: HOLDS,
    11: HOLDS | {"momentum": lambda frame: frame.assign(angular_error=0.0)},
    12: RIGHT | {"traces": lambda frame: frame.assign(status="ok", penetration_m=0.0), "solves": lambda frame: frame.assign(status="ok", complementarity_share=1.0)},
    13: RIGHT | STRAIGHT,
    14: HOLDS | {"solves": lambda frame: frame.assign(status="ok", error_m_per_s=0.0)},
    15: {"gaps": lambda frame: frame.assign(error=0.0, gap_m=np.where(frame["friction"] == "cone", 0.01, 0.0))},
    16: RIGHT | STRAIGHT,
    17: RIGHT,
    19: {"motions": lambda frame: where("variant", "within", measured=lambda rows: rows["expected"])(frame)},
    18: RIGHT | {"thresholds": lambda frame: frame.assign(right=1.0)},
    20: {"final": lambda frame: frame.assign(error=1e-8, status="ok")},
    21: HOLDS | {"stretches": lambda frame: frame.assign(status="ok", error=0.0)}, 22: HOLDS,
    23: HOLDS | {"beam": lambda frame: frame.assign(status="ok", error_beam=1 / frame["n"])},
    24: {"beam": lambda frame: where("model", "tet_p1", error_beam=0.0)(frame.assign(status="ok", error_beam=0.5))},
    25: {"sweeps": lambda frame: frame.assign(status="ok", sweeps=5.0),
         "locking": lambda frame: frame.assign(status="ok", error_mesh=1e-9, value=frame["reference_beam"])},
    26: {"errors": where("relaxation", "nesterov_jacobi", error=0.0), "budgets": where("relaxation", "nesterov_jacobi", gap=0.0),
         "bounds": where("relaxation", "fista", exponent=9.0)},
    27: {name: lambda frame: frame.assign(speedup=1.9, same_bits=1) for name in ("sweeps", "steps")},
    29: {"bounds": where("relaxation", "fista_restarted", rises=0.0), "budgets": where("relaxation", "fista_restarted", gap=0.0)},
    28: HOLDS | {"points": lambda frame: frame[frame["outer"] == "plain"].assign(error=0.0, status="ok")},
    30: HOLDS | {"ends": lambda frame: frame[frame["status"] == "ok"]},
    31: HOLDS | {"scenes": lambda frame: frame.assign(steps_ok=frame["steps"])},
    32: HOLDS}
ORDER = (SUPPORTED, SUPPORTED + " under", REFUTED, UNTESTED)
CONDITIONAL = {2, 21, 32}  # which are never supported without a condition
NEVER_DECIDE = {"generated_worlds/agreement", "stack/answers", "contact_hard_cases/gates", "simbenchmark/accuracy"}  # tables that a finding only quotes


class Changed(Results):
    """Results with changed tables, by the name of a table, and then of "experiment/table"."""

    def __init__(self, directory, changes, further=()):
        super().__init__(directory)
        self.changes = [changes, dict(further)]

    def table(self, experiment, table):
        frame = super().table(experiment, table)
        for changes, name in zip(self.changes, (table, f"{experiment}/{table}")):
            frame = changes.get(name, lambda same: same)(frame) if frame is not None else None
        return frame


def without_numbers(frame):
    """Nothing that was measured is a number."""
    measured = [c for c in frame.select_dtypes("number") if c not in SETTINGS - {"sweeps"}
                and c not in ("bound", "alpha", "direction_blend", "stabilisation", "tolerance", "max_outer", "predicted_rate", "value")]
    frame = frame.assign(**{column: np.nan for column in measured})
    frame = frame.assign(behaviour="oscillating") if "behaviour" in frame else frame
    frame = frame.assign(status="diverged") if "steps" in frame and "reason" not in frame else frame  # how steps end is all it says
    return frame.assign(verdict="fails") if "verdict" in frame else frame


# What the sample's data say against the method and its solver.
AGAINST = {
    1: "`plain` converges in 4 of 12 cases of `pendulum` and `chain20`, on `chain20` only for h <= 1/240 s and mass ratios of at most 1.",
    2: "In contact the contraction is not always of order h²: in 2 of 6 cases the radius falls as h to the power 1 (ball rolls on a ball).",
    5: "On the taut chain refreshed directions alone (`plain`) are solved and stable up to 0.45 of the explicit limit of step, frozen ones "
       "are stable up to 0.9; `proximal`, with a bound of the geometric stiffness in the mass matrix, is up to 8.",
    9: "Newmark's rule with alpha = 1/2 fails: on `hard pendulum` it diverges (energy grew by ten times its scale; the energy moves by up "
       "to 5.24e3 of its scale).",
    13: "Under the convex law `cone`, the paper's, a sliding cube lifts by 1 m.",
    15: "Under the convex law `cone`, the paper's, a box that slides steadily hovers by 6.67 mm at the largest step.",
    16: "Friction of the box law is not the same in every direction: it slows a box by up to 1.36 mu g.",
    24: "Against theory, " + "; ".join(
        f"{where} the springs are nearer on 0 of 4 meshes, the FEM constraint on 3 (errors 0.9, 0.401, 0.258, not a number against 0.7, 0.201, "
        "0.0577, 0.0166)" for where in ("in bending", "in the first frequency", "in tension", "in lateral contraction")) + ".",
    25: "The elements lock: at n = 4 cells across, linear tetrahedra bend by 0.825 of beam theory at best and by 0.0516 at nu = 0.4999.",
    28: "Newton's method with CHOLMOD is the quickest in 6 of 6 rows of small scenes that it enters; `plain` with `gauss_seidel` is in 0 of 6, "
        "`plain` with `nesterov_jacobi`, the paper's method, in 0.",
    32: "Of rigid bodies with contact and friction there do not hold: " + "; ".join(["`outer_convergence.all` (code), 0.4 against 0"] * 3) + "."}


class Claims(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.directory = Path(folder.name)
        sample.write_all(cls.directory)
        cls.tested = [claim for claim in claims.CLAIMS if claim.test]

    def found(self, claim, changes):
        return find(claim, Changed(self.directory, changes))

    def test_there_are_32(self):
        self.assertEqual([claim.number for claim in claims.CLAIMS], list(range(1, 33)))

    def test_every_claim_has_a_verdict_with_a_number_or_a_reason(self):
        for claim in claims.CLAIMS:
            with self.subTest(claim.number):
                finding = self.found(claim, {})
                self.assertTrue(finding.sentence)
                self.assertEqual(bool(claim.test), finding.verdict != UNTESTED, finding)
                self.assertEqual(bool(claim.test), bool(finding.measured and finding.bound), finding)

    def test_contrary_data_refute(self):
        self.assertEqual(set(CONTRARY), {claim.number for claim in self.tested})
        for claim in self.tested:
            with self.subTest(claim.number):
                finding = self.found(claim, CONTRARY[claim.number])
                self.assertEqual(finding.verdict, REFUTED, finding)

    def test_favourable_data_support(self):
        self.assertEqual(set(FAVOURABLE), {claim.number for claim in self.tested})
        for claim in self.tested:
            with self.subTest(claim.number):
                finding = self.found(claim, FAVOURABLE[claim.number])
                self.assertEqual(finding.kind(), SUPPORTED + " under" if claim.number in CONDITIONAL else SUPPORTED, finding)
                self.assertEqual(bool(finding.against), claim.number == 15, finding)  # which claims an artefact

    def test_no_table_alone_supports(self):
        for claim in self.tested:
            best = self.found(claim, FAVOURABLE[claim.number]).kind()
            for name in set(claim.reads) - (NEVER_DECIDE if claim.number in (30, 32) else set()):
                with self.subTest(f"{claim.number} {name}"):
                    spoiled = Changed(self.directory, FAVOURABLE[claim.number], {name: without_numbers})
                    finding = find(claim, spoiled)
                    self.assertGreater(ORDER.index(finding.kind()), ORDER.index(best), finding)

    def test_what_is_not_a_number_supports_nothing(self):
        for claim in self.tested:
            with self.subTest(claim.number):
                finding = self.found(claim, {name.split("/")[1]: without_numbers for name in claim.reads})
                self.assertIn(finding.verdict, (REFUTED, UNTESTED), finding)

    def test_a_missing_table_is_named(self):
        for claim in self.tested:
            for name in claim.reads:
                with self.subTest(f"{claim.number} {name}"):
                    finding = self.found(claim, {name.split("/")[1]: lambda frame: None})
                    self.assertEqual(finding.verdict, UNTESTED)
                    self.assertIn(f"{name.split('/')[1]}.csv` is missing", finding.sentence)

    def test_the_worst_verdict_is_the_nearest_to_its_bound_or_the_farthest_beyond(self):
        def worst_of(*numbers):
            return worst(pd.DataFrame(numbers, columns=["measured", "bound"])).to_list()
        self.assertEqual(worst_of((0.5, 1.0), (9.0, 10.0), (0.0, 0.0)), [9.0, 10.0])
        self.assertEqual(worst_of((9.0, 1.0), (1.0, 0.0)), [1.0, 0.0])
        self.assertTrue(np.isnan(worst_of((9.0, 1.0), (np.nan, 1.0))[0]))

    def test_a_claim_that_holds_in_part_has_its_condition(self):
        self.assertEqual([judge(True, True, "h"), judge(False, True, "h"), judge(False, False, "h")],
                         [SUPPORTED, f"{SUPPORTED} under h", REFUTED])

    def test_rows_of_another_method_are_not_tested(self):
        claim = claims.CLAIMS[0]
        self.assertEqual(self.found(claim, {"map": lambda frame: frame.assign(outer="auto")}),
                         (UNTESTED, "The tables hold no run of `plain`.", "", "", ""))

    def test_position_runs_that_fail_where_velocity_stepping_does_not_are_told(self):
        claim = claims.CLAIMS[3]
        finding = self.found(claim, {"equal_work": lambda frame: frame.assign(status=np.where(
            (frame["family"] == "position") & (frame["scene"] == "taut chain20"), "diverged", "ok"))})
        self.assertEqual(finding.against, "On `taut chain20` position runs at equal work solved 0 of 24, where velocity stepping, which does "
                         "not claim to solve its steps, came through 12 of 12.")

    def test_findings_against_us_stand_on_their_page_and_in_front(self):
        found = claims.findings(Results(self.directory))
        bad = [(claim, finding.against) for claim, finding in found if finding.against]
        self.assertEqual({claim.number: text for claim, text in bad}, AGAINST)
        front = "".join(cell for row in claims.claims_section(found).tables[0].rows for cell in row)
        for claim, text in bad:
            self.assertIn(text, front)
            self.assertTrue(any(text in told for told in claims.against(found, claim.home())), text)
        self.assertEqual(claims.against(found, "joints"), [])

    def test_the_paper_s_figures_exist(self):
        known = {f"{figure.experiment}_{figure.name}" for figure in sample_figures()}
        self.assertEqual({claim.figure for claim in self.tested} - known, set())


class LateFriction(unittest.TestCase):
    """What friction at the end of the step does not solve is no measurement of it."""

    @staticmethod
    def runs(end_status):
        rows = [("box", variant, 0.01, "creep", 0.0, 0.0, sweeps, 10, "ok") for variant, sweeps in (("within", 30), ("end", 40))]
        rows += [("arch", "within", 0.01, "displacement", 0.0, 0.0, 50, 10, "ok"), ("arch", "end", 0.01, "displacement", 1.0, 0.0, 900, 10, end_status)]
        columns = ["scene", "variant", "step_s", "quantity", "measured", "resolved", "sweeps", "steps", "status"]
        return pd.DataFrame(rows, columns=columns).assign(expected=0.0, unit="m", natural_residual=0.0, penetration_m=0.0, reason="")

    def test_its_unsolved_runs_count_for_neither(self):
        found = late(self.runs("not_converged"))
        self.assertIn("in 0 of 1 cases that friction at the end solves, in 1 both are as near", found.sentence)
        self.assertIn("a step takes 3 iterations of `direct` with friction within it, 4 with friction at its end", found.sentence)
        self.assertIn("On the arch friction at the end of the step does not solve every step.", found.sentence)

    def test_its_solved_runs_do(self):
        found = late(self.runs("ok"))
        self.assertIn("in 1 of 2 cases", found.sentence)
        self.assertIn("4 iterations of `direct` with friction within it, 47 with friction at its end", found.sentence)


def sample_figures():
    import common
    import make  # noqa: F401  (registers the figures)
    return common.FIGURES


if __name__ == "__main__":
    unittest.main()
