"""Runs what belongs to the page but to no run of it.

Usage: python -m benchmark.signoff before: writes `before.json` anew, from the tool as it is
"""

from __future__ import annotations

import argparse
import sys

from benchmark.signoff.before import freeze


def main(arguments: list[str] | None = None) -> int:
    """Do what is named."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.signoff")
    parser.add_argument("what", choices=["before"])
    parser.parse_args(arguments)
    freeze(lambda line: print(line, file=sys.stderr))
    return 0


if __name__ == "__main__":
    sys.exit(main())
