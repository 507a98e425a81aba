"""glTF 2.0 and GLB: scenes with collision nodes, read, and written back with all else as it was."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.formats.gltf.create import create_for_engine, create_gltf
    from meshforge.formats.gltf.document import GltfDocument
    from meshforge.formats.gltf.edit import write_gltf
    from meshforge.formats.gltf.features import features_of
    from meshforge.formats.gltf.read import read_gltf
else:
    __getattr__ = export_lazily(__name__, __file__)

__all__ = [
    "GltfDocument",
    "create_for_engine",
    "create_gltf",
    "features_of",
    "read_gltf",
    "write_gltf",
]
