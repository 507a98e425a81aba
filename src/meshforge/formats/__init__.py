"""Files: a reader and a writer for each format, and the door to them all."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.formats.base import Collision, Format, Loss, Mass, Output, ReadOptions
    from meshforge.formats.convert_asset import convert, to_mjspec
    from meshforge.formats.decompose_mesh import DecomposeBy, decompose, label_surface, read_surface
    from meshforge.formats.engine_names.conventions import EngineName, MarkName
    from meshforge.formats.mesh_reader import read_triangles, split_into_pieces
    from meshforge.formats.meshfile.surface import RawSurface
    from meshforge.formats.mjcf.trial import MujocoTrial, try_in_mujoco
    from meshforge.formats.output_tree import SaveResult, output_path_of, save
    from meshforge.formats.plain.obj_text import format_obj
    from meshforge.formats.plain.parts import MeshPart
    from meshforge.formats.registry import (
        FORMATS,
        MARKED_FORMATS,
        MESH_SUFFIXES,
        NO_GEOMETRY,
        PLUGIN_FORMATS,
        SUFFIXES,
        Source,
        all_suffixes,
        format_for,
        format_of,
        format_with_names,
        is_asset,
        is_description,
        labels_beside,
        load,
        load_many,
        notes_after,
        path_of,
        plugin_of_suffix,
        read,
        resolve_asset_path,
        to_mesh,
    )
    from meshforge.formats.segmentation.alignment import PointAlignment, align_points
    from meshforge.formats.segmentation.parts import SegmentationFile, read_parts
    from meshforge.formats.segmentation.reader import POINTS_SUFFIXES, points_beside, read_segmentation
    from meshforge.formats.surface_parts import plain_part_name
    from meshforge.formats.trimesh_meshes import from_trimesh
    from meshforge.formats.visuals import VisualSurfaces
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "FORMATS",
    "MARKED_FORMATS",
    "MESH_SUFFIXES",
    "NO_GEOMETRY",
    "PLUGIN_FORMATS",
    "POINTS_SUFFIXES",
    "SUFFIXES",
    "Collision",
    "DecomposeBy",
    "EngineName",
    "Format",
    "Loss",
    "MarkName",
    "Mass",
    "MeshPart",
    "MujocoTrial",
    "Output",
    "PointAlignment",
    "RawSurface",
    "ReadOptions",
    "SaveResult",
    "SegmentationFile",
    "Source",
    "VisualSurfaces",
    "align_points",
    "all_suffixes",
    "convert",
    "decompose",
    "format_for",
    "format_obj",
    "format_of",
    "format_with_names",
    "from_trimesh",
    "is_asset",
    "is_description",
    "label_surface",
    "labels_beside",
    "load",
    "load_many",
    "notes_after",
    "output_path_of",
    "path_of",
    "plain_part_name",
    "plugin_of_suffix",
    "points_beside",
    "read",
    "read_parts",
    "read_segmentation",
    "read_surface",
    "read_triangles",
    "resolve_asset_path",
    "save",
    "split_into_pieces",
    "to_mesh",
    "to_mjspec",
    "try_in_mujoco",
]
