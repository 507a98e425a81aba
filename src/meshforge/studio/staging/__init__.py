"""Assets in the midst of edits: after their own steps, with one more, after the program; and what would be selected."""

from meshforge.studio.staging.guessing import guesses
from meshforge.studio.staging.previews import preview, staged
from meshforge.studio.staging.results import result
from meshforge.studio.staging.selecting import selected

__all__ = ["guesses", "preview", "result", "selected", "staged"]
