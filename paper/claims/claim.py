"""A claim, and what the results say of it.

A test gets the tables that its claim reads and returns a Finding that may turn out either way. What is not a number supports
nothing: a test counts it as a miss.
"""

from dataclasses import dataclass
from typing import Callable, NamedTuple

import numpy as np

SUPPORTED, REFUTED, UNTESTED = "supported", "refuted", "not tested"
VERDICTS = (SUPPORTED, SUPPORTED + " under", REFUTED, UNTESTED)


class Finding(NamedTuple):
    verdict: str  # one of VERDICTS, the second with its condition
    sentence: str
    measured: str = ""
    bound: str = ""
    against: str = ""  # a sentence against the method or its solver, which also stands on the page of its experiment

    def kind(self):
        """The verdict without its condition."""
        return next(kind for kind in (SUPPORTED + " under", *VERDICTS) if self.verdict.startswith(kind))


class Untested(Exception):
    """The tables that a claim reads do not hold what it asks for."""


@dataclass(frozen=True)
class Claim:
    number: int
    statement: str
    quote: str = ""  # from the paper's first two pages; '' if the claim is inferred from the method
    reads: tuple = ()  # "experiment/table", in the order of the test's arguments; the first is the claim's own
    test: Callable = None  # (*tables) -> Finding
    figure: str = ""
    untested: str = ""  # why there is no experiment

    def home(self):
        """The experiment on whose page a finding stands."""
        return self.reads[0].split("/")[0]


def find(claim, results):
    """What the results say of a claim."""
    if claim.test is None:
        return Finding(UNTESTED, claim.untested)
    frames = {}
    for name in claim.reads:
        experiment, table = name.split("/")
        frames[name] = results.table(experiment, table)
        if frames[name] is None:
            return Finding(UNTESTED, f"`{name}.csv` is missing: {results.shortfall(experiment) or 'not written, or empty'}.")
    try:
        return claim.test(*frames.values())
    except Untested as gap:
        return Finding(UNTESTED, f"{gap}.")


def some(rows, what):
    """The rows; a claim about none of them is not tested."""
    if len(rows) == 0:
        raise Untested(f"The tables hold no {what}")
    return rows


def all_at_most(values, bound):
    """Whether every value is a number of at most `bound`."""
    return bool((np.asarray(values, dtype=float) <= bound).all())


def verdict_rows(verdicts, *prefixes):
    """The verdicts of these ids."""
    return some(verdicts[verdicts["id"].str.startswith(prefixes)], f"verdict {' or '.join(prefixes)}")


def worst(rows):
    """The verdict that is nearest to its bound, or farthest beyond it."""
    share = (rows["measured"] / rows["bound"]).where(rows["bound"] > 0, np.where(rows["measured"] <= rows["bound"], 0, np.inf))
    return rows.loc[share.fillna(np.inf).idxmax()]


def judge(holds, partly=False, condition=""):
    """The verdict of a claim that holds, holds in part under a condition, or does not."""
    return SUPPORTED if holds else f"{SUPPORTED} under {condition}" if partly else REFUTED
