"""`python -m meshforge`: the command line."""

from __future__ import annotations

from meshforge.cli import main

if __name__ == "__main__":
    main()
