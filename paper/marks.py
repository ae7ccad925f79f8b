"""Texts with marks, as LaTeX and as HTML; the bibliography.

Text that looks like a citation or a reference and names nothing known is text.
"""

import html
import re
from pathlib import Path
from typing import NamedTuple

LATEX = {"\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "$": r"\$", "&": r"\&", "#": r"\#", "%": r"\%", "_": r"\_",
         "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "<": r"\textless{}", ">": r"\textgreater{}",
         "|": r"\textbar{}", '"': r"\textquotedbl{}", "×": r"$\times$", "²": r"\textsuperscript{2}", "³": r"\textsuperscript{3}",
         "µ": r"$\mu$", "ν": r"$\nu$", "μ": r"$\mu$", "°": r"$^\circ$", "±": r"$\pm$",
         "[": "{[}", "*": "{*}",  # after the end of a row they would be its arguments
         "é": r"\'e", "è": r"\`e", "ü": r'\"u', "ö": r'\"o', "ä": r'\"a', "á": r"\'a", "í": r"\'{\i}", "–": "--", "`": ""}
NEGATIVE_EXPONENT = re.compile(r"[\d.]+e-\d+")
BIBLIOGRAPHY = (Path(__file__).resolve().parent / "refs.bib").read_text(encoding="utf-8")
MARK = re.compile(r"`([^`]*)`|\[@(" + "|".join(re.findall(r"@\w+\{(\w+),", BIBLIOGRAPHY)) + r")\]|\[#(\w+)\]")


def marked(text, escape, code, cite, refer):
    """Text with its marks replaced and all else escaped."""
    out, end = [], 0
    for match in MARK.finditer(text):
        whole, literal, key, name = match[0], *match.groups()
        out.append(escape(text[end:match.start()]))
        out.append(code(escape(literal)) if literal is not None else cite(key) if key else refer(name) or escape(whole))
        end = match.end()
    return "".join(out) + escape(text[end:])


def to_latex(text, places=None):
    """`places` is what content.places found."""
    def escape(plain):
        text = "".join(LATEX.get(c, c if c.isascii() and c.isprintable() else " " if c.isspace() else "?") for c in plain)
        return NEGATIVE_EXPONENT.sub(r"\\mbox{\g<0>}", text)  # else a line may end after its hyphen

    def code(escaped):
        for mark in (r"\_", "/", "."):
            escaped = escaped.replace(mark, mark + r"\allowbreak{}")
        return r"\texttt{" + escaped + "}"

    def refer(name):
        return rf"\hyperref[{name}]{{{places[name].replace(' ', '~')}}}" if name in (places or {}) else ""

    return marked(text, escape, code, lambda key: rf"\cite{{{key}}}", refer)


def to_html(text, references, places=None, files=()):
    """`files` are the result tables that there are."""
    def cite(key):
        return f'[<a href="#{key}">{list(references).index(key) + 1}</a>]'

    def refer(name):
        return f'<a href="#{name}">{places[name]}</a>' if name in (places or {}) else ""

    def code(escaped):
        text = f"<code>{escaped}</code>"
        return f'<a href="{escaped}">{text}</a>' if escaped in files else text

    return marked(text, html.escape, code, cite, refer)


def plain(text, places):
    """Without marks, for a terminal."""
    return marked(text, str, str, lambda key: f"[{key}]", lambda name: places.get(name, ""))


class Reference(NamedTuple):
    text: str
    link: str  # '' if there is none


def references(text):
    """The entries of refs.bib by key, in the order of their numbers: by author."""
    entries = {}
    for key, body in re.findall(r"@\w+\{(\w+),\n(.*?)\n\}", text, re.S):
        fields = {name: plain_bibtex(value) for name, value in re.findall(r"(\w+) = \{(.*)\},?", body)}
        who = (fields.get("author") or fields["editor"]).replace(" and ", "; ")
        where = next((fields[name] for name in ("journal", "booktitle", "school", "publisher") if name in fields), "")
        volume = f" {fields['volume']}" if "volume" in fields else ""
        link = f"https://doi.org/{fields['doi']}" if "doi" in fields else fields.get("url", "")
        entries[key] = Reference(f"{who}: {fields['title']}. {where}{volume}{', ' if where else ''}{fields['year']}.", link)
    return dict(sorted(entries.items(), key=lambda entry: entry[1].text.lower()))


def plain_bibtex(text):
    for mark, letter in ((r'{\"u}', "ü"), (r'\"a', "ä"), (r"{\`e}", "è"), (r"{\'e}", "é"), (r"{\'a}", "á"), (r"{\'i}", "í"), (r"\&", "&"),
                         ("{$O(1/k^2)$}", "O(1/k²)"), ("--", "–")):
        text = text.replace(mark, letter)
    return text.replace("{", "").replace("}", "")
