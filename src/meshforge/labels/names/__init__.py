"""Labels read off names: by patterns, by the words in them, and by words that are nearly those of a label."""

from __future__ import annotations

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "label_by_names": "PatternPairs label_from_names propose_from_names",
    },
)
