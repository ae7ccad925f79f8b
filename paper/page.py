"""The report as one HTML file that needs no network: style, script, figures and animations are part of it.

The script is written by hand. Debian's libraries for tables, tablesorter and DataTables, need jQuery, which makes 180 kB to
inline for what `report.js` does in 100 lines.
"""

from base64 import b64encode
from pathlib import Path

import jinja2
from markupsafe import Markup

from content import places
from marks import BIBLIOGRAPHY, plain, references, to_html
from svg import Drawings

HERE = Path(__file__).resolve().parent
BAD = ("fails", "failed", "refuted")  # cells that must not be overlooked


def page(body, directory):
    """The text of the page; what it links to stands in `directory`."""
    entries = references(BIBLIOGRAPHY)
    known = places(body.sections, body.answers)
    drawings = Drawings()
    figures = [answer.figure for answer in body.answers] + [figure for section in body.sections for figure in section.figures]
    drawn = {figure.name: Markup(drawings.inline(directory / "figures" / f"{figure.name}.svg", plain(figure.caption, known)))
             for figure in figures if figure.drawn}
    moving = {each.path: "data:image/webp;base64," + b64encode(each.path.read_bytes()).decode()
              for section in body.sections for each in section.animations if each.rendered}
    files = {f"{section.name}/{file.name}" for section in body.sections for file in section.files}
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters["marked"] = lambda text: Markup(to_html(text, entries, known, files))
    environment.filters["plain"] = lambda text: plain(text, known)
    return environment.get_template("report.html.j2").render(
        **vars(body), places=known, references=entries, drawn=drawn, moving=moving, bad=BAD,
        css=Markup((HERE / "report.css").read_text(encoding="utf-8") + drawings.css()),
        script=Markup((HERE / "report.js").read_text(encoding="utf-8")))
