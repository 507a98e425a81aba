"""Files: a reader and a writer for each format, and the door to them all."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "assets_with_labels": "convert labels_beside load load_many to_mesh to_mjspec",
        "base": "Collision Format Loss Mass Output ReadOptions",
        "conversion": "turn_upright",
        "engine_names": "EngineName MarkName",
        "mesh_input": "DecomposeBy decompose from_trimesh",
        "mesh_reader": "read_triangles split_into_pieces",
        "meshfile.surface": "RawSurface plain_part_name",
        "mjcf.engine": "MujocoLoad try_in_mujoco",
        "output_tree": "ONE_FILE_A_HULL SaveResult output_path_of part_meshes save",
        "plain.obj": "format_obj",
        "plain.parts": "MeshPart",
        "registry": (
            "FORMATS_BY_SUFFIX MESH_SUFFIXES NO_GEOMETRY SUFFIXES Source all_suffixes format_for format_named "
            "format_of format_with_names is_asset is_description list_formats list_marked_formats notes_after path_of "
            "plugin_of_suffix read resolve_asset_path"
        ),
        "segmentation": "POINTS_SUFFIXES AlignMode align_points points_beside read_segmentation",
        "visuals": "VisualSurfaces",
    },
)
