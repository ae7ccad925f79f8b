"""Writes the report of a result folder, as one self-contained HTML file and as PDF, and prints its answers."""

import os
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import jinja2

import provenance
import sections
from sections.trajectories import choice as method_choice
from answers import answers, guide, summary
from claims import against, claims_section, findings
from command import command, replacing
from content import places
from failed import all_verdicts, failed_section, verdicts_section
from glossary import glossary_section
from history import history_section
from marks import BIBLIOGRAPHY, plain, references, to_latex
from page import page
from reading import InputError
from results import Results

HERE = Path(__file__).resolve().parent
LONGEST = 12  # rows of an experiment's table in the PDF; longer ones are in the HTML alone


@dataclass
class Body:
    notice: str
    answers: list
    summary: str
    choice: list  # the table to choose a method by, none without its results
    limits: str
    guide: list
    sections: list


def compose(results):
    """All of the report, in its order."""
    found = results.experiments()
    names = list(sections.SECTIONS) + [name for name in found if name not in sections.SECTIONS and name != "figures"]
    found = findings(results)
    studies = [sections.section_of(results, name) for name in names]
    cited = {claim.figure for claim, _ in found}
    for section in studies:
        section.files = results.files(section.name)
        section.animations = results.animations(section.name)
        section.tables.sort(key=lambda table: not table.first)
        section.paragraphs += against(found, section.name)
        for number, figure in enumerate(section.figures):
            figure.detail = number > 0 and figure.name not in cited
        for table in section.tables:
            table.detail = len(table.rows) > LONGEST
    body = [claims_section(found), failed_section(results, names), history_section(results, names), glossary_section(), *studies,
            verdicts_section(results, names), provenance.provenance_section(results, names)]
    choice = method_choice(results)
    for number, table in enumerate((*choice, *(table for section in body for table in section.tables)), start=1):
        table.number = number
    return Body(provenance.notice(results, names), answers(results), summary(found, all_verdicts(results, names)), choice, provenance.limits(results, names), guide(body), body)


def column_widths(table):
    """Column specification of a LaTeX table: long texts share the width that the short ones leave."""
    line, short, longest_counted = 100, 14, 300  # characters
    longest = [max(len(row[i].replace("`", "")) for row in [table.header, *table.rows]) for i in range(len(table.header))]
    if sum(longest) + 2 * len(longest) <= line - 5:
        return "l" * len(longest)
    narrow = {i: float(length) for i, length in enumerate(longest) if length <= short}
    while True:  # no column is narrower than its longest word, as far as the line has room
        wide = [i for i in range(len(longest)) if i not in narrow]
        room = line - sum(width + 2 for width in narrow.values())
        wanted = sum(min(longest[i], longest_counted) + 2 for i in wide)
        shares = narrow | {i: room * (min(longest[i], longest_counted) + 2) / wanted - 2 for i in wide}
        tight = {i: least for i in wide if shares[i] < (least := longest_word(table, i))}
        if not tight or len(tight) == len(wide):
            return "".join(rf">{{\raggedright\arraybackslash}}p{{{max(shares[i], 1) / line:.3f}\linewidth}}" for i in range(len(longest)))
        narrow |= tight


def longest_word(table, column):
    """Of a column of a LaTeX table, in characters of running text; those of code are wider, and code may be broken (marks.to_latex)."""
    words = [word for row in [table.header, *table.rows] for word in row[column].split()]
    return max((1.2 * max(map(len, re.split("[_/.`]", word))) if "`" in word else len(word) for word in words), default=0)


def write_pdf(body, directory):
    """Builds the report in a temporary folder; if it cannot, says what to do and leaves no older PDF beside the HTML."""
    log = directory / "report.log"
    for path in (directory / "report.pdf", log):
        path.unlink(missing_ok=True)
    if not shutil.which("latexmk"):
        raise InputError("report.pdf is not written, report.html is: latexmk is not installed "
                         "(Debian: latexmk texlive-latex-recommended)")
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE), trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined,
        block_start_string="<%", block_end_string="%>", variable_start_string="<<", variable_end_string=">>",
        comment_start_string="<#", comment_end_string="#>")
    known = places(body.sections, body.answers)
    environment.filters["marked"] = lambda text: to_latex(text, known)
    figures = (directory / "figures").resolve()
    text = environment.get_template("report.tex.j2").render(**vars(body), places=known, widths=column_widths,
                                                                references=references(BIBLIOGRAPHY))
    with tempfile.TemporaryDirectory() as folder:
        build = Path(folder)
        (build / "report.tex").write_text(text, encoding="utf-8")
        (build / "figures").symlink_to(figures)
        done = subprocess.run(["latexmk", "-pdf", "-interaction=nonstopmode", "-halt-on-error", "report.tex"], cwd=build,
                              capture_output=True, text=True, errors="replace", check=False,
                              env={**os.environ, "SOURCE_DATE_EPOCH": "0", "FORCE_SOURCE_DATE": "1"})
        if done.returncode != 0:
            write_file(log, (done.stdout + done.stderr).encode())
            raise InputError(f"report.pdf is not written, report.html is: LaTeX failed, see {log}")
        write_file(directory / "report.pdf", (build / "report.pdf").read_bytes())


def write_file(path, data):
    with replacing(path) as partial:
        partial.write_bytes(data)


def main(directory):
    """Writes DIR/report.html and DIR/report.pdf."""
    if not directory.is_dir():
        raise InputError(f"{directory}: got no folder; allowed: a result folder, as written by `pbdcheck run`")
    results = Results(directory)
    if not results.experiments():
        raise InputError(f"{directory}: got no experiment; allowed: a result folder, as written by `pbdcheck run`")
    body = compose(results)
    write_file(directory / "report.html", page(body, directory).encode())
    print(directory / "report.html")
    write_pdf(body, directory)
    print(directory / "report.pdf")
    for answer in body.answers:
        print(f"{answer.question} {plain(answer.sentence, places(body.sections, body.answers))}")


if __name__ == "__main__":
    command(main, "Writes the report of a result folder, as `pbdcheck run` and plots/make.py left it: DIR/report.html, one "
                  "self-contained file, and DIR/report.pdf.")
