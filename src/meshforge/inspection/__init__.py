"""Looking at one asset, given as a mesh or as a file: checks, pictures, and the difference that an edit made."""

from meshforge.inspection.decomposition import advise_decomposition
from meshforge.inspection.difference import Difference, diff
from meshforge.inspection.look import check, render

__all__ = ["Difference", "advise_decomposition", "check", "diff", "render"]
