"""The goal that a parallel gripper takes hold of parts."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import reduce

import numpy as np

from meshforge.checks.goals.base import Goal, GoalSubject, NotApplicableError, Part
from meshforge.checks.goals.rooms import clip_hull
from meshforge.checks.physics.scene import Failure, Place, mm
from meshforge.common import require_mujoco
from meshforge.geometry import Aabb, Floats
from meshforge.language import Extractor, ExtractorArgument, OptionArgument, QuantityArgument, WordArgument
from meshforge.symbolic import Hull

_PULLS, _GRIPS = ("back", "up"), ("any", "behind")
_OPEN = 1.4  # of what is between the fingers, how far they are open
_ROOM = 1.5  # of half the opening, that open fingers take up to each side
_SPOTS = (0.5, 0.3, 0.7)
"""Where a gripper may take a bar, along it."""
_REACH = 0.2  # of the length of a bar, half the height of fingers
_MOST_TRIED = 6
_CORE = 0.5  # of the size of a hull, within which something must be left of it
_SMALL = 0.1  # of the volume of the largest part: one that is smaller may be gone, such as a wire
_SHALLOW = 0.2  # of a bar, that fingers reach over at least


@dataclass(frozen=True, slots=True)
class Graspable(Goal):
    """Some grip of a parallel gripper on each part of a selection is free, closes, and pulls the asset along."""

    handle: Extractor = field(metadata={"argument": ExtractorArgument(), "title": "What is gripped"})
    width: float | None = field(
        default=None,
        metadata={
            "argument": OptionArgument("width", QuantityArgument("m")),
            "title": "Opening of the gripper [m]",
            "omitted": "as wide as it takes",
        },
    )
    pull: str = field(default="back", metadata={"argument": OptionArgument("pull", WordArgument(_PULLS))})
    grip: str = field(default="any", metadata={"argument": OptionArgument("grip", WordArgument(_GRIPS))})

    def find_failure(self, subject: GoalSubject) -> Failure | None:
        require_mujoco("a goal")
        from meshforge.checks.physics.gripper import try_grasp  # lazy: MuJoCo takes 0.3 s

        parts, margin = subject.select_parts(self.handle), 2 * subject.touching
        names, others = {hull.name for hull in subject.select_after(self.handle)}, subject.select_rest(self.handle)
        volumes = [sum(hull.volume for hull in part.hulls) for part in parts]
        for number, (part, volume) in enumerate(zip(parts, volumes, strict=True), 1):
            hulls, outward = part.lower_hulls(subject.hulls), part.box.center - part.turn.T @ subject.box.center
            there = [hull for hull in hulls if _is_within(hull, part)]
            if not there and volume < _SMALL * max(volumes):
                continue
            if not there:
                return Failure(f"part {number}: nothing is left where it was", tuple(hull.name for hull in part.hulls))
            bars, behind = part.hulls, self.grip == "behind"
            if behind:
                outward = find_outward(part, part.lower_hulls(others), margin)
                if not outward.any():
                    raise NotApplicableError(f"part {number} of {self.handle} is attached to nothing")
                bars = tuple(hull for hull in hulls if part.holds(hull, margin))
            known = {hull.name for hull in (*there, *(bars if behind else ()))} | names
            rest = [hull for hull in hulls if hull.name not in known]
            grips = list(find_grips(part, bars, rest, outward, self.width, margin, behind))
            if not grips:
                return Failure(f"part {number}: {self._describe_lack(part)}", tuple(hull.name for hull in part.hulls))
            first: Failure | None = None
            for grip in grips[:_MOST_TRIED]:
                why = try_grasp(subject.hulls, part.lift(grip), self.pull, subject.touching)  # type: ignore[arg-type]  # one of its words
                if why is None:
                    break
                first = first or why
            else:
                assert first
                return Failure(f"part {number}: {first.text}", first.hulls, first.objects)
        return None

    def _describe_lack(self, part: Part) -> str:
        """Why there is no grip on a part."""
        thin = float(np.sort(part.box.size)[0])
        if self.width is not None and self.width <= thin:
            return f"it is {mm(thin)} thick, and the gripper opens {mm(self.width)}"
        return "fingers cannot come to it from any side"


def _is_within(hull: Hull, part: Part) -> bool:
    """Whether a hull is in the middle of one that a part is made of."""
    reach = [(box.center, _CORE * box.size / 2) for box in (one.aabb for one in part.hulls)]
    return any(clip_hull(hull, Aabb(middle - half, middle + half)) for middle, half in reach)


def find_outward(part: Part, others: Sequence[Hull], margin: float) -> Floats:
    """Return the axis (3,) that leads away from what a part is attached to, zeros where there is nothing; margin: so
    far from it at most [m]."""
    window = Aabb(part.box.min - margin, part.box.max + margin)
    found = [box for one in others if (box := clip_hull(one, window))]
    way = sum(((part.box.center - box.center) / part.box.size * np.prod(box.size) for box in found), np.zeros(3))
    axis = int(np.abs(way).argmax())
    outward: Floats = np.eye(3)[axis] * np.sign(way[axis])
    return outward


def find_grips(
    part: Part,
    bars: Sequence[Hull],
    rest: Sequence[Hull],
    outward: Floats,
    width: float | None,
    gap: float,
    behind: bool,
) -> Iterator[Place]:
    """Yield where a gripper may take a part, in its frame, the likeliest first.

    Fingers close across the middle of the part, thin sides first, and come from outside of the asset, or from the side,
    as deep as nothing else is there. bars, rest: what is gripped, and other hulls, in the frame of the part; outward:
    (3,), away from the middle of the asset; width: of the opening [m], None for what it takes; gap: to keep from
    other hulls [m]; behind: only with one finger inside of the outermost bar.
    """
    whole = part.box
    long = int((whole.size * (outward == 0.0) if behind else whole.size).argmax())
    reach = _REACH * float(whole.size[long])
    rows = list[tuple[tuple[float, ...], Place]]()
    for order, spot in enumerate(_SPOTS[:1] if behind else _SPOTS):
        at = float(whole.min[long] + spot * whole.size[long])
        low, high = whole.min - gap, whole.max + gap
        low[long], high[long] = at - reach, at + reach
        section = slice_bounds(bars, Aabb(low, high), outward if behind else None)
        for across in (k for k in range(3) if k != long and not (behind and outward[k] == 0.0)):
            thick = float(section.size[across]) if section else np.inf
            if section is None or (width is not None and width <= thick):
                continue
            opening = _OPEN * thick if width is None else min(width, _OPEN * thick)
            for axis in (k for k in range(3) if k != across):
                for side in (1.0, -1.0):
                    inward = side * np.eye(3)[axis]
                    half = reach if axis != long else float(section.size[3 - axis - across]) / 2
                    grip = _fit_fingers(section, rest, inward, across, opening / 2, half, gap)
                    if grip:
                        is_inside = bool(inward @ outward > 0) or axis == long
                        rows.append(((is_inside, order, thick, float(inward @ outward)), grip))
    yield from (grip for _, grip in sorted(rows, key=lambda row: row[0]))


def _fit_fingers(
    section: Aabb, rest: Sequence[Hull], inward: Floats, across: int, opening: float, half: float, margin: float
) -> Place | None:
    """Where fingers take a bar that come along an axis, as deep as is free; None where they do not get over it."""
    axis = int(np.abs(inward).argmax())
    third = 3 - axis - across
    reach = np.zeros(3)
    reach[axis], reach[across], reach[third] = section.size[axis] / 2, _ROOM * opening, half
    window = Aabb(section.center - reach, section.center + reach)
    side = float(inward[axis])
    front, back = (section.min[axis], section.max[axis]) if side > 0 else (section.max[axis], section.min[axis])
    boxes = [box for one in rest if (box := clip_hull(one, window))]
    ends = [box.min[axis] if side > 0 else box.max[axis] for box in boxes]
    depth = min([side * (end - front) - margin for end in ends], default=abs(back - front))
    if depth < _SHALLOW * abs(back - front):
        return None
    at = section.center.copy()
    at[axis] = front + side * depth / 2
    closing = np.eye(3)[across]
    axes = np.stack([inward, closing, np.cross(inward, closing)], axis=1)
    return Place(at, np.array([depth / 2, opening, half]), axes)


def slice_bounds(hulls: Sequence[Hull], window: Aabb, outward: Floats | None = None) -> Aabb | None:
    """Return the box around what of hulls lies in a box, None where nothing does; outward: an axis (3,), of pieces
    along it only the outermost, the bar before an opening."""
    boxes = [box for one in hulls if (box := clip_hull(one, window))]
    if outward is None or not boxes:
        return Aabb.union(boxes) if boxes else None
    boxes.sort(key=lambda box: -max(outward @ box.min, outward @ box.max))
    return reduce(lambda one, other: Aabb.union((one, other)) if one.touches(other) else one, boxes)
