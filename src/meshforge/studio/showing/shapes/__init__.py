"""Assets and their triangles, as the page shows them."""

from meshforge.studio.showing.shapes.asset import asset_view
from meshforge.studio.showing.shapes.hulls import contact_names, hull_view, hull_views
from meshforge.studio.showing.shapes.packet import asset_packet, framed, hull_rows, shapes_packet, visual_packet
from meshforge.studio.showing.shapes.upright import Z_FROM_Y, Upright, numbers, stands_on_y, upright

__all__ = [
    "Z_FROM_Y",
    "Upright",
    "asset_packet",
    "asset_view",
    "contact_names",
    "framed",
    "hull_rows",
    "hull_view",
    "hull_views",
    "numbers",
    "shapes_packet",
    "stands_on_y",
    "upright",
    "visual_packet",
]
