"""Everything that was done in the studio, kept on disk, to be undone and done again without limit."""

from meshforge.studio.history.entry import Entry
from meshforge.studio.history.history import History

__all__ = ["Entry", "History"]
