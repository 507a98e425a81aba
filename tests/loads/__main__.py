"""Writes assets of every format, loads them in other programs, compares the shapes, and prints a table.

python -m tests.loads [--python READER=PYTHON ...] [--only READER] [--format SUFFIX] [--keep FOLDER] [--page FILE]
Ends with 1 where a reader finds other shapes than MeshForge.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from tests.loads.asking import ask
from tests.loads.assets import SUFFIXES, Made, Refused, made, sources
from tests.loads.page import page
from tests.loads.readers import READERS
from tests.loads.rows import Row, row_of, row_of_own


def main() -> int:
    given = _arguments()
    with tempfile.TemporaryDirectory() as scratch:
        folder = given.keep or Path(scratch)
        suffixes = tuple(s for s in SUFFIXES if given.format is None or s.removeprefix(".") in given.format)
        every = list(made(folder, sources(), suffixes))
        files = [one for one in every if isinstance(one, Made)]
        rows = [row_of_own(files), *(_row(name, given.python, files) for name in given.only or READERS)]
    text = page(rows, [one for one in every if isinstance(one, Refused)])
    print(text)
    if given.page:
        given.page.write_text(text, encoding="utf-8")
    return int(any(row.differences for row in rows))


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="script/loads")
    parser.add_argument("--python", action="append", default=[], metavar="READER=PYTHON", help="that has the reader")
    parser.add_argument("--only", action="append", choices=READERS, help="this reader, or several")
    parser.add_argument("--format", action="append", help="only of this suffix, without its dot; '' is a folder")
    parser.add_argument("--keep", type=Path, help="an empty folder for the files")
    parser.add_argument("--page", type=Path, help="where to write the table, such as docs/loads.md")
    given = parser.parse_args()
    given.python = dict(one.split("=", 1) for one in given.python)
    if unknown := given.python.keys() - READERS.keys():
        parser.error(f"--python: no reader is called {min(unknown)}; there are {', '.join(READERS)}")
    return given


def _row(name: str, pythons: dict[str, str], files: list[Made]) -> Row:
    reader = READERS[name]
    own = [one for one in files if reader.grain(one.suffix) and not one.has_hidden_hulls]
    print(f"{reader.title}: {len(own)} files", file=sys.stderr, flush=True)
    return row_of(reader, own, ask(name, pythons.get(name, sys.executable), [one.path for one in own]))


if __name__ == "__main__":
    sys.exit(main())
