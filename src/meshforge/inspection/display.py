"""A mesh shown: as a notebook shows it, a picture beside a table of its hulls; and in the browser, in viser."""

import sys
import time
import webbrowser
from base64 import b64encode
from collections.abc import Callable, Iterator
from html import escape
from typing import Any

from meshforge.common import import_extra, pluralize
from meshforge.rendering import ColorBy, color_hulls, encode_png, render, up_axis
from meshforge.symbolic import Hull, SymbolicMesh

_SIZE = (480, 380)
_MOST_ROWS = 500
_HINT = "Click on a hull to see its name."
_HEADINGS = ("", "hull", "label", "body", "shape", "size [m]", "volume [m³]")


def to_html(mesh: SymbolicMesh) -> str:
    """Return the HTML of a mesh, in itself complete: no scripts, no files."""
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


def show(mesh: SymbolicMesh, *, port: int | None = None, browser: bool = True, wait: bool | None = None) -> Any:
    """Serve a mesh to the browser, on this machine only; see `SymbolicMesh.show`."""
    viser = import_extra("viser", "viewer", "mesh.show()")
    server = viser.ViserServer(host="127.0.0.1", port=port or 0, verbose=False)
    server.scene.set_up_direction(f"+{up_axis(mesh).lower()}")
    text = server.gui.add_markdown(_HINT)
    for hull, color in zip(mesh.hulls, color_hulls(mesh, "label" if mesh.labels else "hull").colors, strict=True):
        paint = tuple(round(255 * float(share)) for share in color)
        handle = _add(server, f"hulls/{hull.name}", hull.vertices, hull.faces, color=paint)
        handle.on_click(_describe_on_click(text, hull))
    for piece in mesh.asset.non_convex if mesh.asset else ():
        if piece.surface is not None:
            _add(server, f"non-convex/{piece.name}", piece.surface.vertices, piece.surface.faces, opacity=0.3)
    address = f"http://127.0.0.1:{server.get_port()}"
    print(f"{mesh!r} at {address}")
    if browser:
        webbrowser.open(address)
    is_interactive = hasattr(sys, "ps1") or "ipykernel" in sys.modules  # a person can type on while it is open
    if not is_interactive if wait is None else wait:
        print("Ctrl-C closes it")
        try:
            while True:
                time.sleep(1)
        except KeyboardInterrupt:
            server.stop()
    return server


def _add(server: Any, name: str, vertices: Any, faces: Any, **looks: Any) -> Any:
    return server.scene.add_mesh_simple(name, vertices, faces, flat_shading=True, side="double", **looks)


def _describe_on_click(text: Any, hull: Hull) -> Callable[[Any], None]:
    def describe(_: Any) -> None:
        text.content = f"**{hull.name}**\n\nlabel {hull.label or 'none'}, body {hull.body}, {hull.volume:.3g} m³"

    return describe
