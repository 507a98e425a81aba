"""The command line: one file a command, thin; nothing heavy is imported before a command runs."""

from meshforge.cli.main import main

__all__ = ["main"]
