"""Makes the files of the bundled bottles, cups and chairs again, bit for bit: `script/make-families [--check]`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable

from meshforge.samples import family_of
from meshforge.samples.families import Files
from script.families.bottles import build_bottles
from script.families.chairs import build_chairs
from script.families.cups import build_cups

BUILDERS: dict[str, Callable[[], Files]] = {"bottles": build_bottles, "chairs": build_chairs, "cups": build_cups}


def main() -> int:
    """Write the files, or with --check say which differ from those that are there."""
    parser = argparse.ArgumentParser(prog="script/make-families", description=__doc__)
    parser.add_argument("--check", action="store_true", help="compare only; exit code 1 where a file differs")
    is_check, differing = parser.parse_args().check, 0
    for name, build in BUILDERS.items():
        folder, files = family_of(name).folder, build()
        for path, content in files.items():
            target = folder / path
            if not target.exists() or target.read_bytes() != content:
                differing += 1
                print(target)
                if not is_check:
                    target.parent.mkdir(parents=True, exist_ok=True)
                    target.write_bytes(content)
    return int(is_check and differing > 0)


if __name__ == "__main__":
    sys.exit(main())
