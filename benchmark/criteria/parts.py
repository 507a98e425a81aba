"""Parts: each true part is kept as it was, is gone, is made anew or made whole; and nothing is anywhere else."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from manifold3d import Manifold

from benchmark.criteria.bodies import Body, bodies_of, smallest_box
from benchmark.criteria.case import Case
from benchmark.criteria.fates import Fate, assign
from benchmark.criteria.solid import near, solid
from meshforge.symbolic import Hull, SymbolicMesh
from script.samples.part import Part
from script.samples.solids import union

_LOST = 0.02
"""What may be missing of a hull that is kept, of its volume; and of a new hull, what may be beside all that is kept."""
_WITHIN = 0.9
"""A new hull of which more than this is in what stays is a part of that."""
_SUNK = 0.5
"""So much of a hull that is added may be in others."""
_ROUND = np.pi / 4
"""A long cylinder, so much of the smallest box around it."""
_LEFT = 0.5
"""A new hull is a part that should be gone where more than this of what it adds to all the rest is in such parts."""


def failure(case: Case, fates: Sequence[Mapping[str, Any]] = (), added: Sequence[Mapping[str, Any]] = ()) -> str | None:
    """Why a part is not what it should be, by the first fate that fits it; where none does, it is kept.

    added: new hulls around each site, not sunk in others: its name, `reach` of the diagonal of the parts, and how many
    `hulls` at most.
    """
    edit = _Edit(case, [Fate(**row) for row in fates], added)
    checks = (
        edit.check_changed,
        edit.check_kept,
        edit.check_gone,
        edit.check_presence,
        edit.check_hollow,
        edit.check_outside,
        edit.check_overlap,
        edit.check_count,
    )
    return next((why for check in checks if (why := check())), None)


@dataclass(eq=False)
class _Edit:
    """An edit, hull by hull and part by part."""

    case: Case
    wanted: Sequence[Fate]
    added: Sequence[Mapping[str, Any]]

    @cached_property
    def fates(self) -> list[Fate]:
        """The fate of each part."""
        return assign(self.case, self.wanted)

    @property
    def parts(self) -> tuple[Part, ...]:
        return self.case.asset.parts

    @cached_property
    def owner(self) -> dict[str, int]:
        """For each hull of before the number of its part."""
        before = self.case.before
        return dict(zip((hull.name for hull in before.hulls), _owners(before, self.parts), strict=True))

    @cached_property
    def same(self) -> set[str]:
        """The hulls that are as they were."""
        old = {hull.name: hull for hull in self.case.before.hulls}
        return {hull.name for hull in self.case.mesh.hulls if hull.name in old and _equal(hull, old[hull.name])}

    @cached_property
    def new(self) -> list[Hull]:
        return [hull for hull in self.case.mesh.hulls if hull.name not in self.same]

    @cached_property
    def kept(self) -> list[Hull]:
        """The hulls of before that are to stay."""
        return [hull for hull in self.case.before.hulls if self.fates[self.owner[hull.name]].fate == "kept"]

    @cached_property
    def bodies(self) -> list[Body]:
        return bodies_of(self.case, self.fates, self.added)

    @cached_property
    def placed(self) -> dict[str, int]:
        """For each new hull the number of the body that it is for, -1: it is in what stays."""
        staying = union([solid(hull) for hull in self.kept]) if self.kept else Manifold()
        return {hull.name: self._place(hull, staying) for hull in self.new}

    def _place(self, hull: Hull, staying: Manifold) -> int:
        """The body that a hull shares most with, else the nearest; of its label, or added, where there are such."""
        rows = list(enumerate(self.bodies))
        mine = [row for row in rows if row[1].parts and self.parts[row[1].parts[0]].label == hull.label]
        body = solid(hull)
        if not rows or (not mine and _common_volume(body, staying) > _WITHIN * hull.volume):
            return -1
        some = [*mine, *(row for row in rows if not row[1].parts)] or rows
        return some[_best(body, [one.envelope for _, one in some])][0]

    def check_changed(self) -> str | None:
        """Hulls of what is gone, or made of new ones, are not there as they were."""
        for name in sorted(self.same):
            part, fate = self.parts[self.owner[name]], self.fates[self.owner[name]]
            if fate.fate in ("gone", "made"):
                return f"{name} of {part.name} is as it was, {part.name} should be {fate.fate}"
        return None

    def check_kept(self) -> str | None:
        """Hulls that are kept may be others in the end, if these fill the same space."""
        for hull in self.kept:
            if hull.name not in self.same:
                left = 1 - _inside(solid(hull), self.case.mesh.hulls)
                if left > _LOST:
                    return f"{left:.0%} of {hull.name} ({hull.label}) is gone, which stays"
        return None

    def check_gone(self) -> str | None:
        """No new hull is of parts that are gone, or where only these were."""
        rows = list(zip(self.parts, self.fates, strict=True))
        gone = [part for part, fate in rows if fate.fate == "gone"]
        labels = {part.label for part in gone} - {part.label for part, fate in rows if fate.fate != "gone"}
        rest = union([*map(solid, self.kept), *(body.union for body in self.bodies)]) if gone else Manifold()
        where = union([part.solid for part in gone]) - rest if gone else Manifold()
        for hull in self.new:
            if self.placed[hull.name] >= 0 and not self.bodies[self.placed[hull.name]].parts:
                continue
            added = solid(hull) - rest
            volume = float(added.volume())
            inside = volume > _LOST * hull.volume and _common_volume(added, where) > _LEFT * volume
            if inside or hull.label in labels:
                return f"{hull.name} ({hull.label}) is where nothing should be left"
        return None

    def check_presence(self) -> str | None:
        """So much of each body is in hulls."""
        for body in self.bodies:
            if not body.parts:
                continue
            inside, fate = _inside(body.union, self.case.mesh.hulls), body.fate
            if not fate.share <= inside <= fate.most + 1e-3:
                told = f"{inside:.0%} of {body.describe(self.parts)} is in hulls"
                return f"{told}, {fate.share:.0%} to {fate.most:.0%} wanted"
        return None

    def check_hollow(self) -> str | None:
        """What is hollow is not filled by new hulls."""
        for body in self.bodies:
            if body.fate.hollow < 1 and (inside := self._share_filled(body)) > body.fate.hollow:
                return f"{inside:.0%} of {body.describe(self.parts)} is filled, {body.fate.hollow:.0%} allowed"
        return None

    def _share_filled(self, body: Body) -> float:
        """How much of the convex hull of a body that is not in any part is in new hulls."""
        hollow = body.envelope - union([part.solid for part in self.parts])
        return _inside(hollow, self.new)

    def check_outside(self) -> str | None:
        """New hulls are where something is made, or where something stays."""
        for place in sorted(set(self.placed.values())):
            mine = [hull for hull in self.new if self.placed[hull.name] == place]
            around, allowed = self._share_outside(place, mine), self.bodies[place].fate.excess if place >= 0 else _LOST
            if around > allowed:
                told = f"{mine[0].name} ({mine[0].label}) is {around:.1%} larger"
                return f"{told} than what it is for, {allowed:.1%} allowed"
        return None

    def _share_outside(self, place: int, hulls: Sequence[Hull]) -> float:
        """How much of hulls is outside of a body, of its envelope; or of all that stays, of their own volume."""
        made = union([solid(hull) for hull in hulls])
        if place >= 0:
            envelope = self.bodies[place].envelope
            return float((made - envelope).volume() / envelope.volume())
        return float((made - union([solid(hull) for hull in self.kept])).volume() / made.volume()) if self.kept else 1.0

    def check_overlap(self) -> str | None:
        """What is added is not in other hulls."""
        for hull in self.new:
            if self.placed[hull.name] >= 0 and not self.bodies[self.placed[hull.name]].parts:
                others = [h for h in self.case.mesh.hulls if self._body_of(h) != self.placed[hull.name]]
                if (inside := _inside(solid(hull), others)) > _SUNK:
                    return f"{inside:.0%} of {hull.name} ({hull.label}), which is added, is in other hulls"
        return None

    def check_count(self) -> str | None:
        """There are as many hulls of each body as there should be, of the shape that they should have."""
        for place, body in enumerate(self.bodies):
            hulls = [hull for hull in self.case.mesh.hulls if self._body_of(hull) == place]
            number = body.fate.hulls or (1 if body.fate.fate == "whole" else None)
            if number is not None and not 0 < len(hulls) <= number:
                return f"{body.describe(self.parts)} is made of {len(hulls)} hulls, {number} wanted"
            low = min(hulls, key=lambda hull: float(hull.aabb.min[2]), default=None)
            for shape, some in ((body.fate.shape, hulls), (body.fate.lowest, [low] if low else [])):
                other = next((hull for hull in some if shape and not _is(hull, shape)), None)
                if other:
                    return f"{other.name} ({other.label}) is a {other.shape.kind}, a {shape} wanted"
        return None

    def _body_of(self, hull: Hull) -> int:
        if hull.name not in self.same:
            return self.placed[hull.name]
        owner = self.owner[hull.name]
        return next((place for place, body in enumerate(self.bodies) if owner in body.parts), -1)


@lru_cache(maxsize=512)
def _owners(before: SymbolicMesh, parts: tuple[Part, ...]) -> tuple[int, ...]:
    """For each hull the part that it has most volume in, else the nearest; of those of its label where there are."""
    return tuple(_owner(hull, parts) for hull in before.hulls)


def _owner(hull: Hull, parts: Sequence[Part]) -> int:
    body = solid(hull)
    places = [k for k, part in enumerate(parts) if part.label == hull.label] or list(range(len(parts)))
    return places[_best(body, [parts[k].solid for k in places])]


def _best(body: Manifold, others: Sequence[Manifold]) -> int:
    """The number of the solid that one shares most with, else of the nearest."""
    shared = [_common_volume(body, other) for other in others]
    if max(shared) > 0:
        return int(np.argmax(shared))
    return int(np.argmin([body.min_gap(other, 10.0) for other in others]))


def _equal(one: Hull, other: Hull) -> bool:
    alike = one.shape.kind == other.shape.kind and np.array_equal(one.vertices, other.vertices)
    return one.shape is other.shape or alike


def _is(hull: Hull, shape: str) -> bool:
    """Whether a hull is a primitive of that kind; a capsule may be a polytope that fills no more of a box than it."""
    if shape != "capsule" or hull.primitive:
        return hull.shape.kind == shape
    return bool(hull.volume <= _ROUND * np.prod(smallest_box(hull.vertices)[1]))


def _common_volume(one: Manifold, other: Manifold) -> float:
    """The volume that two solids have in common [m^3]."""
    return float((one ^ other).volume()) if near(one, other) else 0.0


def _inside(body: Manifold, hulls: Sequence[Hull]) -> float:
    """The share of a solid that is in hulls."""
    here = [other for other in map(solid, hulls) if near(body, other)]
    return float((body ^ union(here)).volume() / max(body.volume(), 1e-12)) if here else 0.0
