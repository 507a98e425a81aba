"""XML files that are edited in place: their text, their elements with byte offsets, and splices of it."""

from meshforge.formats.xml.numbers import numbers, shown
from meshforge.formats.xml.splice import (
    Splice,
    attribute,
    escaped,
    indent,
    newline,
    removed,
    spliced,
    without_comments,
)
from meshforge.formats.xml.text import Text, blanked
from meshforge.formats.xml.tree import Element, parsed

__all__ = [
    "Element",
    "Splice",
    "Text",
    "attribute",
    "blanked",
    "escaped",
    "indent",
    "newline",
    "numbers",
    "parsed",
    "removed",
    "shown",
    "spliced",
    "without_comments",
]
