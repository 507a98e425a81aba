"""Space in cells: what surfaces and hulls take up, and what can be reached from outside."""

from meshforge.checks.space.blocks import blocks
from meshforge.checks.space.grid import CELLS, Grid, Mask, grid_around
from meshforge.checks.space.reach import pockets, reached
from meshforge.checks.space.sampling import Samples, samples_of
from meshforge.checks.space.taken import crossed, filled

__all__ = [
    "CELLS",
    "Grid",
    "Mask",
    "Samples",
    "blocks",
    "crossed",
    "filled",
    "grid_around",
    "pockets",
    "reached",
    "samples_of",
]
