"""Assets in the midst of edits: after their own steps, with one more, after the program; and what would be selected."""

from meshforge.studio.showing.staging.guessing import guesses
from meshforge.studio.showing.staging.previews import preview, staged
from meshforge.studio.showing.staging.results import result
from meshforge.studio.showing.staging.selecting import selected

__all__ = ["guesses", "preview", "result", "selected", "staged"]
