"""Labels out of files: labels files, segmented points, and what a dataset says of its links."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.labels.from_files.label_by_files import label_from_files, propose_from_files
    from meshforge.labels.from_files.read import LabelFileOptions
else:
    __getattr__ = export_lazily(__name__)

__all__ = ["LabelFileOptions", "label_from_files", "propose_from_files"]
