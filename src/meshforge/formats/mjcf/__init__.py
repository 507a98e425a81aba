"""MJCF: the models of MuJoCo, main file and includes; read through MuJoCo itself, written back losslessly."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.formats.mjcf.create import create_mjcf
    from meshforge.formats.mjcf.document import MjcfDocument
    from meshforge.formats.mjcf.edit import write_mjcf
    from meshforge.formats.mjcf.features import features_of
    from meshforge.formats.mjcf.read import read_mjcf
    from meshforge.formats.mjcf.references import top_folder
else:
    __getattr__ = export_lazily(__name__, __file__)

__all__ = [
    "MjcfDocument",
    "create_mjcf",
    "features_of",
    "read_mjcf",
    "top_folder",
    "write_mjcf",
]
