"""The claims of the paper, and what the results say of each."""

from claims import contact, energy, material, solver, stability, unification
from claims.claim import REFUTED, VERDICTS, find
from content import Section, Table, joined

GROUPS = {"Stability and fixed point": stability, "Energy": energy, "Contact and friction": contact,
          "Viscoelasticity and finite elements": material, "Solver": solver, "Unification": unification}
CLAIMS = tuple(claim for group in GROUPS.values() for claim in group.CLAIMS)

METHOD = (
    "The paper's own method [@francu2017position] is here `plain` with `nesterov_jacobi` and the convex law `cone`: whole multipliers "
    "along directions that each iteration refreshes, accelerated Jacobi, and a convex cone; `box` is its variant by a box LCP solver. "
    "Everything else is ours or from the literature: `proximal`, `quasi_newton` and `auto`, `conjugate_gradients` and `direct`, the laws "
    "`coulomb` and `disc`. `incremental` is classic PBD, `frozen` velocity time stepping.")
SOURCE = (
    "Two pages of the paper were available, its abstract, introduction and equations (1) to (7); the rest was not. Text in "
    "quotation marks is quoted word for word; the wording of each claim is ours. The other claims are inferred from the method. "
    "The tests and their bounds are ours.")


def findings(results):
    return [(claim, find(claim, results)) for claim in CLAIMS]


def against(found, experiment):
    """The findings against the method or its solver that belong to the page of an experiment."""
    return [f"{finding.against} This bears on claim {claim.number}, [#claims]." for claim, finding in found
            if finding.against and claim.home() == experiment]


def row(claim, finding):
    source = f'"{claim.quote}"' if claim.quote else "(inferred)"
    numbers = f": {finding.measured} against {finding.bound}" if finding.measured else ""
    places = [f"[#{claim.home()}]", f"[#{claim.figure}]", *(f"`{name}.csv`" for name in claim.reads)] if claim.reads else []
    see = f" See {', '.join(places)}." if places else ""
    return [str(claim.number), f"{claim.statement} {source}", finding.verdict + numbers, finding.sentence + see]


def kinds_counted(kinds):
    """How many claims are found to be of each kind."""
    return joined(f"{kinds.count(kind)} {kind}" + (" a condition" if kind.endswith("under") else "") for kind in VERDICTS)


def claims_section(found):
    kinds = [finding.kind() for _, finding in found]
    bad = [f"{finding.against or finding.sentence} ([#{claim.home()}], claim {claim.number})" for claim, finding in found
           if finding.against or finding.kind() == REFUTED]
    section = Section("The claims", name="claims", paragraphs=[f"Of {len(found)} claims these runs find {kinds_counted(kinds)}.", METHOD, SOURCE])
    if bad:
        section.tables.append(Table("Against the paper and ourselves.", ["finding"], [[text] for text in bad]))
    for title, group in GROUPS.items():
        section.tables.append(Table(
            f"{title}.", ["", "claim", "verdict: measured against bound", "finding"],
            [row(claim, finding) for claim, finding in found if claim in group.CLAIMS]))
    return section
