"""Pictures of symbolic meshes for labelling, reports and terminals: rays and arithmetic, no display needed."""

from meshforge.views.camera import VIEWS, Up, View
from meshforge.views.coloring import COLOR_BY, UNSURE, ColorBy, label_colors
from meshforge.views.compare import before_after, compare, difference, joint_bounds
from meshforge.views.encode import png, webp, write_png
from meshforge.views.heat import heat
from meshforge.views.labelling import Shot, numbers, shots
from meshforge.views.palette import DIFFERENCE_COLORS, LABEL_COLORS, SELECTED, UNLABELLED, label_color
from meshforge.views.picture import render
from meshforge.views.roundness import Skin, skin
from meshforge.views.sheet import sheet
from meshforge.views.thumbnail import thumbnail
from meshforge.views.visibility import id_buffer, visible_hulls
from meshforge.views.volumes import volumes

__all__ = [
    "COLOR_BY",
    "DIFFERENCE_COLORS",
    "LABEL_COLORS",
    "SELECTED",
    "UNLABELLED",
    "UNSURE",
    "VIEWS",
    "ColorBy",
    "Shot",
    "Skin",
    "Up",
    "View",
    "before_after",
    "compare",
    "difference",
    "heat",
    "id_buffer",
    "joint_bounds",
    "label_color",
    "label_colors",
    "numbers",
    "png",
    "render",
    "sheet",
    "shots",
    "skin",
    "thumbnail",
    "visible_hulls",
    "volumes",
    "webp",
    "write_png",
]
