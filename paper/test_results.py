"""What is read of a folder of results."""

import tempfile
import unittest
from pathlib import Path

from results import Results

import sample


class Folder(unittest.TestCase):
    def test_the_ledger_is_no_experiment(self):
        with tempfile.TemporaryDirectory() as name:
            directory = Path(name)
            sample.write_all(directory)
            experiments = Results(directory).experiments()
            (directory / "verify").mkdir()
            (directory / "verify" / "run.json").write_text("{}", encoding="utf-8")
            self.assertEqual(Results(directory).experiments(), experiments)
