"""Pure shapes: hulls, native primitives, poses, and what can be measured and made of them."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "arrays": "Aabb Bools Floats Ints bounds distinct freeze_floats freeze_ints nearest_on_triangles",
        "connectivity": "component_roots components_by_vertices weld",
        "convex": "FLATNESS convex_hull measure_extents principal_extents spans_volume",
        "decomposition.by_parts": "decompose_by_parts",
        "decomposition.engines": "CoacdSettings DecomposeSettings EngineControl HullSettings VhacdSettings",
        "decomposition.fine": "FINE_SETTINGS PieceEngine decompose_finely",
        "decomposition.parts": "SurfaceParts stack_parts",
        "decomposition.regions": "FinePiece",
        "decomposition.run": "cache_folder decompose",
        "decomposition.triangles": "is_line is_sheet sheet_hulls volume_inside",
        "fill": "aabb_box aabb_capsule aabb_cylinder aabb_sphere longest_axis map_to_box shape_of_radius",
        "fit": "tight_box tight_capsule tight_cylinder",
        "inner_shapes": "inscribe shrink",
        "native": "find_cylinder_axis native_capsule native_cylinder native_sphere",
        "piece_groups": "merge_pieces",
        "pieces": "Piece hull_mesh split_pieces",
        "pose": (
            "Pose nearest_aligned_rotation nearest_aligned_rotation_between rotation_about rotation_of_quaternion "
            "smallest_rotation snap_rotation"
        ),
        "proximity": "close_pairs distance",
        "round_shapes": "Capsule Cylinder Ellipsoid Sphere",
        "shape": "Box Polytope Shape digest is_same_shape split_scaled_rotation",
        "simplify": "Enclosure HullBudget enclose",
        "solidity": "HullFault describe_fault find_fault",
        "solids": "combine_inertias cut inertia overlap_volume principal_axes volume_of_union",
        "surface": (
            "LEVEL heights_above is_closed is_convex is_convex_hull is_outward neighbour_faces normals_of "
            "planes_of polygon_sizes rises_above sample_surface"
        ),
    },
)
