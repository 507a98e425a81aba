"""A mesh as a notebook shows it: a picture beside a table of its hulls."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator
from html import escape

from meshforge.common import pluralize
from meshforge.rendering import ColorBy, color_hulls, encode_png, render
from meshforge.symbolic import SymbolicMesh

_SIZE = (480, 380)
_MOST_ROWS = 500
_HEADINGS = ("", "hull", "label", "body", "shape", "size [m]", "volume [m³]")


def to_html(mesh: SymbolicMesh) -> str:
    """The HTML of a mesh, in itself complete: no scripts, no files."""
    color_by: ColorBy = "label" if mesh.labels else "hull"
    picture = b64encode(encode_png(render(mesh, color_by=color_by, size=_SIZE))).decode()
    name = escape(str(mesh.asset.path) if mesh.asset else "in memory")
    head = "".join(f"<th style='text-align:left'>{heading}</th>" for heading in _HEADINGS)
    rows = "".join(_list_rows(mesh, color_by))
    rest = len(mesh.hulls) - _MOST_ROWS
    more = f"<p>and {pluralize(rest, 'hull')} more</p>" if rest > 0 else ""
    return (
        f"<div><p><b>{name}</b>: {pluralize(len(mesh.hulls), 'hull')}</p>"
        "<div style='display:flex;flex-wrap:wrap;gap:1em;align-items:flex-start'>"
        f"<img alt='{escape(repr(mesh), quote=True)}' width='{_SIZE[0]}' height='{_SIZE[1]}'"
        f" src='data:image/png;base64,{picture}'>"
        f"<div style='max-height:{_SIZE[1]}px;overflow:auto'><table><thead><tr>{head}</tr></thead>"
        f"<tbody>{rows}</tbody></table>{more}</div></div></div>"
    )


def _list_rows(mesh: SymbolicMesh, color_by: ColorBy) -> Iterator[str]:
    colors = color_hulls(mesh, color_by).colors
    for hull, color in zip(mesh.hulls[:_MOST_ROWS], colors, strict=False):
        red, green, blue = (round(255 * float(share)) for share in color)
        kind = type(hull.primitive).__name__.lower() if hull.primitive else f"{len(hull.vertices)} vertices"
        size = " × ".join(f"{side:.3g}" for side in hull.aabb.size)
        cells = (hull.name, hull.label or "", hull.body, kind, size, f"{hull.volume:.3g}")
        swatch = f"<td style='background:rgb({red},{green},{blue})'>&emsp;</td>"
        yield f"<tr>{swatch}{''.join(f'<td>{escape(cell)}</td>' for cell in cells)}</tr>"
