"""Pictures of symbolic meshes for labelling, reports, thumbnails and terminals: rays and arithmetic, no display
needed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily
from meshforge.rendering.compare import (
    LengthUnit,
    compare,
    draw_before_after,
    draw_changes,
    draw_difference,
    draw_heat_map,
    draw_volumes,
    find_replaced,
)

if TYPE_CHECKING:
    from meshforge.rendering.camera import VIEWS, Up, View
    from meshforge.rendering.canvas import (
        check_picture_path,
        encode_png,
        encode_webp,
        make_contact_sheet,
        write_picture,
        write_png,
    )
    from meshforge.rendering.colors import (
        DIFFERENCE_COLORS,
        SELECTED,
        UNLABELLED,
        UNSURE,
        ColorBy,
        color_hulls,
        label_color,
        label_colors,
    )
    from meshforge.rendering.id_buffer import ThumbnailPixels, render_thumbnail, renumber
    from meshforge.rendering.labeling.picture import LabelingPicture
    from meshforge.rendering.labeling.series import draw_labeling_pictures, hull_numbers
    from meshforge.rendering.picture import render, up_axis
    from meshforge.rendering.reveal import render_division, render_revealing
    from meshforge.rendering.scene import RenderMesh, to_render_mesh
    from meshforge.rendering.turntable import draw_turn, encode_gif, list_turns, write_gif
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "DIFFERENCE_COLORS",
    "SELECTED",
    "UNLABELLED",
    "UNSURE",
    "VIEWS",
    "ColorBy",
    "LabelingPicture",
    "LengthUnit",
    "RenderMesh",
    "ThumbnailPixels",
    "Up",
    "View",
    "check_picture_path",
    "color_hulls",
    "compare",
    "draw_before_after",
    "draw_changes",
    "draw_difference",
    "draw_heat_map",
    "draw_labeling_pictures",
    "draw_turn",
    "draw_volumes",
    "encode_gif",
    "encode_png",
    "encode_webp",
    "find_replaced",
    "hull_numbers",
    "label_color",
    "label_colors",
    "list_turns",
    "make_contact_sheet",
    "render",
    "render_division",
    "render_revealing",
    "render_thumbnail",
    "renumber",
    "to_render_mesh",
    "up_axis",
    "write_gif",
    "write_picture",
    "write_png",
]
