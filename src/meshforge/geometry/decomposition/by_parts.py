"""Convex decomposition part by part, so that no hull crosses a boundary between parts that is known."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Floats, Ints, freeze_floats, freeze_ints
from meshforge.geometry.convex import convex_hull
from meshforge.geometry.decomposition import engines
from meshforge.geometry.decomposition.parts import SurfaceParts, join_small_parts
from meshforge.geometry.decomposition.run import UNCONTROLLED, decompose
from meshforge.geometry.decomposition.triangles import (
    ROUGH_RIM,
    cap_holes,
    clean_triangles,
    is_line,
    is_sheet,
    sheet_hulls,
)
from meshforge.geometry.shape import Polytope
from meshforge.geometry.solids import intersect
from meshforge.geometry.surface import rises_above

_WITHIN = 1e-6  # of the size: a hull that rises above the hull of its part by less is within it


@dataclass(frozen=True, eq=False, slots=True)
class PartHull:
    """A convex hull, and the number of the part that it stands for, in the names of `SurfaceParts`."""

    part: int
    hull: Polytope


def decompose_by_parts(
    vertices: Any,
    faces: Any,
    parts: SurfaceParts,
    settings: engines.DecomposeSettings | None = None,
    *,
    close: bool = False,
    cache: Path | None = None,
    note: Callable[[str], None] = lambda _: None,
    control: engines.EngineControl = UNCONTROLLED,
) -> list[PartHull]:
    """Return convex hulls of a surface, each within the convex hull of its part; those of a part follow each other.

    vertices (n, 3) [m], faces (m, 3), parts: of these faces; settings: of each part, as if it were alone. close: see
    `decompose`; of a surface that is closed, the parts are closed in any case. Flat parts become thin sheets. A part
    without an area is left out. Raises GeometryError: nothing can be decomposed, or an engine failed on a part, which
    it names.
    """
    points, triangles = freeze_floats(vertices, (-1, 3)), freeze_ints(faces, (-1, 3))
    engine = settings or engines.CoacdSettings()
    whole = None if is_sheet(points[triangles].reshape(-1, 3)) else clean_triangles(points, triangles)
    close = close or (whole is not None and not whole.open_edges)
    joined = join_small_parts(points, triangles, parts, note)
    end = None if control.timeout is None else time.monotonic() + control.timeout
    found: list[PartHull] = []

    def report(title: str, text: str) -> None:
        control.progress(f"{title}: {text}")

    def add_note(name: str, text: str) -> None:
        note(f"{name}: {text}")

    for number, part in enumerate(joined.numbers, 1):
        name = joined.names[part]
        title = f"part {number} of {len(joined.numbers)}, {name}"
        control.progress(title)
        left = None if end is None else max(end - time.monotonic(), 0.0)
        limited = engines.EngineControl(partial(report, title), control.cancel, left)
        add = partial(add_note, name)
        run = partial(decompose, settings=engine, close=close, cache=cache, note=add, control=limited)
        hulls = _decompose_part(points, triangles[joined.of_face == part], name, close, run, add)
        found += [PartHull(part, hull) for hull in hulls]
    if not found:
        raise GeometryError(f"{engine.engine} made no hull", remedy="Decompose it as a whole, or fix the mesh.")
    return found


def _decompose_part(
    vertices: Floats,
    faces: Ints,
    name: str,
    close: bool,
    run: Callable[[Floats, Ints], list[Polytope]],
    note: Callable[[str], None],
) -> list[Polytope]:
    """The hulls of one part, of faces (m, 3); run: makes those of a solid. Raises GeometryError that names the part.

    The holes are closed that its cut from the rest leaves, whose rims are only about planar.
    """
    used, local = np.unique(faces, return_inverse=True)
    points, triangles = vertices[used], local.reshape(-1, 3)
    if is_line(points):
        note("it has no area: left out")
        return []
    try:
        if is_sheet(points):
            note("it is flat, so its hulls are thin sheets")
            return sheet_hulls(points, triangles, run, name)
        if close:
            mesh, _ = cap_holes(clean_triangles(points, triangles), ROUGH_RIM)
            points, triangles = (points, triangles) if mesh.open_edges else (mesh.vertices, mesh.faces)
        return _keep_within(points, run(points, triangles))
    except engines.DecompositionCancelledError:
        raise
    except GeometryError as error:
        raise GeometryError(error.problem, where=f"part {name}", remedy=error.remedy) from error


def _keep_within(points: Floats, hulls: list[Polytope]) -> list[Polytope]:
    """The hulls, each cut to the convex hull of points (n, 3): voxels reach over what they stand for."""
    around = convex_hull(points)
    height = _WITHIN * float(np.ptp(points, axis=0).max())
    kept: list[Polytope] = []
    for hull in hulls:
        if rises_above(hull.vertices, around.vertices, around.faces, height):
            inside = intersect(hull, around)
            kept += [inside] if inside else []
        else:
            kept.append(hull)
    return kept or [around]
