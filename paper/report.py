"""Writes DIR/report.html (one self-contained file) and DIR/report.pdf:  /usr/bin/python3 paper/report.py DIR"""

import base64
import html
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import jinja2

import sections
from content import (Results, failure_section, provenance_section, summary_section, verdict_table)
from reading import InputError, fail

HERE = Path(__file__).resolve().parent
LATEX = {"\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "$": r"\$", "&": r"\&", "#": r"\#", "%": r"\%", "_": r"\_",
         "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "<": r"\textless{}", ">": r"\textgreater{}",
         "|": r"\textbar{}", '"': r"\textquotedbl{}", "×": r"$\times$", "²": r"\textsuperscript{2}", "µ": r"$\mu$", "ν": r"$\nu$", "μ": r"$\mu$", "°": r"$^\circ$",
         "é": r"\'e", "è": r"\`e", "ü": r'\"u', "ö": r'\"o', "ä": r'\"a', "`": ""}
MARK = re.compile(r"`([^`]*)`|\[@([a-z0-9]+)\]")


def compose(results):
    """All sections in the order of the report."""
    found = results.experiments()
    names = list(sections.SECTIONS) + [name for name in found if name not in sections.SECTIONS and name != "figures"]
    present = [name for name in names if name in found]
    body = [summary_section(results, present)]
    for name in names:
        section = sections.section_of(results, name)
        section.tables += verdict_table(results, name)
        body.append(section)
    return [*body, failure_section(results, present), provenance_section(results, present)]


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
        return "".join(LATEX.get(c, c if c.isascii() else "?") for c in plain)

    def code(escaped):
        return r"\texttt{" + escaped.replace(r"\_", r"\_\allowbreak{}").replace("/", r"/\allowbreak{}") + "}"

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
        where = fields.get("journal") or fields.get("booktitle") or fields.get("school")
        volume = f" {fields['volume']}" if "volume" in fields else ""
        doi = f", doi:{fields['doi']}" if "doi" in fields else ""
        entries[key] = f"{fields['author']}: {fields['title']}. {where}{volume}, {fields['year']}{doi}."
    return entries


def plain_bibtex(text):
    for mark, letter in ((r'{\"u}', "ü"), (r"{\`e}", "è"), (r"{\'e}", "é"), (r"\&", "&"), ("{$O(1/k^2)$}", "O(1/k²)"),
                         (" and ", "; "), ("--", "–")):
        text = text.replace(mark, letter)
    return text.replace("{", "").replace("}", "")


# ------------------------------------------------------------------------------------------------------------- html

def inlined(path):
    """A figure as a data URI, None if it was not drawn."""
    svg, png = path.with_suffix(".svg"), path.with_suffix(".png")
    chosen = png if svg.exists() and png.exists() and svg.stat().st_size > 1_500_000 else svg
    if not chosen.exists():
        return None
    kind = "svg+xml" if chosen.suffix == ".svg" else "png"
    return f"data:image/{kind};base64,{base64.b64encode(chosen.read_bytes()).decode()}"


def write_html(body, directory):
    entries = references((HERE / "refs.bib").read_text(encoding="utf-8"))
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters["marked"] = lambda text: jinja2.utils.markupsafe.Markup(to_html(text, entries))
    text = environment.get_template("report.html.j2").render(
        sections=body, references=entries, inlined=lambda name: inlined(directory / "figures" / name))
    write_file(directory / "report.html", text.encode())


# -------------------------------------------------------------------------------------------------------------- pdf

def column_widths(table):
    """Column specification of a LaTeX table: long texts share the width that the short ones leave."""
    longest = [max(len(row[i].replace("`", "")) for row in [table.header, *table.rows]) for i in range(len(table.header))]
    if sum(longest) + 2 * len(longest) <= 95:
        return "l" * len(longest)
    wide = [max(1, min(length, 60)) for length in longest]
    room = 1 - 0.024 * len(wide)
    total = sum(wide)
    return "".join(rf">{{\raggedright\arraybackslash}}p{{{room * max(width, 7) / total:.3f}\linewidth}}" for width in wide)


def write_pdf(body, directory):
    """Builds the report in a temporary folder; raises RuntimeError with what to do if it cannot."""
    if not shutil.which("latexmk"):
        raise RuntimeError("latexmk is not installed (Debian: latexmk texlive-latex-recommended)")
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE), trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined,
        block_start_string="<%", block_end_string="%>", variable_start_string="<<", variable_end_string=">>",
        comment_start_string="<#", comment_end_string="#>")
    environment.filters["marked"] = to_latex
    figures = (directory / "figures").resolve()
    text = environment.get_template("report.tex.j2").render(
        sections=body, widths=column_widths, drawn=lambda name: (figures / f"{name}.pdf").exists())
    with tempfile.TemporaryDirectory() as folder:
        build = Path(folder)
        (build / "report.tex").write_text(text, encoding="utf-8")
        shutil.copy(HERE / "refs.bib", build)
        (build / "figures").symlink_to(figures)
        done = subprocess.run(["latexmk", "-pdf", "-interaction=nonstopmode", "-halt-on-error", "report.tex"], cwd=build,
                              capture_output=True, text=True, errors="replace", check=False,
                              env={**os.environ, "SOURCE_DATE_EPOCH": "0", "FORCE_SOURCE_DATE": "1"})
        if done.returncode != 0:
            log = directory / "report.log"
            write_file(log, (done.stdout + done.stderr).encode())
            raise RuntimeError(f"LaTeX failed, see {log}")
        write_file(directory / "report.pdf", (build / "report.pdf").read_bytes())


def write_file(path, data):
    partial = path.with_name(path.name + ".partial")
    partial.write_bytes(data)
    os.replace(partial, path)


def main(directory):
    if not directory.is_dir():
        raise InputError(f"{directory}: got no folder; allowed: a result folder, as written by `pbdcheck run`")
    body = compose(Results(directory))
    write_html(body, directory)
    print(directory / "report.html")
    try:
        write_pdf(body, directory)
        print(directory / "report.pdf")
    except RuntimeError as error:
        print(f"report.pdf was not written: {error}", file=sys.stderr)


if __name__ == "__main__":
    try:
        main(Path(sys.argv[1] if len(sys.argv) > 1 else "results"))
    except InputError as error:
        fail(error)
