"""The text of layers: where each prim stands in it, and edits that leave all other characters alone."""

from meshforge.formats.usd.text.patch import patched
from meshforge.formats.usd.text.scan import has_comments

__all__ = ["has_comments", "patched"]
