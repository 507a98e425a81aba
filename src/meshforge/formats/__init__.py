"""Files: a reader and a writer for each format, and the door to them all."""

from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.formats.loading import NO_GEOMETRY, labels_beside, load, load_many, read
from meshforge.formats.losses import Loss
from meshforge.formats.meshfile import RawSurface
from meshforge.formats.naming import Names
from meshforge.formats.placing import placed
from meshforge.formats.plain.obj_text import parts_text as obj_parts
from meshforge.formats.plain.parts import Part
from meshforge.formats.registry import (
    DESCRIPTION_SUFFIXES,
    FORMATS,
    MESH_SUFFIXES,
    NAMED,
    SUFFIXES,
    format_for,
    format_of,
    is_asset,
    with_names,
)
from meshforge.formats.reporting import Report
from meshforge.formats.saving import Saved, save
from meshforge.formats.triangles import pieces_of, read_triangles

__all__ = [
    "DESCRIPTION_SUFFIXES",
    "FORMATS",
    "MESH_SUFFIXES",
    "NAMED",
    "NO_GEOMETRY",
    "SUFFIXES",
    "Format",
    "Loss",
    "Mass",
    "Names",
    "Output",
    "Part",
    "RawSurface",
    "ReadOptions",
    "Report",
    "Saved",
    "format_for",
    "format_of",
    "is_asset",
    "labels_beside",
    "load",
    "load_many",
    "obj_parts",
    "pieces_of",
    "placed",
    "read",
    "read_triangles",
    "save",
    "with_names",
]
