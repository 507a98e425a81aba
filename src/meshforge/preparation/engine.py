"""Hulls of a surface by a decomposition engine: what every preparation calls, flat surfaces included."""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any

from meshforge.asset import Surface
from meshforge.geometry import Floats, Ints, Polytope
from meshforge.geometry.decompose import DecomposeSettings, decompose, is_sheet, sheet_hulls


def hulls_of(
    surface: Surface,
    settings: DecomposeSettings,
    name: str,
    *,
    hollow: bool,
    cache: Path | None,
    note: Callable[[str], None],
) -> list[Polytope]:
    """The convex hulls of a surface, in the engine's order. Raises GeometryError, about `name`.

    hollow: planar holes stay open, so that shells of one sheet are not filled.
    """

    def run(vertices: Floats, faces: Ints) -> list[Polytope]:
        return decompose(vertices, faces, settings, close=not hollow, cache=cache, note=note)

    if is_sheet(surface.vertices[surface.faces].reshape(-1, 3)):
        note("it is flat, so its hulls are thin sheets")
        return sheet_hulls(surface.vertices, surface.faces, run, name)
    return run(surface.vertices, surface.faces)


def settings_record(settings: DecomposeSettings, hollow: bool) -> dict[str, Any]:
    """The settings as a preparation keeps them."""
    return {"method": settings.engine, "hollow": hollow, **settings.as_dict()}


def software(settings: DecomposeSettings | None = None) -> dict[str, str]:
    """The versions of what makes hulls."""
    return {name: version(name) for name in ("meshforge", settings.package if settings else "manifold3d")}
