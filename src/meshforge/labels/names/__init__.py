"""Labels read off names: by patterns, by the words in them, and by words that are nearly those of a label."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.labels.names.label_by_names import PatternPairs, label_from_names, propose_from_names
else:
    __getattr__ = export_lazily(__name__)

__all__ = ["PatternPairs", "label_from_names", "propose_from_names"]
