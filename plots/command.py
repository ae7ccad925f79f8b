"""What every script shares: its argument, its errors, and files that are written whole or not at all."""

import argparse
import os
import signal
import sys
from contextlib import contextmanager
from pathlib import Path

from reading import InputError


def command(main, text):
    """Calls `main` with the folder named on the command line; bad input is one line and exit code 2. SIGTERM ends it as an
    exception does, so that no partial file stays."""
    parser = argparse.ArgumentParser(description=text)
    parser.add_argument("directory", metavar="DIR", nargs="?", type=Path, default=Path("results"),
                        help="the result folder (default: %(default)s)")
    directory = parser.parse_args().directory
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))
    try:
        main(directory)
    except InputError as error:
        fail(error)
    except OSError as error:
        fail(f"{error.filename2 or error.filename or directory}: cannot be read or written: {error.strerror or error}")


def fail(error):
    """Ends the program as every bad input does."""
    print(f"error: {error}", file=sys.stderr)
    sys.exit(2)


@contextmanager
def replacing(path):
    """A temporary path that takes the place of `path` once it is written, and is gone if that fails."""
    partial = path.with_name(f".{path.stem}.partial{path.suffix}")
    try:
        yield partial
        os.replace(partial, path)
    finally:
        partial.unlink(missing_ok=True)
