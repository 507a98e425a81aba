"""The viewer in the browser: the hulls of a mesh in viser, each to be clicked."""

from __future__ import annotations

import sys
import time
import webbrowser
from collections.abc import Callable
from typing import Any

from meshforge.common import import_extra
from meshforge.rendering import color_hulls, up_axis
from meshforge.symbolic import Hull, SymbolicMesh

_HINT = "Click on a hull to see its name."


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
    if not _is_interactive() if wait is None else wait:
        _wait(server)
    return server


def _add(server: Any, name: str, vertices: Any, faces: Any, **looks: Any) -> Any:
    return server.scene.add_mesh_simple(name, vertices, faces, flat_shading=True, side="double", **looks)


def _describe_on_click(text: Any, hull: Hull) -> Callable[[Any], None]:
    def describe(_: Any) -> None:
        text.content = f"**{hull.name}**\n\nlabel {hull.label or 'none'}, body {hull.body}, {hull.volume:.3g} m³"

    return describe


def _is_interactive() -> bool:
    """Whether a person can type on while the viewer is open: in a notebook, or at Python's prompt."""
    return hasattr(sys, "ps1") or "ipykernel" in sys.modules


def _wait(server: Any) -> None:
    print("Ctrl-C closes it")
    try:
        while True:
            time.sleep(1)
    except KeyboardInterrupt:
        server.stop()
