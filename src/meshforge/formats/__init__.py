"""Files: a reader and a writer for each format, and the door to them all."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.formats.base import Format, Loss, Mass, Output
    from meshforge.formats.engine_names.conventions import EngineName
    from meshforge.formats.mesh_reader import read_triangles, split_into_pieces
    from meshforge.formats.meshfile.surface import RawSurface
    from meshforge.formats.output_tree import SaveResult, output_path_of, save
    from meshforge.formats.plain.obj_text import format_obj
    from meshforge.formats.plain.parts import MeshPart
    from meshforge.formats.registry import (
        DESCRIPTION_SUFFIXES,
        ENGINE_FORMATS,
        FORMATS,
        MESH_SUFFIXES,
        NO_GEOMETRY,
        SUFFIXES,
        format_for,
        format_of,
        format_with_names,
        is_asset,
        labels_beside,
        load,
        load_many,
        read,
    )
    from meshforge.formats.segmentation.base import (
        POINTS_SUFFIXES,
        SEMANTICS_FILE,
        Segmentation,
        points_beside,
        read_class_names,
        read_semantics,
    )
    from meshforge.formats.segmentation.reader import attach_own_mesh, read_segmentation
    from meshforge.formats.visuals import VisualSurfaces
else:
    __getattr__ = export_lazily(__name__, __file__)

__all__ = [
    "DESCRIPTION_SUFFIXES",
    "ENGINE_FORMATS",
    "FORMATS",
    "MESH_SUFFIXES",
    "NO_GEOMETRY",
    "POINTS_SUFFIXES",
    "SEMANTICS_FILE",
    "SUFFIXES",
    "EngineName",
    "Format",
    "Loss",
    "Mass",
    "MeshPart",
    "Output",
    "RawSurface",
    "SaveResult",
    "Segmentation",
    "VisualSurfaces",
    "attach_own_mesh",
    "format_for",
    "format_obj",
    "format_of",
    "format_with_names",
    "is_asset",
    "labels_beside",
    "load",
    "load_many",
    "output_path_of",
    "points_beside",
    "read",
    "read_class_names",
    "read_segmentation",
    "read_semantics",
    "read_triangles",
    "save",
    "split_into_pieces",
]
