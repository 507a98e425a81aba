"""Pictures of symbolic meshes for labelling, reports, thumbnails, terminals: rays and arithmetic, without a display."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "camera": "VIEWS Up View",
        "canvas": "check_picture_path encode_png make_contact_sheet to_data_url write_picture write_png",
        "colors": (
            "DIFFERENCE_COLORS SELECTED UNLABELLED UNSURE ColorBy LabelLook color_hulls label_color label_colors "
            "look_of"
        ),
        "comparison": "LengthUnit compare draw_before_after draw_changes draw_difference draw_heat_map draw_volumes",
        "id_buffer": "ThumbnailPixels render_revealing render_thumbnail",
        "labeling.picture": "LabelingPicture",
        "labeling.series": "draw_labeling_pictures",
        "picture": "render up_axis",
        "scene": "RenderMesh to_render_mesh",
    },
)
