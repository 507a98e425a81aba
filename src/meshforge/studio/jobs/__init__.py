"""Long work at the desk that a page asks for: applying the program, decomposing, exporting; its door: `begin`."""

from meshforge.studio.jobs.begin import begin

__all__ = ["begin"]
