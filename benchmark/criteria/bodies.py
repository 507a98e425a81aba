"""What an edit should make: bodies of parts that are made anew or made whole, and of what is added at sites."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from manifold3d import Manifold
from trimesh.bounds import oriented_bounds

from benchmark.assets.decomposition import bounds
from benchmark.criteria.case import Case
from benchmark.criteria.fates import Fate
from meshforge.geometry import Floats
from script.samples.part import Part
from script.samples.solids import union

_MADE = ("made", "whole")


@dataclass(frozen=True, eq=False)
class Body:
    """What is to be made: of parts (by number, with their union), within an envelope."""

    fate: Fate
    parts: tuple[int, ...]
    union: Manifold
    envelope: Manifold

    def describe(self, parts: Sequence[Part]) -> str:
        return ", ".join(parts[place].name for place in self.parts) or f"what is added at {self.fate.of}"


def bodies_of(case: Case, fates: Sequence[Fate], added: Sequence[Mapping[str, Any]]) -> list[Body]:
    """The bodies of the parts, by the fate of each, then those of the sites; added: as a task says it."""
    return [*_of_parts(case.asset.parts, fates), *_of_sites(case, added)]


def _of_parts(parts: Sequence[Part], fates: Sequence[Fate]) -> Iterator[Body]:
    """Each part that is made, or several together."""
    groups: dict[tuple[Fate, int], list[int]] = {}
    for place, fate in enumerate(fates):
        if fate.fate in _MADE:
            groups.setdefault((fate, -1 if fate.together else place), []).append(place)
    for (fate, _), places in groups.items():
        body = union([parts[place].solid for place in places])
        yield Body(fate, tuple(places), body, _box(body) if fate.shape == "box" else body.hull())


def _box(body: Manifold) -> Manifold:
    """The smallest box around a body."""
    world, sides = smallest_box(np.asarray(body.to_mesh().vert_properties[:, :3], dtype=np.float64))
    return Manifold.cube(sides, center=True).transform(np.linalg.inv(world)[:3])


def smallest_box(points: Floats) -> tuple[Floats, Floats]:
    """The smallest box around points (n, 3): the transform (4, 4) that centers it, and its sides (3,) [m]."""
    world, sides = oriented_bounds(points)  # type: ignore[no-untyped-call]  # trimesh has no types
    return world, sides


def _of_sites(case: Case, added: Sequence[Mapping[str, Any]]) -> Iterator[Body]:
    low, high = bounds(case.asset.parts)
    for row in added:
        fate = Fate(row["site"], "made", excess=row.get("excess", 0.05), hulls=row.get("hulls"))
        for site in case.asset.site(row["site"]):
            ball = Manifold.sphere(row["reach"] * float(np.linalg.norm(high - low)), 24)
            yield Body(fate, (), ball.translate(site.at), ball.translate(site.at))
