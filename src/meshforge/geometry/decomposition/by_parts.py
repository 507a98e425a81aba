"""Convex decomposition part by part, so that no hull crosses a boundary between parts that is known."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from meshforge.common import GeometryError, join_names, pluralize
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
_LEAST_VOXELS = 10_000  # of a part, for V-HACD, unless the whole is to have fewer
_LOW, _HIGH = 0.01, 1.0  # the limits of CoACD's threshold


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

    vertices (n, 3) [m], faces (m, 3), parts: of these faces. Sizes and counts in the settings are of the whole: a part
    gets a threshold, voxels and a share of the most hulls by its size. close: see `decompose`; of a surface that is
    closed, the parts are closed in any case. Flat parts become thin sheets. A part without an area is left out.
    Raises GeometryError: nothing can be decomposed, or an engine failed on a part, which it names.
    """
    points, triangles = freeze_floats(vertices, (-1, 3)), freeze_ints(faces, (-1, 3))
    engine = settings or engines.CoacdSettings()
    whole = None if is_sheet(points[triangles].reshape(-1, 3)) else clean_triangles(points, triangles)
    close = close or (whole is not None and not whole.open_edges)
    joined = join_small_parts(points, triangles, parts, note)
    shares = _share_settings(points, triangles, joined, engine, note)
    end = None if control.timeout is None else time.monotonic() + control.timeout
    notes: dict[str, list[str]] = {}
    found: list[PartHull] = []

    def add_note(name: str, text: str) -> None:
        notes.setdefault(text, []).append(name)

    def report(title: str, text: str) -> None:
        control.progress(f"{title}: {text}")

    for number, (part, own) in enumerate(shares.items(), 1):
        name = joined.names[part]
        title = f"part {number} of {len(shares)}, {name}"
        control.progress(title)
        left = None if end is None else max(end - time.monotonic(), 0.0)
        limited = engines.EngineControl(partial(report, title), control.cancel, left)
        add = partial(add_note, name)
        run = partial(decompose, settings=own, close=close, cache=cache, note=add, control=limited)
        hulls = _decompose_part(points, triangles[joined.of_face == part], name, close, run, add)
        found += [PartHull(part, hull) for hull in hulls]
    for text, names in notes.items():
        note(f"{join_names(list(dict.fromkeys(names)), 3)}: {text}")
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


def _share_settings(
    points: Floats,
    triangles: Ints,
    parts: SurfaceParts,
    settings: engines.DecomposeSettings,
    note: Callable[[str], None],
) -> dict[int, engines.DecomposeSettings]:
    """The settings of each part, by its number, so that they mean for it what they mean for the whole."""
    numbers = parts.numbers
    if isinstance(settings, engines.HullSettings):
        return dict.fromkeys(numbers, settings)
    sizes = {k: np.ptp(points[np.unique(triangles[parts.of_face == k])], axis=0) for k in numbers}
    whole = np.ptp(points[np.unique(triangles)], axis=0)
    most = settings.max_convex_hull if isinstance(settings, engines.CoacdSettings) else settings.max_convex_hulls
    counts = _share_count(most, np.array([np.linalg.norm(sizes[k]) for k in numbers]))
    if 0 < most < len(numbers):
        note(f"{pluralize(len(numbers), 'part')} cannot share {pluralize(most, 'hull')}: each part gets one")
    return {k: scale_settings(settings, sizes[k], whole, own) for k, own in zip(numbers, counts, strict=True)}


def scale_settings(
    settings: engines.DecomposeSettings, size: Floats, whole: Floats, most: int
) -> engines.DecomposeSettings:
    """Return the settings of a part of some extents (3,) [m] of a whole of others, so that they mean for it what they
    mean for the whole; most: its share of the hulls."""
    if isinstance(settings, engines.HullSettings):
        return settings
    if isinstance(settings, engines.CoacdSettings):
        ratio = float(whole.max() / size.max()) if size.max() > 0 and not settings.real_metric else 1.0
        threshold = settings.threshold if ratio == 1.0 else float(np.clip(settings.threshold * ratio, _LOW, _HIGH))
        return replace(settings, threshold=threshold, max_convex_hull=most)
    box = float(np.prod(size) / np.prod(whole)) if np.prod(whole) > 0 else 1.0
    least = min(_LEAST_VOXELS, settings.resolution)
    voxels = int(np.clip(round(settings.resolution * box), least, settings.resolution))
    return replace(settings, resolution=voxels, max_convex_hulls=most)


def _share_count(most: int, sizes: Floats) -> list[int]:
    """How many hulls of `most` each part (k,) may have, one at least; -1, no limit, for all where `most` is that."""
    if most < 1:
        return [most] * len(sizes)
    exact = sizes / sizes.sum() * most if sizes.sum() > 0 else np.full(len(sizes), most / len(sizes))
    counts = np.maximum(np.floor(exact).astype(np.int64), 1)
    for k in np.argsort(counts - exact, kind="stable")[: max(most - int(counts.sum()), 0)]:
        counts[k] += 1
    return [int(count) for count in counts]
