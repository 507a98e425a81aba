"""Long work at the desk that a page asks for: applying, decomposing, exporting, getting labels; its door: `begin`."""

from meshforge.studio.jobs.begin import begin

__all__ = ["begin"]
