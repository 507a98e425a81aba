"""What settings of a decomposition come to, side by side: hulls, how many hold more than one part, free space."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import floor
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from meshforge import geometry
from meshforge.checks import measure_kept_space
from meshforge.common import pluralize
from meshforge.formats import DecomposeBy, SegmentationFile, decompose, label_surface, read_surface
from meshforge.geometry import CoacdSettings, DecomposeSettings, Ints, Polytope, VhacdSettings
from meshforge.symbolic import Surface, SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

THRESHOLDS = (0.05, 0.12, 0.3)
"""CoACD's thresholds that are tried: its default, and two coarser ones."""
COUNTS = (64, 24, 8)
"""V-HACD's most hulls that are tried."""
PURE = 0.9
"""A hull spans parts when no part has this share of the surface that it stands for."""

_NEAR = 0.01  # of the diagonal: how far outside a hull the surface that it stands for may be
_POINTS = 20_000
_CELL = (480, 400)  # [px] of a picture


@dataclass(frozen=True, eq=False, slots=True)
class DecompositionCandidate:
    """One setting and what it came to. setting: `threshold 0.05`; spanning: how many hulls hold more than one part,
    None where that was not judged; kept: the share of the free space that stays free, None for hardly any."""

    setting: str
    by: DecomposeBy
    mesh: SymbolicMesh
    spanning: int | None
    kept: float | None

    def to_json(self) -> dict[str, Any]:
        """Return it as JSON, without the mesh."""
        described = {"setting": self.setting, "by": self.by, "hulls": len(self.mesh.hulls)}
        notes = list(self.mesh.asset.notes) if self.mesh.asset else []
        return {**described, "spanning": self.spanning, "free_space": self.kept, "notes": notes}


@dataclass(frozen=True, eq=False, slots=True)
class DecompositionAdvice:
    """judged: by what it was judged which hulls span parts, or why not; up: the axis that points up in pictures."""

    judged: str
    results: tuple[DecompositionCandidate, ...]
    up: Literal["Y", "Z"] = "Z"

    def to_json(self) -> dict[str, Any]:
        """Return for scripts: `judged`, and `trials` in the order of the table."""
        return {"judged": self.judged, "results": [result.to_json() for result in self.results]}

    def describe(self) -> list[str]:
        """Return a table as lines of text, and by what it was judged."""
        rows = [("setting", "by", "hulls", "span parts", "free space kept")]
        for result in self.results:
            spanning = "-" if result.spanning is None else str(result.spanning)
            kept = "-" if result.kept is None else f"{floor(100 * result.kept)}%"
            rows.append((result.setting, result.by, str(len(result.mesh.hulls)), spanning, kept))
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = ["  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip() for row in rows]
        return [*lines, f"span parts: {self.judged}"]

    def draw(self) -> Image:
        """Return a picture of each, three in a row, under one camera."""
        from meshforge.rendering import make_contact_sheet, render  # lazy: a table needs no pictures

        boxes = [result.mesh.aabb for result in self.results if result.mesh.aabb]
        box = geometry.Aabb.union(boxes) if boxes else None
        pictures = [render(result.mesh, size=_CELL, legend=False, bounds=box, up=self.up) for result in self.results]
        titles = [f"{one.setting} by {one.by}: {pluralize(len(one.mesh.hulls), 'hull')}" for one in self.results]
        return make_contact_sheet(pictures, columns=len(THRESHOLDS), titles=titles)


def advise_decomposition(
    mesh: str | Path,
    settings: DecomposeSettings | None = None,
    *,
    hollow: bool = False,
    labels: SegmentationFile | None = None,
    timeout: float | None = None,
    cache: bool = True,
    progress: Callable[[str], None] = lambda _: None,
) -> DecompositionAdvice:
    """Return what three thresholds of CoACD, or most counts of V-HACD, make of a mesh file, whole and by known parts.

    settings: all else about the engine; labels: segmented points that say what the parts are, None for those
    that the file names; timeout [s]: of each decomposition. Raises AssetError, GeometryError.
    """
    path, surface = read_surface(mesh)
    notes: list[str] = []
    if labels:
        surface = label_surface(path, surface, labels, notes.append)
    regions, judged = find_regions(surface)
    by_parts: DecomposeBy = "labels" if labels else "parts"
    ways: list[DecomposeBy] = ["whole", by_parts] if surface.parts and surface.parts.is_divided else ["whole"]
    results = []
    rows = list(itertools.product(ways, _list_settings(settings or CoacdSettings())))
    for number, (by, (title, own)) in enumerate(rows, 1):
        head = f"setting {number} of {len(rows)}, {title} by {by}"
        progress(head)

        def more(text: str, head: str = head) -> None:
            progress(f"{head}: {text}")

        made = decompose(mesh, own, by=by, labels=labels, hollow=hollow, timeout=timeout, cache=cache, progress=more)
        hulls = [hull.shape for hull in made.hulls if isinstance(hull.shape, Polytope)]
        spanning = None if regions is None else 0  # by parts, each hull is made of the surface of one
        if regions is not None and by == "whole":
            spanning = int(find_spanning(surface, regions, hulls).sum())
        results.append(DecompositionCandidate(title, by, made, spanning, measure_kept_space(surface, hulls)))
    up: Literal["Y", "Z"] = "Y" if Path(mesh).suffix.lower() in (".glb", ".gltf") else "Z"
    return DecompositionAdvice("; ".join([judged, *notes]), tuple(results), up)


def _list_settings(settings: DecomposeSettings) -> list[tuple[str, DecomposeSettings]]:
    if isinstance(settings, CoacdSettings):
        return [(f"threshold {value:g}", replace(settings, threshold=value)) for value in THRESHOLDS]
    base = settings if isinstance(settings, VhacdSettings) else VhacdSettings()
    return [(f"max_convex_hulls {value}", replace(base, max_convex_hulls=value)) for value in COUNTS]


def find_regions(surface: Surface) -> tuple[Ints | None, str]:
    """Return the region (m,) of each face that a hull should not leave, and what these are; None for a single one."""
    if surface.parts and surface.parts.is_divided:
        return surface.parts.of_face, f"judged by {pluralize(len(surface.parts.numbers), 'named part')}"
    component = geometry.components_by_vertices(geometry.weld(surface.vertices)[surface.faces])
    if (count := len(np.unique(component))) > 1:
        return component, f"judged by {pluralize(count, 'connected piece')}, since no parts are named"
    return None, "not judged: one solid without named parts"


def find_spanning(surface: Surface, regions: Ints, hulls: Sequence[Polytope]) -> Any:
    """Return which hulls (k,) span regions (m,) of the faces: none has 90% of the surface that the hull stands for.

    A place on the surface counts for the hull that it is deepest in.
    """
    points, face = geometry.sample_surface(surface.vertices, surface.faces, _POINTS)
    reach = _NEAR * float(np.linalg.norm(np.ptp(points, axis=0)))
    lowest, owner = np.full(len(points), reach), np.full(len(points), -1)
    for k, hull in enumerate(hulls):
        heights = geometry.heights_above(points, hull)
        closer = heights < lowest
        lowest[closer], owner[closer] = heights[closer], k
    _, places = np.unique(regions, return_inverse=True)
    counts = np.zeros((len(hulls), int(places.max()) + 1), dtype=np.int64)
    owned = owner >= 0
    np.add.at(counts, (owner[owned], places.reshape(-1)[face[owned]]), 1)
    return counts.max(axis=1) < PURE * counts.sum(axis=1)
