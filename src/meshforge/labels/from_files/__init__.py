"""Labels out of files: labels files, segmented points, and what a dataset says of its links."""

from __future__ import annotations

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "label_by_files": "label_from_files propose_from_files",
        "read": "LabelFileOptions",
    },
)
