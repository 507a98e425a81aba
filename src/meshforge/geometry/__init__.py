"""Pure shapes: hulls, native primitives, poses, and what can be measured and made of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.geometry.arrays import (
        Aabb,
        Bools,
        Floats,
        Ints,
        bounds,
        freeze_floats,
        freeze_ints,
        nearest_on_triangles,
    )
    from meshforge.geometry.connectivity import component_roots, components_by_vertices, weld
    from meshforge.geometry.convex import FLATNESS, convex_hull, measure_extents, principal_extents, spans_volume
    from meshforge.geometry.decomposition.by_parts import decompose_by_parts
    from meshforge.geometry.decomposition.engines import (
        CoacdSettings,
        DecomposeSettings,
        EngineControl,
        HullSettings,
        VhacdSettings,
    )
    from meshforge.geometry.decomposition.fine import FINE_SETTINGS, PieceEngine, decompose_finely
    from meshforge.geometry.decomposition.parts import SurfaceParts, separate_parts, stack_parts
    from meshforge.geometry.decomposition.regions import FinePiece
    from meshforge.geometry.decomposition.run import cache_folder, decompose
    from meshforge.geometry.decomposition.triangles import is_line, is_sheet, sheet_hulls, volume_inside
    from meshforge.geometry.division import HullPart, divide
    from meshforge.geometry.faults import HullFault, describe_fault, find_fault
    from meshforge.geometry.fill import (
        aabb_box,
        aabb_capsule,
        aabb_cylinder,
        aabb_sphere,
        longest_axis,
        map_to_box,
        shape_of_radius,
    )
    from meshforge.geometry.fit import tight_box, tight_capsule, tight_cylinder
    from meshforge.geometry.inner_shapes import inscribe, shrink
    from meshforge.geometry.native import find_cylinder_axis, native_capsule, native_cylinder, native_sphere
    from meshforge.geometry.piece_groups import merge_pieces
    from meshforge.geometry.pieces import Piece, hull_mesh, split_pieces
    from meshforge.geometry.pose import (
        Pose,
        nearest_aligned_rotation,
        nearest_aligned_rotation_between,
        rotation_about,
        rotation_of_quaternion,
        smallest_rotation,
        snap_rotation,
    )
    from meshforge.geometry.proximity import close_pairs, distance
    from meshforge.geometry.round_shapes import Capsule, Cylinder, Ellipsoid, Sphere
    from meshforge.geometry.shape import Box, Polytope, Shape, digest, is_same_shape
    from meshforge.geometry.simplify import Enclosure, HullBudget, enclose
    from meshforge.geometry.solids import cut, inertia, overlap_volume, partition, principal_axes, volume_of_union
    from meshforge.geometry.surface import (
        LEVEL,
        heights_above,
        is_closed,
        is_convex,
        is_convex_hull,
        is_outward,
        neighbour_faces,
        normals_of,
        planes_of,
        polygon_sizes,
        rises_above,
        sample_surface,
    )
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "FINE_SETTINGS",
    "FLATNESS",
    "LEVEL",
    "Aabb",
    "Bools",
    "Box",
    "Capsule",
    "CoacdSettings",
    "Cylinder",
    "DecomposeSettings",
    "Ellipsoid",
    "Enclosure",
    "EngineControl",
    "FinePiece",
    "Floats",
    "HullBudget",
    "HullFault",
    "HullPart",
    "HullSettings",
    "Ints",
    "Piece",
    "PieceEngine",
    "Polytope",
    "Pose",
    "Shape",
    "Sphere",
    "SurfaceParts",
    "VhacdSettings",
    "aabb_box",
    "aabb_capsule",
    "aabb_cylinder",
    "aabb_sphere",
    "bounds",
    "cache_folder",
    "close_pairs",
    "component_roots",
    "components_by_vertices",
    "convex_hull",
    "cut",
    "decompose",
    "decompose_by_parts",
    "decompose_finely",
    "describe_fault",
    "digest",
    "distance",
    "divide",
    "enclose",
    "find_cylinder_axis",
    "find_fault",
    "freeze_floats",
    "freeze_ints",
    "heights_above",
    "hull_mesh",
    "inertia",
    "inscribe",
    "is_closed",
    "is_convex",
    "is_convex_hull",
    "is_line",
    "is_outward",
    "is_same_shape",
    "is_sheet",
    "longest_axis",
    "map_to_box",
    "measure_extents",
    "merge_pieces",
    "native_capsule",
    "native_cylinder",
    "native_sphere",
    "nearest_aligned_rotation",
    "nearest_aligned_rotation_between",
    "nearest_on_triangles",
    "neighbour_faces",
    "normals_of",
    "overlap_volume",
    "partition",
    "planes_of",
    "polygon_sizes",
    "principal_axes",
    "principal_extents",
    "rises_above",
    "rotation_about",
    "rotation_of_quaternion",
    "sample_surface",
    "separate_parts",
    "shape_of_radius",
    "sheet_hulls",
    "shrink",
    "smallest_rotation",
    "snap_rotation",
    "spans_volume",
    "split_pieces",
    "stack_parts",
    "tight_box",
    "tight_capsule",
    "tight_cylinder",
    "volume_inside",
    "volume_of_union",
    "weld",
]
