"""Goals on things that are put somewhere: on a surface, into a room, through an opening."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from meshforge.checks.goals import rooms
from meshforge.checks.goals.base import Goal, GoalSubject, NotApplicableError, Part
from meshforge.checks.physics.scene import Failure, Place, mm
from meshforge.common import require_mujoco
from meshforge.geometry import Aabb, Box, Floats, Pose
from meshforge.language import (
    Direction,
    DirectionArgument,
    Extractor,
    ExtractorArgument,
    OptionArgument,
    QuantityArgument,
    Share,
    WordArgument,
)
from meshforge.symbolic import Hull

_SHAPES, _PROBES = ("box", "sphere", "cylinder"), ("box", "sphere")
_MIDDLE = 0.4  # of each side of a surface, that things are put within on both sides of its middle
_KEPT = 0.5  # of a room or an opening before the edit, from which on it counts as it is after it
_TALL = 0.5  # of the shorter side of a surface: what rises above it by more bounds it, such as the back of a seat
_LOW = 0.2  # of the height of a part, by which a spot may lie lower than its top


def _size(of: str) -> OptionArgument:
    return OptionArgument("size", QuantityArgument("m", of))


@dataclass(frozen=True, slots=True)
class Supports(Goal):
    """Boxes and balls that are put onto each part of a selection stay there."""

    on_level = True

    surface: Extractor = field(metadata={"argument": ExtractorArgument(), "title": "What carries"})
    size: float | Share = field(
        default=Share(0.1), metadata={"argument": _size("its shorter side"), "title": "Size of the balls"}
    )
    ignore: Extractor | None = field(
        default=None,
        metadata={
            "argument": OptionArgument("ignore", ExtractorArgument()),
            "title": "Where nothing is put",
            "omitted": "nowhere",
        },
    )

    def find_failure(self, subject: GoalSubject) -> Failure | None:
        require_mujoco("a goal")
        from meshforge.checks.physics import objects  # lazy: MuJoCo takes 0.3 s

        placed, clutter = [], subject.select_any(self.ignore)
        others = subject.select_rest(self.surface)
        for number, part in enumerate(subject.select_parts(self.surface), 1):
            box = part.box
            long, wide = box.size[:2]
            radius = _measure(self.size, float(min(long, wide))) / 2
            at = np.array([*box.center[:2], box.max[2]])
            surface = Place(at, np.array([_MIDDLE * long, _MIDDLE * wide, radius]), np.eye(3))
            there = objects.objects_on(f"surface {number}", surface)
            spots = np.array([one.spot[:2] for one in there])
            tops = rooms.measure_tops(part.hulls, spots)
            tops[np.isinf(tops) & rooms.is_over(part.hulls, spots)] = box.max[2]
            low, high = box.max[2] - _LOW * box.size[2], box.max[2] + _TALL * min(long, wide)
            obstacles = [
                *part.lower_hulls(clutter),
                *(one for one in part.lower_hulls(others) if one.aabb.max[2] > high),
            ]
            for one, top in zip(there, tops, strict=True):
                spot, half = np.array([*one.spot[:2], top]), one.shape.aabb.size / 2
                room = Aabb(spot - half * [1, 1, 0], spot + half * [1, 1, 2])
                if top >= low and not any(rooms.clip_hull(hull, room) for hull in obstacles):
                    placed.append(replace(one, spot=part.turn @ spot, axes=part.turn))
        if not placed:
            raise NotApplicableError(f"{self.surface} has no surface to put things on")
        return objects.try_support(subject.hulls, placed, subject.touching)


@dataclass(frozen=True, slots=True)
class Contains(Goal):
    """A thing that is put into each part of a selection is free there, and stays."""

    holder: Extractor = field(metadata={"argument": ExtractorArgument(), "title": "What holds"})
    shape: str = field(default="box", metadata={"argument": OptionArgument("shape", WordArgument(_SHAPES))})
    size: float | Share = field(default=Share(0.8), metadata={"argument": _size("the room"), "title": "Size"})

    def find_failure(self, subject: GoalSubject) -> Failure | None:
        require_mujoco("a goal")
        from meshforge.checks.physics import objects  # lazy: MuJoCo takes 0.3 s

        places = dict[str, Place]()
        for number, part in enumerate(subject.select_parts(self.holder), 1):
            find = partial(rooms.find_room, surfaces=part.lower(subject.surfaces))
            room = _find_place(subject, self.holder, part, find)
            if room is None:
                continue
            if too_large := _find_excess(self.size, room.size, "room", f"room {number}", part.lift(room)):
                return too_large
            half = _half_sizes(self.size, room.size)
            at = room.at + np.array([0.0, 0.0, half[2] + subject.touching - room.size[2]])
            places[f"room {number}"] = part.lift(replace(room, at=at, size=half))
        if not places:
            raise NotApplicableError(f"{self.holder} has no room that a thing could lie in")
        return objects.try_contain(subject.hulls, places, self.shape, subject.touching)  # type: ignore[arg-type]  # one of its words


@dataclass(frozen=True, slots=True)
class Passes(Goal):
    """A probe goes straight through the opening that each part of a selection leaves, and meets nothing."""

    opening: Extractor = field(metadata={"argument": ExtractorArgument(), "title": "What leaves the opening"})
    way: Direction | None = field(
        default=None, metadata={"argument": DirectionArgument(), "title": "Along", "omitted": "the largest opening"}
    )
    shape: str = field(default="box", metadata={"argument": OptionArgument("shape", WordArgument(_PROBES))})
    size: float | Share = field(default=Share(0.8), metadata={"argument": _size("the opening"), "title": "Size"})

    def find_failure(self, subject: GoalSubject) -> Failure | None:
        require_mujoco("a goal")
        from meshforge.checks.physics import objects  # lazy: MuJoCo takes 0.3 s

        ways, others = dict[str, Place](), subject.select_rest(self.opening)
        for number, part in enumerate(subject.select_parts(self.opening), 1):
            axes = range(3) if self.way is None else [int(np.abs(part.turn.T @ subject.turn_axis(self.way)).argmax())]
            ways_along = (_find_place(subject, self.opening, part, partial(rooms.find_way, axis=axis)) for axis in axes)
            found = [one for one in ways_along if one]
            if not found:
                continue
            way = max(found, key=lambda one: float(one.size[1] * one.size[2]))
            if too_large := _find_excess(self.size, way.size[1:], "opening", f"opening {number}", part.lift(way)):
                return too_large
            half = _half_sizes(self.size, way.size[1:])
            half = half if self.shape == "box" else np.full(2, half.min())
            past = subject.touching + (0.0 if self.shape == "box" else float(half.min()))
            way = replace(way, size=np.array([way.size[0], *half]))
            outward = part.box.center - part.turn.T @ subject.box.center
            ways[f"opening {number}"] = part.lift(rooms.end_inside(way, part.lower_hulls(others), outward, past))
        if not ways:
            raise NotApplicableError(f"{self.opening} leaves no opening{f' along {self.way}' if self.way else ''}")
        return objects.try_pass(subject.hulls, ways, self.shape, subject.touching)  # type: ignore[arg-type]  # one of its words


def _find_place(
    subject: GoalSubject, extractor: Extractor, part: Part, find: Callable[[Sequence[Hull]], Place | None]
) -> Place | None:
    """What `find` finds in a part: after the edit, unless that is much less than before it."""
    before, hulls = find(part.hulls), part.lower_hulls(subject.select_after(extractor))
    near = [hull for hull in hulls if part.holds(hull, subject.touching)]
    after = find(near) if near else None
    is_kept = after and (before is None or np.prod(after.size) >= _KEPT * np.prod(before.size))
    return after if is_kept else before


def _measure(size: float | Share, whole: float) -> float:
    return size.value * whole if isinstance(size, Share) else size


def _half_sizes(size: float | Share, half: Floats) -> Floats:
    """Half extents of what is tried in a room, or an opening, of some half sides."""
    return size.value * half if isinstance(size, Share) else np.full(len(half), size / 2)


def _find_excess(size: float | Share, half: Floats, what: str, name: str, place: Place) -> Failure | None:
    """The failure that a thing is larger than the room or the opening, as it is without anything in the way."""
    wanted = _half_sizes(size, half)
    if (wanted <= half).all():
        return None
    sides = " x ".join(mm(2 * one) for one in half)
    thing = Box(Pose(place.axes, place.at), np.full(3, float(wanted.max())))
    return Failure(f"{name}: the {what} is {sides}, too small for {mm(2 * thing.half[0])}", objects=(thing,))
