"""Plants faults, one at a time, and asks whether the tests notice.

`make mutants`, or mutants.py [--only GLOB]. Works on a copy of the tree in build/mutants/tree. Each fault meets its
named check first; what that does not catch meets all tests and the ledger's quick rows, a fault of Python the tests
of plots and report. Results go to build/mutants/results.csv: a run that was interrupted goes on there, and what has
been removed from it is done again. Exits with 1 if less than 95 % are caught, 2 if a fault cannot be judged.
"""

import argparse
import csv
import fnmatch
import hashlib
import subprocess
import sys
import time
import tomllib
from dataclasses import asdict, dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WORK = ROOT / "build/mutants"
TREE = WORK / "tree"
BUILD = TREE / "build/release"
BUILT = set()  # targets, of the copy as it is
LEAST_CAUGHT = 0.95
LONGEST_S = 1800  # of a check that has not been timed: all tests on a busy machine


@dataclass(frozen=True)
class Fault:
    """`old` occurs once in `file`; `check` is the one that is expected to catch `new` in its place."""

    name: str
    file: str
    old: str
    new: str
    wrong: str
    check: str
    hangs: bool = False  # a check that does not end counts as one that fails

    def digest(self):
        return hashlib.sha256("\0".join(map(str, asdict(self).values())).encode()).hexdigest()[:12]

    def rest(self):
        """What else is asked, the nearest first."""
        if not self.file.endswith(".py"):
            return ["ctest", "verify *"]
        return [f"{folder}/test_*.py" for folder in sorted(("plots", "paper"), key=lambda folder: not self.file.startswith(folder))]


@dataclass
class Result:
    name: str
    digest: str
    tree: str
    result: str  # caught, survived, error
    check: str  # which caught it, or why it could not be judged
    seconds: str


class NoAnswer(Exception):
    """A fault or a check that says nothing about the tests."""


def read_faults(path=Path(__file__).with_name("faults.toml")):
    return [Fault(**fault) for fault in tomllib.loads(path.read_text(encoding="utf-8"))["fault"]]


def apply(fault, text):
    """The text with the fault; raises NoAnswer unless there is one place for it."""
    if text.count(fault.old) != 1:
        raise NoAnswer(f"its text occurs {text.count(fault.old)} times in {fault.file}")
    return text.replace(fault.old, fault.new)


def commands_of(check):
    """What is to be built ('': nothing) and run for a check."""
    folder, _, rest = check.partition(": ")
    if check == "ctest":
        return "all", ["ctest", "--test-dir", str(BUILD), "--stop-on-failure"]
    if check.startswith("verify "):
        results = ["-o", str(WORK / "results"), "--tier", "quick"]
        return "pbdcheck", [str(BUILD / "pbdcheck"), "verify", "--only", check.removeprefix("verify "), *results]
    if rest:
        name = "".join("\\" + letter if letter in "\\,[]" else letter for letter in rest)
        return f"test_{folder}", [str(BUILD / f"tests/test_{folder}"), name]
    folder, _, rest = check.partition("/")
    pattern, _, method = rest.partition(" ")
    select = ["-k", method] if method else []
    return "", [sys.executable, "-m", "unittest", "discover", "--start-directory", folder, "-p", pattern, *select]


def build(target):
    """False if the tree does not compile."""
    if target not in BUILT:
        command = ["cmake", "--build", str(BUILD), "-j", "1", "--target", target]
        if subprocess.run(command, cwd=TREE, capture_output=True, check=False).returncode != 0:
            return False
        BUILT.add(target)
    return True


def passes(check, longest_s=LONGEST_S):
    """True, False, or "too long"; raises NoAnswer if nothing was built or nothing is of the check's name."""
    target, command = commands_of(check)
    if target and not build(target):
        raise NoAnswer(f"does not compile: {target}")
    try:
        run = subprocess.run(command, cwd=TREE, capture_output=True, text=True, timeout=longest_s, check=False)
    except subprocess.TimeoutExpired:
        return "too long"
    said = run.stdout + run.stderr
    if any(nothing in said for nothing in ("No test cases matched", "Ran 0 tests", "No tests were found")):
        raise NoAnswer(f"no such check: {check}")
    return run.returncode == 0


def put(source, text):
    source.write_text(text, encoding="utf-8")
    BUILT.clear()


def judge(fault, check, longest_s):
    """The check if it catches the fault, else ''. The copy is as it was afterwards."""
    source = TREE / fault.file
    text = source.read_text(encoding="utf-8")
    try:
        put(source, apply(fault, text))
        found = passes(check, longest_s)
    finally:
        put(source, text)
    if found == "too long" and not fault.hangs:
        raise NoAnswer(f"no answer in {longest_s:.0f} s: {check}")
    return "" if found is True else check + (" (does not end)" if found == "too long" else "")


def copy_tree():
    """Brings the copy up to date, writing what differs alone; returns a hash of what is in it."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            capture_output=True, text=True, check=True).stdout.split("\0")
    names = sorted(name for name in listed if name and (ROOT / name).is_file())
    state = hashlib.sha256()
    for name in names:
        content, copy = (ROOT / name).read_bytes(), TREE / name
        state.update(name.encode() + content)
        if not copy.is_file() or copy.read_bytes() != content:
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(content)
            copy.chmod((ROOT / name).stat().st_mode)
    for copy in TREE.rglob("*"):
        name = copy.relative_to(TREE)
        if copy.is_file() and name.parts[0] not in ("build", "results") and str(name) not in names \
                and "__pycache__" not in name.parts:
            copy.unlink()
    if not (BUILD / "build.ninja").is_file():
        subprocess.run(["cmake", "--preset", "release"], cwd=TREE, stdout=subprocess.DEVNULL, check=True)
    return state.hexdigest()[:12]


def read_results(path):
    if not path.is_file():
        return {}
    with path.open(newline="") as file:
        return {row["name"]: Result(**row) for row in csv.DictReader(file)}


def is_done(fault, results):
    done = results.get(fault.name)
    return done is not None and done.digest == fault.digest() and done.result != "error"


def write_results(path, results):
    partial = path.with_suffix(".part")
    with partial.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(Result.__dataclass_fields__))
        writer.writeheader()
        writer.writerows(asdict(result) for result in results.values())
    partial.replace(path)


class Limits(dict):
    """How long each check may take with a fault, s; a check is run without any first: one that fails then catches nothing."""

    def __missing__(self, check):
        begun = time.monotonic()
        try:
            self[check] = None if passes(check) is True else NoAnswer(f"fails without the fault: {check}")
        except NoAnswer as reason:
            self[check] = reason
        if self[check] is None:
            self[check] = 60 + 10 * (time.monotonic() - begun)
        return self[check]

    def of(self, check):
        if isinstance(self[check], NoAnswer):
            raise self[check]
        return self[check]


def examine(fault, tree, limits):
    """The result of one fault."""
    start, result, check = time.monotonic(), "survived", ""
    try:
        for asked in [fault.check, *fault.rest()]:
            found = judge(fault, asked, limits.of(asked))
            if found:
                result, check = "caught", found
                break
    except NoAnswer as reason:
        result, check = "error", str(reason)
    return Result(fault.name, fault.digest(), tree, result, check, f"{time.monotonic() - start:.0f}")


def print_table(faults, results, tree):
    for fault in faults:
        result = results[fault.name]
        print(f"{result.result:9}{fault.name:44}{result.check or 'nothing'}\n{'':9}{fault.wrong}")
    found = [results[fault.name] for fault in faults]
    count = {kind: sum(result.result == kind for result in found) for kind in ("caught", "survived", "error")}
    print(", ".join(f"{number} {kind}" for kind, number in count.items()) + f" of {len(found)} faults")
    if earlier := sum(result.tree != tree for result in found):
        print(f"{earlier} of them with sources of another state; remove their lines from results.csv to repeat them")
    return 2 if count["error"] else int(count["caught"] < LEAST_CAUGHT * len(found))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="*", metavar="GLOB", help="faults of these names")
    only = parser.parse_args().only
    faults = [fault for fault in read_faults() if fnmatch.fnmatch(fault.name, only)]
    if not faults:
        parser.error(f"--only {only}: no such fault in faults.toml")
    WORK.mkdir(parents=True, exist_ok=True)
    tree, path = copy_tree(), WORK / "results.csv"
    results, limits = read_results(path), Limits()
    left = [fault for fault in faults if not is_done(fault, results)]
    for check in sorted({fault.check for fault in left}):  # all of them at once: the tree is built once
        print(f"without a fault: {check}: {limits[check] if isinstance(limits[check], NoAnswer) else 'passes'}", flush=True)
    for number, fault in enumerate(left, 1):
        results[fault.name] = examine(fault, tree, limits)
        write_results(path, results)
        print(f"{number}/{len(left)} {fault.name}: {results[fault.name].result} {results[fault.name].check}", flush=True)
    return print_table(faults, results, tree)


if __name__ == "__main__":
    sys.exit(main())
