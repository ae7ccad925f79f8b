"""The report as data, the same for HTML and LaTeX, and how numbers and names are written.

Texts are plain: `code` between backticks, citations as [@key] and references as [#name], to a section or a figure, are all
the marking there is.
"""

from dataclasses import dataclass, field

import results  # noqa: F401  (makes plots/ importable)
from wording import counted, joined, number, share, span  # noqa: F401  (sections and claims take them from here)


@dataclass
class Table:
    caption: str
    header: list
    rows: list  # of texts
    detail: bool = False  # folded in HTML, and left out of the PDF
    first: bool = False  # before the figures
    number: int = 0  # in the report


@dataclass
class Figure:
    name: str  # DIR/figures/<name>.{png,svg,pdf}, and what [#name] refers to
    caption: str
    drawn: bool = False  # from these very results
    detail: bool = False  # left out of the PDF


@dataclass
class Section:
    title: str
    question: str = ""
    notice: str = ""  # what a reader must not overlook
    paragraphs: list = field(default_factory=list)
    figures: list = field(default_factory=list)
    tables: list = field(default_factory=list)
    name: str = ""  # what [#name] refers to
    page: bool = False  # begins a page of the PDF
    appendix: bool = False  # folded in HTML
    files: list = field(default_factory=list)  # results.File: what it is made from
    animations: list = field(default_factory=list)  # results.Animation: HTML alone

    def tell(self, frame, *parts):
        """Adds the text or Table that each of `parts` makes of a result table, if there is one."""
        for part in parts if frame is not None else ():
            made = part(frame)
            (self.tables if isinstance(made, Table) else self.paragraphs).append(made)
        return self


def places(sections, answers=()):
    """What [#name] is written as: the number of each section, and of each figure if it is drawn."""
    found = {section.name: f"section {number}" for number, section in enumerate(sections, start=1) if section.name}
    figures = [answer.figure for answer in answers] + [figure for section in sections for figure in section.figures]
    drawn = [figure.name for figure in figures if figure.drawn]
    found |= {figure.name: "a figure that is not drawn" for figure in figures}
    return found | {name: f"figure {number}" for number, name in enumerate(drawn, start=1)}


def listed(words):
    """`a`, `b` and `c`."""
    return joined([f"`{word}`" for word in words]) or "none"


def compared(measured, bound):
    """Two numbers, with as many digits as it takes to tell them apart."""
    digits = next(d for d in range(3, 18) if d == 17 or measured == bound or f"{measured:.{d}g}" != f"{bound:.{d}g}")
    return number(measured, digits), number(bound, digits)
