"""Convex decomposition part by part, so that no hull crosses a boundary between parts that is known."""

from __future__ import annotations

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
    joined = join_small_parts(points, triangles, parts, note)
    run = _PartRun(engine, close or (whole is not None and not whole.open_edges), cache, control, joined)
    shares = _share_settings(points, triangles, joined, engine, note)
    found: list[PartHull] = []
    for part, own in shares.items():
        found += run.decompose(points, triangles[joined.of_face == part], part, own)
    for text, names in run.notes.items():
        note(f"{join_names(list(dict.fromkeys(names)), 3)}: {text}")
    if not found:
        raise GeometryError(f"{engine.engine} made no hull", remedy="Decompose it as a whole, or fix the mesh.")
    return found


class _PartRun:
    """What is the same for all parts; notes: of each the parts that it is about."""

    def __init__(
        self,
        settings: engines.DecomposeSettings,
        close: bool,
        cache: Path | None,
        control: engines.EngineControl,
        parts: SurfaceParts,
    ) -> None:
        self._close, self._cache, self._control, self._names = close, cache, control, parts.names
        self._count, self._done = len(parts.numbers), 0
        self._end = None if control.timeout is None else time.monotonic() + control.timeout
        self._engine = settings.engine
        self.notes: dict[str, list[str]] = {}

    def decompose(
        self, vertices: Floats, faces: Ints, part: int, settings: engines.DecomposeSettings
    ) -> list[PartHull]:
        """The hulls of one part, of faces (m, 3). Raises GeometryError that names it."""
        name = self._names[part]
        self._done += 1
        used, local = np.unique(faces, return_inverse=True)
        points, triangles = self._close_cuts(vertices[used], local.reshape(-1, 3))
        if is_line(points):
            self._note(name, "it has no area: left out")
            return []
        try:
            hulls = self._run(points, triangles, name, settings)
        except engines.DecompositionCancelledError:
            raise
        except GeometryError as error:
            raise GeometryError(error.problem, where=f"part {name}", remedy=error.remedy) from error
        return [PartHull(part, hull) for hull in _keep_within(points, hulls)]

    def _close_cuts(self, points: Floats, triangles: Ints) -> tuple[Floats, Ints]:
        """A part with the holes closed that its cut from the rest leaves, whose rims are only about planar."""
        if not self._close or is_sheet(points):
            return points, triangles
        mesh, _ = cap_holes(clean_triangles(points, triangles), ROUGH_RIM)
        return (points, triangles) if mesh.open_edges else (mesh.vertices, mesh.faces)

    def _run(self, points: Floats, triangles: Ints, name: str, settings: engines.DecomposeSettings) -> list[Polytope]:
        def run(vertices: Floats, faces: Ints) -> list[Polytope]:
            own = partial(self._note, name)
            return decompose(
                vertices, faces, settings, close=self._close, cache=self._cache, note=own, control=self._limit(name)
            )

        if is_sheet(points):
            self._note(name, "it is flat, so its hulls are thin sheets")
            return sheet_hulls(points, triangles, run, name)
        return run(points, triangles)

    def _limit(self, name: str) -> engines.EngineControl:
        """The control of one run: its progress names the part, and it ends when the time for all is up."""
        title = f"part {self._done} of {self._count}, {name}"
        left = None if self._end is None else max(self._end - time.monotonic(), 0.1)
        self._control.progress(title)
        return replace(self._control, progress=lambda text: self._control.progress(f"{title}: {text}"), timeout=left)

    def _note(self, name: str, text: str) -> None:
        self.notes.setdefault(text, []).append(name)


def _keep_within(points: Floats, hulls: list[Polytope]) -> list[Polytope]:
    """The hulls, each cut to the convex hull of points (n, 3): voxels reach over what they stand for."""
    if is_sheet(points):
        return hulls
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
