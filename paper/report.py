"""Writes the report of a result folder, as one self-contained HTML file and as PDF."""

import base64
import html
import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

import jinja2

import sections
from content import (Results, failure_section, provenance_section, summary_section, verdict_table)
from command import command, replacing
from reading import InputError

HERE = Path(__file__).resolve().parent
LATEX = {"\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "$": r"\$", "&": r"\&", "#": r"\#", "%": r"\%", "_": r"\_",
         "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "<": r"\textless{}", ">": r"\textgreater{}",
         "|": r"\textbar{}", '"': r"\textquotedbl{}", "×": r"$\times$", "²": r"\textsuperscript{2}", "³": r"\textsuperscript{3}",
         "µ": r"$\mu$", "ν": r"$\nu$", "μ": r"$\mu$", "°": r"$^\circ$", "±": r"$\pm$",
         "[": "{[}", "*": "{*}",  # after the end of a row they would be its arguments
         "é": r"\'e", "è": r"\`e", "ü": r'\"u', "ö": r'\"o', "ä": r'\"a', "`": ""}
NEGATIVE_EXPONENT = re.compile(r"[\d.]+e-\d+")
BIBLIOGRAPHY = (HERE / "refs.bib").read_text(encoding="utf-8")
MARK = re.compile(r"`([^`]*)`|\[@(" + "|".join(re.findall(r"@\w+\{(\w+),", BIBLIOGRAPHY)) + r")\]")


def compose(results):
    """All sections in the order of the report."""
    found = results.experiments()
    names = list(sections.SECTIONS) + [name for name in found if name not in sections.SECTIONS and name != "figures"]
    body = [summary_section(results, names)]
    for name in names:
        section = sections.section_of(results, name)
        section.tables += verdict_table(results, name)
        body.append(section)
    return [*body, failure_section(results, names), provenance_section(results, names)]


# ------------------------------------------------------------------------------------------------------------ marks

def marked(text, escape, code, cite):
    """Text with its marks replaced and all else escaped."""
    out, end = [], 0
    for match in MARK.finditer(text):
        out.append(escape(text[end:match.start()]))
        out.append(code(escape(match[1])) if match[1] is not None else cite(match[2]))
        end = match.end()
    return "".join(out) + escape(text[end:])


def to_latex(text):
    def escape(plain):
        text = "".join(LATEX.get(c, c if c.isascii() and c.isprintable() else " " if c.isspace() else "?") for c in plain)
        return NEGATIVE_EXPONENT.sub(r"\\mbox{\g<0>}", text)  # else a line may end after its hyphen

    def code(escaped):
        for mark in (r"\_", "/", "."):
            escaped = escaped.replace(mark, mark + r"\allowbreak{}")
        return r"\texttt{" + escaped + "}"

    return marked(text, escape, code, lambda key: rf"\citep{{{key}}}")


def to_html(text, references):
    def cite(key):
        return f'[<a href="#{key}">{list(references).index(key) + 1}</a>]'

    return marked(text, html.escape, lambda escaped: f"<code>{escaped}</code>", cite)


def references(text):
    """The entries of refs.bib as plain text, by key."""
    entries = {}
    for key, body in re.findall(r"@\w+\{(\w+),\n(.*?)\n\}", text, re.S):
        fields = {name: plain_bibtex(value) for name, value in re.findall(r"(\w+) = \{(.*)\},?", body)}
        who = (fields.get("author") or fields["editor"]).replace(" and ", "; ")
        where = next((fields[name] for name in ("journal", "booktitle", "school", "publisher") if name in fields), "")
        volume = f" {fields['volume']}" if "volume" in fields else ""
        doi = f", doi:{fields['doi']}" if "doi" in fields else ""
        entries[key] = f"{who}: {fields['title']}. {where}{volume}{', ' if where else ''}{fields['year']}{doi}."
    return entries


def plain_bibtex(text):
    for mark, letter in ((r'{\"u}', "ü"), (r"{\`e}", "è"), (r"{\'e}", "é"), (r"{\'a}", "á"), (r"{\'i}", "í"), (r"\&", "&"),
                         ("{$O(1/k^2)$}", "O(1/k²)"), ("--", "–")):
        text = text.replace(mark, letter)
    return text.replace("{", "").replace("}", "")


# ------------------------------------------------------------------------------------------------------------- html

def inlined(path):
    """A figure as a data URI."""
    svg, png = path.with_suffix(".svg"), path.with_suffix(".png")
    chosen = png if svg.stat().st_size > 1_500_000 else svg
    kind = "svg+xml" if chosen.suffix == ".svg" else "png"
    return f"data:image/{kind};base64,{base64.b64encode(chosen.read_bytes()).decode()}"


def write_html(body, directory):
    entries = references(BIBLIOGRAPHY)
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters["marked"] = lambda text: jinja2.utils.markupsafe.Markup(to_html(text, entries))
    text = environment.get_template("report.html.j2").render(
        sections=body, references=entries, inlined=lambda name: inlined(directory / "figures" / name))
    write_file(directory / "report.html", text.encode())


# -------------------------------------------------------------------------------------------------------------- pdf

def column_widths(table):
    """Column specification of a LaTeX table: long texts share the width that the short ones leave."""
    line, short, longest_counted = 100, 14, 60  # characters
    longest = [max(len(row[i].replace("`", "")) for row in [table.header, *table.rows]) for i in range(len(table.header))]
    if sum(longest) + 2 * len(longest) <= line - 5:
        return "l" * len(longest)
    room = line - sum(length + 2 for length in longest if length <= short)
    wanted = sum(min(length, longest_counted) + 2 for length in longest if length > short)
    shares = [length if length <= short else room * (min(length, longest_counted) + 2) / wanted - 2 for length in longest]
    return "".join(rf">{{\raggedright\arraybackslash}}p{{{share / line:.3f}\linewidth}}" for share in shares)


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
    environment.filters["marked"] = to_latex
    figures = (directory / "figures").resolve()
    text = environment.get_template("report.tex.j2").render(
        sections=body, widths=column_widths)
    with tempfile.TemporaryDirectory() as folder:
        build = Path(folder)
        (build / "report.tex").write_text(text, encoding="utf-8")
        shutil.copy(HERE / "refs.bib", build)
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
    write_html(body, directory)
    print(directory / "report.html")
    write_pdf(body, directory)
    print(directory / "report.pdf")


if __name__ == "__main__":
    command(main, "Writes the report of a result folder, as `pbdcheck run` and plots/make.py left it: DIR/report.html, one "
                  "self-contained file, and DIR/report.pdf.")
