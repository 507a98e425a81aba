"""`python -m meshforge`: the command line."""

from meshforge.cli import main

if __name__ == "__main__":
    main()
