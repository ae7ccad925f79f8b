"""Tests of the report's page in a browser: python3 paper/test_browser.py [RESULTS], whose report is tested, else one of made-up
results.

Needs chromium, chromium-driver and python3-selenium (`make test-report` installs them).
"""

import re
import sys
import unittest
from pathlib import Path
from urllib.parse import unquote, urlparse

import sections
from browsing import BrowserTest, By, Keys

MOST_BYTES = 4_000_000


class Page(BrowserTest):
    def test_it_is_small_and_needs_no_network(self):
        text = self.path.read_text(encoding="utf-8")
        self.assertLessEqual(len(text.encode()), MOST_BYTES)
        for loading in re.findall(r'<(?:script|img|link|iframe|object|embed|image)\b[^>]*?(?:src|href)="([^"]*)"', text):
            self.assertTrue(loading.startswith("data:"), loading)
        self.assertNotIn("@import", text)

    def test_every_link_leads_somewhere(self):
        links = self.run_js("return [...document.querySelectorAll('a')].map(a => a.href)")
        self.assertGreater(len(links), 100)
        ids = set(self.run_js("return [...document.querySelectorAll('[id]')].map(e => e.id)"))
        for link in set(links):
            parts = urlparse(link)
            if parts.scheme == "https":
                continue
            self.assertEqual(parts.scheme, "file", link)
            if Path(unquote(parts.path)) == self.path:
                self.assertIn(unquote(parts.fragment), ids)
            else:
                self.assertTrue(Path(unquote(parts.path)).is_file(), link)

    def test_names_are_unique(self):
        ids = self.run_js("return [...document.querySelectorAll('[id]')].map(e => e.id)")
        self.assertEqual(len(ids), len(set(ids)))

    def test_a_link_to_what_is_folded_unfolds_it(self):
        self.run_js("foldAll(true)")
        target = self.all("main details table")[0]
        self.assertFalse(self.seen(target))
        self.run_js("location.hash = arguments[0].id", target)
        self.assertTrue(self.wait(lambda: self.seen(target)))
        self.assertTrue(0 <= self.run_js("return arguments[0].getBoundingClientRect().top", target) < 900)

    def test_a_column_sorts_both_ways_and_back(self):
        table = self.table(4)
        for index, head in enumerate(table.find_elements(By.TAG_NAME, "th")):
            before = self.column(table, index)
            button = head.find_element(By.TAG_NAME, "button")
            seen = []
            for state in ("ascending", "descending", None):
                button.click()
                self.assertEqual(head.get_attribute("aria-sort"), state)
                seen.append(self.column(table, index))
            self.assertEqual(seen[2], before)
            self.assertEqual(sorted(seen[0]), sorted(before))
            self.assertEqual(self.run_js("return arguments[0].every((t, i, all) => !i || compare(all[i - 1], t) <= 0)", seen[0]), True)
            if len(set(before)) > 1:
                self.assertNotEqual(seen[0], seen[1])

    def test_numbers_sort_by_size(self):
        cells = ["10", "9", "1e-6", "not a number", "inf", "-2", "3 of 5", "1.5 to 7"]
        self.assertEqual(self.run_js("return arguments[0].sort(compare)", cells),
                         ["-2", "1e-6", "1.5 to 7", "3 of 5", "9", "10", "inf", "not a number"])

    def test_rows_are_filtered(self):
        capitalised = r"[A-Z][a-z]{3,}"
        table = self.table(10, capitalised)
        rows = len(self.column(table, 0))
        region = table.find_element(By.XPATH, "..")
        field = region.find_element(By.XPATH, "preceding-sibling::p[1]//input")
        word = re.search(capitalised, self.run_js("return arguments[0].tBodies[0].textContent", table))[0]
        field.send_keys(word.swapcase())
        shown = [row for row in table.find_elements(By.CSS_SELECTOR, "tbody tr") if row.is_displayed()]
        self.assertTrue(0 < len(shown))
        self.assertTrue(all(word.lower() in row.text.lower() for row in shown))
        field.send_keys(" nothing-has-this-word")
        self.assertEqual([row for row in table.find_elements(By.CSS_SELECTOR, "tbody tr") if row.is_displayed()], [])
        self.assertEqual(region.find_element(By.XPATH, "preceding-sibling::p[1]//output").text, f"0 of {rows} rows")
        field.clear()
        field.send_keys(" ")
        self.assertTrue(all(row.is_displayed() for row in table.find_elements(By.CSS_SELECTOR, "tbody tr")))

    def test_a_section_folds(self):
        button = self.all("h2 button")[0]
        body = self.driver.find_element(By.ID, button.get_attribute("aria-controls"))
        inside = body.find_element(By.TAG_NAME, "p")
        for expanded in ("true", "false", "true"):
            self.assertEqual((button.get_attribute("aria-expanded"), self.seen(inside)), (expanded, expanded == "true"))
            button.click()

    def test_a_figure_is_enlarged_and_its_text_is_text(self):
        self.assertGreater(len(self.all("figure svg text")), 100)
        button = self.all("figure button")[0]
        button.click()
        drawing = self.all("dialog svg")[0]
        width = drawing.rect["width"]
        self.all("dialog button[data-factor]")[0].click()
        self.assertAlmostEqual(drawing.rect["width"] / width, 1.5, delta=0.05)  # but for a scroll bar
        self.press("+")
        self.assertAlmostEqual(drawing.rect["width"] / width, 2.25, delta=0.08)
        self.press(Keys.ESCAPE)
        self.assertFalse(self.all("dialog")[0].is_displayed())
        self.assertEqual(self.run_js("return document.activeElement"), button)

    def test_the_contents_stay_in_sight(self):
        for width in (1300, 400):
            self.screen(width, "light")
            self.run_js("scrollTo(0, document.body.scrollHeight / 2)")
            top = self.run_js("return document.querySelector('nav').getBoundingClientRect().top")
            self.assertTrue(-1 <= top <= 1, (width, top))

    def test_nothing_is_wider_than_a_narrow_window(self):
        for width in (400, 800, 1300):
            self.screen(width, "light")
            self.run_js("foldAll(false)")
            self.assertLessEqual(self.run_js("return document.documentElement.scrollWidth - document.documentElement.clientWidth"), 0, width)

    def luminance(self, selector, name):
        colour = self.run_js("return getComputedStyle(document.querySelector(arguments[0]))[arguments[1]]", selector, name)
        red, green, blue = (int(part) for part in re.findall(r"\d+", colour)[:3])
        return (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255

    def test_dark_is_dark_and_figures_follow(self):
        self.assertGreater(self.luminance("body", "backgroundColor"), 0.9)
        self.assertLess(self.luminance("body", "color"), 0.2)
        self.assertEqual(self.run_js("return getComputedStyle(document.querySelector('figure svg')).filter"), "none")
        self.screen(1300, "dark")
        self.assertLess(self.luminance("body", "backgroundColor"), 0.2)
        self.assertGreater(self.luminance("body", "color"), 0.8)
        self.assertIn("invert", self.run_js("return getComputedStyle(document.querySelector('figure svg')).filter"))

    def test_the_keyboard_reaches_and_works_every_control(self):
        self.press(Keys.TAB)
        self.assertEqual(self.run_js("return document.activeElement.className"), "skip")
        self.press(Keys.ENTER)
        self.assertEqual(self.wait(lambda: self.run_js("return document.activeElement.id")), "answers")
        unreachable = self.run_js(
            "return [...document.querySelectorAll('button, input, summary, .wide, a')].filter(e => e.tabIndex < 0).length")
        self.assertEqual(unreachable, 0)
        head = self.table(4).find_element(By.CSS_SELECTOR, "th")
        self.run_js("arguments[0].querySelector('button').focus()", head)
        self.press(Keys.SPACE)
        self.assertEqual(head.get_attribute("aria-sort"), "ascending")
        fold = self.all("h2 button")[0]
        self.run_js("arguments[0].focus()", fold)
        self.press(Keys.ENTER)
        self.assertEqual(fold.get_attribute("aria-expanded"), "false")
        self.assertNotEqual(self.run_js("return getComputedStyle(document.activeElement).outlineStyle"), "none")

    def test_what_a_screen_reader_is_told(self):
        nodes = self.driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
        said = {}
        for node in nodes:
            if not node["ignored"]:
                said.setdefault(node["role"]["value"], []).append(node.get("name", {}).get("value", ""))
        for role in ("main", "navigation", "heading", "button", "table", "columnheader", "searchbox"):
            self.assertTrue(said.get(role), role)
        for role in ("heading", "button", "searchbox", "link", "image"):
            self.assertTrue(all(name.strip() for name in said.get(role, [])), role)
        self.assertEqual(len(said["image"]), len(self.all("figure svg, figure img")))
        levels = self.run_js("return [...document.querySelectorAll('h1, h2, h3, h4')].map(h => Number(h.tagName[1]))")
        self.assertEqual(len(said["heading"]), len(levels))
        self.assertTrue(all(after <= before + 1 for before, after in zip([0, *levels], levels)), levels)

    def test_without_script_everything_is_in_sight(self):
        self.driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
        self.addCleanup(lambda: self.driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False}))
        self.driver.get(self.path.as_uri())
        self.assertEqual(self.all("main [hidden]"), [])
        self.assertGreater(len(self.all("main section > div")), len(sections.SECTIONS))


if __name__ == "__main__":
    if len(sys.argv) > 1 and Path(sys.argv[1]).is_dir():
        Page.results = Path(sys.argv.pop(1))
    unittest.main()
