"""The report's page in a headless browser, for its tests."""

import tempfile
import unittest
from pathlib import Path
from unittest import mock

import report
from common import FIGURES
from sample import write_all

import make

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys  # noqa: F401  (tests take it from here)
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    webdriver = By = Keys = None

DRIVER = Path("/usr/bin/chromedriver")


def write_results(directory):
    """Made-up results with a few of their figures, the map with a bitmap in it among them."""
    write_all(directory)
    for entry in FIGURES:
        if entry.name == "answer" or entry.experiment == "outer_convergence":
            make.draw(entry, directory)


def browser():
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1300,900"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options, service=Service(str(DRIVER)))


@unittest.skipUnless(webdriver and DRIVER.exists(), "chromium-driver or python3-selenium is not installed")
class BrowserTest(unittest.TestCase):
    results = None  # a result folder with a report; None: one of made-up results is written

    @classmethod
    def setUpClass(cls):
        cls.directory = cls.results
        if cls.results is None:
            folder = tempfile.TemporaryDirectory()
            cls.addClassCleanup(folder.cleanup)
            cls.directory = Path(folder.name)
            with mock.patch.object(report, "write_pdf"), mock.patch("sys.stdout"), mock.patch("sys.stderr"):
                write_results(cls.directory)
                report.main(cls.directory)
        cls.path = cls.directory.resolve() / "report.html"
        cls.driver = browser()
        cls.addClassCleanup(cls.driver.quit)

    def setUp(self):
        self.screen(1300, "light")
        self.driver.get("about:blank")
        self.driver.get(self.path.as_uri())
        self.addCleanup(lambda: self.assertEqual(self.driver.get_log("browser"), []))

    def screen(self, width, colours):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": colours}]})

    def run_js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def press(self, *keys):
        webdriver.ActionChains(self.driver).send_keys(*keys).perform()

    def wait(self, condition):
        return WebDriverWait(self.driver, 10).until(lambda _: condition())

    def seen(self, element):
        return self.run_js("return arguments[0].checkVisibility()", element)

    def table(self, rows, holding=""):
        """A table of at least so many rows with such a text, in sight."""
        found = self.run_js("return [...document.querySelectorAll('table')].find(t => t.tBodies[0].rows.length >= arguments[0] && "
                            "t.tBodies[0].textContent.match(arguments[1]))", rows, holding)
        self.run_js("for (let d = arguments[0].closest('details'); d; d = d.parentElement.closest('details')) d.open = true; "
                    "document.querySelectorAll('h2 button[aria-expanded=false]').forEach(b => b.click()); "
                    "arguments[0].scrollIntoView()", found)
        return found

    def column(self, table, index):
        return self.run_js("return [...arguments[0].tBodies[0].rows].map(r => r.cells[arguments[1]].textContent.trim())", table, index)
