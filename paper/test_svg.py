"""Tests of figures as part of a page."""

import re
import tempfile
import unittest
from pathlib import Path

import results  # noqa: F401  (makes plots/ importable)
from svg import Drawings

import matplotlib.pyplot as plt
import saving
import styles  # noqa: F401  (matplotlib's settings)


def drawn(directory, name, title):
    chart, ax = plt.subplots(figsize=(3, 2))
    ax.plot([1, 2, 3], [4, 5, 4], "o-")
    ax.set(title=title, xlabel="5 < 6 & 7")
    saving.save(chart, Path(directory), name, "a foot")
    return Path(directory) / f"{name}.svg"


class Svg(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.drawings = Drawings()
        self.paths = [drawn(folder.name, name, f"Title of {name}") for name in ("one", "two")]
        self.made = [self.drawings.inline(path, 'what is "seen"') for path in self.paths]

    def test_text_stays_text(self):
        for name, made in zip(("one", "two"), self.made):
            self.assertIn(f">Title of {name}</text>", made)
            self.assertIn("5 &lt; 6 &amp; 7", made)
            self.assertIn('aria-label="what is &quot;seen&quot;"', made)

    def test_names_are_unique_and_references_lead_to_them(self):
        ids = re.findall(r' id="(\w+)"', "".join(self.made))
        self.assertEqual(len(ids), len(set(ids)))
        for made in self.made:
            own = set(re.findall(r' id="(\w+)"', made))
            referred = set(re.findall(r'href="#(\w+)"|url\(#(\w+)\)', made))
            self.assertTrue(referred)
            self.assertEqual({a or b for a, b in referred}, own)

    def test_styles_are_in_the_sheet_and_nowhere_else(self):
        css = self.drawings.css()
        used = set(re.findall(r'class="(\w+)"', "".join(self.made)))
        self.assertEqual(used, set(re.findall(r"^\.(\w+)\{", css, re.M)))
        self.assertNotIn("<style", "".join(self.made))
        self.assertNotIn("*{", css)

    def test_it_is_smaller(self):
        for path, made in zip(self.paths, self.made):
            self.assertLess(len(made), 0.7 * path.stat().st_size)


if __name__ == "__main__":
    unittest.main()
