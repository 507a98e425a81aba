"""`python -m meshforge`: the command line, which as `meshforge` imports nothing from the folder it is called in."""

import sys
from os import path

if __name__ == "__main__":
    if not sys.flags.safe_path and sys.path[0] != path.dirname(path.dirname(__file__)):  # noqa: PTH120 (pathlib may lie there)
        del sys.path[0]
    from meshforge.cli import main

    main()
