"""Runs what belongs to the page but to no run of it.

Usage: python -m benchmark.signoff before          writes `before.json` anew, from the tool as it is
       python -m benchmark.signoff unchanged       writes `unchanged.json` anew, from the product as it is
       python -m benchmark.signoff tune FOLDER ... measures on families to tune on, and prints what it finds
       python -m benchmark.signoff fit FOLDER ...  fits probabilities and threshold on them, and writes them
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from benchmark.report import as_text
from benchmark.signoff import before, product_before
from benchmark.signoff.conditions import ASKED, MAKE, list_tasks
from benchmark.signoff.fit import fit
from benchmark.signoff.review import run, summarize
from benchmark.study import CONDITIONS

_FREEZE = {"before": before.freeze, "unchanged": product_before.freeze}


def main(arguments: list[str] | None = None) -> int:
    """Do what is named."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.signoff")
    what = parser.add_subparsers(dest="what", required=True)
    what.add_parser("before", help="write the figures of the tool as it is into before.json")
    what.add_parser("unchanged", help="write the figures of the product as it is into unchanged.json")
    tune = what.add_parser("tune", help="measure on families to tune on")
    tune.add_argument("folder", type=Path, help=f"where `{MAKE}` wrote them")
    tune.add_argument("--task", action="append", choices=list_tasks(), metavar="NAME")
    tune.add_argument("--condition", action="append", choices=[one.name for one in ASKED], metavar="NAME")
    tune.add_argument("--few", action="store_true", help="one person")
    fitted = what.add_parser("fit", help="fit the weights of probabilities on families to tune on")
    fitted.add_argument("folder", type=Path, nargs="+", help=f"where `{MAKE}` wrote them, with one seed each")
    given = parser.parse_args(arguments)
    if given.what == "fit":
        fit([folder.resolve() for folder in given.folder], _tell)
        return 0
    if given.what in _FREEZE:
        _FREEZE[given.what](_tell)
        return 0
    conditions = [CONDITIONS[name] for name in given.condition] if given.condition else ASKED
    found = run(given.task or list_tasks(), conditions, _tell, str(given.folder.resolve()), given.few)
    print(as_text(summarize("tune", "Families to tune on", *found, before=False)))
    return 0


def _tell(line: str) -> None:
    print(line, file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
