"""Figures as part of a page: matplotlib's SVG files without what repeats in them, with text that stays text.

Style attributes become classes that all figures of a page share, names become short and unique to the figure, coordinates are
kept to 1/100 of a point.
"""

import re
import xml.etree.ElementTree as ElementTree

NUMBER = re.compile(r"-?\d*\.\d+(?:e-?\d+)?")
REFERENCE = re.compile(r"^(url\()?#(\w+)")
COORDINATES = {"d", "x", "y", "width", "height", "transform", "viewBox"}
FONTS = "'DejaVu Sans',Verdana,sans-serif"  # the figures are laid out with the first; the second is as wide
# What matplotlib says once for all elements of a file; in a page it would be said of the page.
COMMON = f"figure svg{{stroke-linejoin:round;stroke-linecap:butt;font-family:{FONTS}}}"


def short(match):
    """A number to 1/100."""
    text = f"{float(match[0]):.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def coordinates(value):
    return re.sub(r" ?([A-Za-z]) ?", r"\1", NUMBER.sub(short, " ".join(value.split())))


class Drawings:
    """The figures of one page and the style sheet that they share."""

    def __init__(self):
        self.classes = {}
        self.names = {}

    def css(self):
        return "\n".join([COMMON, *(f".{name}{{{style}}}" for style, name in self.classes.items())])

    def inline(self, path, title):
        """The SVG element of a file, labelled for who cannot see it."""
        text = re.sub(r"<!DOCTYPE.*?>|<!--.*?-->", "", path.read_text(encoding="utf-8"), flags=re.S)
        referred = {name for name in re.findall(r"#(\w+)", text) if f'id="{name}"' in text}
        root = ElementTree.fromstring(text)
        for element in root.iter():
            element.tag = element.tag.split("}")[-1]
            element[:] = [child for child in element if child.tag.split("}")[-1] not in ("metadata", "style")]
            if element.tag not in ("text", "tspan"):
                element.text = None
            element.tail = None
            element.attrib = dict(self.attributes(path.stem, element.attrib, referred))
        view = root.get("viewBox")
        root.attrib = {"viewBox": view, "role": "img", "aria-label": title, "style": f"max-width:{float(view.split()[2]):.0f}pt"}
        return ElementTree.tostring(flattened(root), encoding="unicode").replace(" />", "/>")

    def attributes(self, figure, found, referred):
        for name, value in found.items():
            name = name.split("}")[-1]
            if name == "transform" and value.startswith("rotate(-0 "):
                continue
            if name in COORDINATES:
                yield name, value if name == "viewBox" else coordinates(value)
            elif name == "style":
                yield "class", self.class_of(value)
            elif name == "id" and value in referred:
                yield "id", self.name_of(figure, value)
            elif name != "id":
                yield name, REFERENCE.sub(lambda match: f"{match[1] or ''}#{self.name_of(figure, match[2])}", value)

    def name_of(self, figure, name):
        return self.names.setdefault((figure, name), f"g{len(self.names)}")

    def class_of(self, style):
        style = re.sub(r"'DejaVu Sans'[^;]*", FONTS, style).replace(": ", ":").replace("; ", ";")
        return self.classes.setdefault(style, f"s{len(self.classes)}")


def flattened(element):
    """Without groups that say nothing of what they hold."""
    children = []
    for child in element:
        flattened(child)
        children += list(child) if child.tag == "g" and not child.attrib else [child]
    element[:] = children
    return element
