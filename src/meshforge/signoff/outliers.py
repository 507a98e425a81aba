"""How edits of a family differ in volume, extents, hulls and free space; and those that stand out."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from math import expm1, isfinite, log
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from meshforge.common import GeometryError
from meshforge.geometry import Aabb, Floats, Shape, convex_hull, planes_of
from meshforge.language import Misfit, MisfitKind, RuleTrace
from meshforge.symbolic import Hull, SymbolicMesh

POINTS = 2048
"""Places in the box of an asset; at those within its convex hull free space is looked at."""
_PLASTIC = 1.2207440846057596  # the root of x^4 = x + 1, whose powers spread points evenly in space (Roberts 2018)
_FLAT = 1e-12  # share of its box from which on a hull has a volume

_Mask = npt.NDArray[np.bool_]

Extents = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class EditMeasures:
    """One edit. hulls: how many; removed: the share of the hulls of before that are gone; volumes: sums over hulls,
    what overlaps counts twice [m^3]; extents: sides of the box around all hulls, in the frame of the file [m].

    Of the convex hull of all hulls before, which turns with the asset, free: the share that none of them covers;
    filled: the share of the free space that hulls cover after; freed: the share of the covered space free after.
    misfits: of primitives that it made and left.
    """

    hulls_before: int
    hulls_after: int
    removed: float
    volume_before: float
    volume_after: float
    extents_before: Extents
    extents_after: Extents
    free: float
    filled: float
    freed: float
    misfits: tuple[Misfit, ...] = ()


def measure_edit(before: SymbolicMesh, after: SymbolicMesh, *, trace: Iterable[RuleTrace] = ()) -> EditMeasures:
    """Return the measures of an edit; both meshes are in one frame, as a program leaves them; trace: of the program."""
    free, filled, freed = _compare_space(before, after)
    gone = {hull.name for hull in before.hulls} - {hull.name for hull in after.hulls}
    return EditMeasures(
        hulls_before=len(before.hulls),
        hulls_after=len(after.hulls),
        removed=len(gone) / max(len(before.hulls), 1),
        volume_before=_sum_volumes(before.hulls),
        volume_after=_sum_volumes(after.hulls),
        extents_before=_extents_of(before.aabb),
        extents_after=_extents_of(after.aabb),
        free=free,
        filled=filled,
        freed=freed,
        misfits=tuple(one for line in trace for one in line.misfits if one.kind and {*one.hulls} <= {*after.index}),
    )


def _sum_volumes(hulls: Sequence[Hull]) -> float:
    return sum((_volume_of(hull.shape) for hull in hulls), 0.0)


def _volume_of(shape: Shape) -> float:
    """The volume of a shape [m^3], 0 where it is flat, turned inside out or not finite."""
    volume = float(shape.volume)
    return volume if isfinite(volume) and volume > 0 else 0.0


def _extents_of(box: Aabb | None) -> Extents:
    x, y, z = (0.0, 0.0, 0.0) if box is None else box.size.tolist()
    return x, y, z


def _compare_space(before: SymbolicMesh, after: SymbolicMesh) -> tuple[float, float, float]:
    points = _points_within(before)
    kept = {id(hull.shape) for hull in before.hulls} & {id(hull.shape) for hull in after.hulls}
    both = _cover(points, [hull.shape for hull in before.hulls if id(hull.shape) in kept])
    was, now = (
        both | _cover(points, [hull.shape for hull in mesh.hulls if id(hull.shape) not in kept])
        for mesh in (before, after)
    )
    free = int(np.count_nonzero(~was))
    filled, freed = int(np.count_nonzero(now & ~was)), int(np.count_nonzero(was & ~now))
    return free / max(len(points), 1), filled / max(free, 1), freed / max(len(points) - free, 1)


def _points_within(mesh: SymbolicMesh) -> Floats:
    """Points (n, 3) that lie evenly within the convex hull of a mesh; none where that is flat."""
    if mesh.aabb is None:
        return np.zeros((0, 3))
    try:
        around = convex_hull(np.concatenate([hull.vertices for hull in mesh.hulls]))
    except GeometryError:
        return np.zeros((0, 3))
    points = mesh.aabb.min + _spread_points(POINTS) * mesh.aabb.size
    return points[_cover(points, [around])]


@cache
def _spread_points(count: int) -> Floats:
    """Points (count, 3) in the unit cube that lie evenly, the same each time."""
    steps = _PLASTIC ** -np.arange(1.0, 4.0)
    points: Floats = (0.5 + np.arange(1.0, count + 1)[:, None] * steps) % 1.0
    points.flags.writeable = False
    return points


def _cover(points: Floats, shapes: Sequence[Shape]) -> _Mask:
    """Which of points (n, 3) lie in any of some shapes; round ones count as their tessellations."""
    found = np.zeros(len(points), dtype=bool)
    for shape in shapes:
        box = shape.aabb
        if _volume_of(shape) <= _FLAT * float(np.prod(box.size)):
            continue
        inside = ((points >= box.min) & (points <= box.max)).all(axis=1)
        near = np.flatnonzero(inside & ~found)
        if len(near):
            planes = planes_of(shape.vertices, shape.faces)
            heights = (points[near] - planes.middle) @ planes.normals.T
            found[near] = (heights <= planes.offsets).all(axis=1)
    return found


LEAST_FAMILY = 4
"""Of fewer edits none is an outlier: nobody can say which are the odd ones."""
BLOCK, MORE = 0.5, 0.15
"""An edit that fills such a share of the free space of an asset makes one solid block of it, unless the same was shown:
then one that fills so much more than any that a person showed."""
WORSE = 1.5
"""A primitive that misfits so much more than any in results that a person accepted stands out."""
_LIMIT = 5.0  # robust z from which on an edit stands out
_DEVIATION = 1.4826  # of a normal distribution, in median absolute deviations
_LEAST_SHARE = 1e-3  # smaller shares of a volume or an extent count as this
_LEAST_FREE = 0.1  # of the box of an asset: in less free space points tell nothing

AlarmKind = Literal["deleted", "block", "volume", "extent", "hulls", "filled", "freed"] | MisfitKind


@dataclass(frozen=True, slots=True)
class Alarm:
    """Why an edit stands out. text: a sentence; excess: how far out it is, in robust deviations of its family; infinite
    for what is odd in any family.
    """

    kind: AlarmKind
    text: str
    excess: float


@dataclass(frozen=True, slots=True)
class _Figure:
    """A figure by which the edits of a family are compared.

    read: of one edit, None where it has none; show: in words; text: with a place for the edit's own; floor: the least
    deviation that is reckoned with.
    """

    kind: AlarmKind
    text: str
    floor: float
    read: Callable[[EditMeasures], float | None]
    show: Callable[[float], str]


def find_alarms(
    measures: Mapping[str, EditMeasures], shown: Iterable[EditMeasures] = ()
) -> dict[str, tuple[Alarm, ...]]:
    """Return the alarms of those edits of a family that have any, the farthest out first; measures: by asset; shown: of
    the same program on assets that a person demonstrated or accepted."""
    shown = list(shown)
    block = max([BLOCK, *(one.filled + MORE for one in shown if one.free >= _LEAST_FREE)])
    seen = [misfit for one in shown for misfit in one.misfits]
    found = {name: [*_find_absolute(one, block), *_find_misfits(one, seen)] for name, one in measures.items()}
    known = [one for name, one in measures.items() if not found[name]]
    for figure in _FIGURES:
        for name, alarm in _compare(figure, measures, known):
            found[name].append(alarm)
    return {name: tuple(sorted(alarms, key=lambda alarm: -alarm.excess)) for name, alarms in found.items() if alarms}


def describe_outliers(
    measures: Mapping[str, EditMeasures], shown: Iterable[EditMeasures] = ()
) -> dict[str, tuple[str, ...]]:
    """Return sentences on those edits of a family that stand out, the farthest out first, by asset."""
    return {name: tuple(alarm.text for alarm in alarms) for name, alarms in find_alarms(measures, shown).items()}


def _find_absolute(one: EditMeasures, block: float) -> Iterator[Alarm]:
    if one.hulls_before and not one.hulls_after:
        yield Alarm("deleted", "no hull is left", float("inf"))
    if one.free >= _LEAST_FREE and one.filled >= block:
        yield Alarm("block", f"nearly one solid block: {one.filled:.0%} of the free space is filled", float("inf"))


def _find_misfits(one: EditMeasures, seen: Sequence[Misfit]) -> Iterator[Alarm]:
    """The worst misfit of each kind, where it is much worse than those that were seen."""
    for kind in get_args(MisfitKind):
        known = max((misfit.share for misfit in seen if misfit.kind == kind), default=0.0)
        own = [misfit for misfit in one.misfits if misfit.kind == kind and misfit.share > WORSE * known]
        if own:
            yield Alarm(kind, max(own, key=lambda misfit: misfit.share).text, float("inf"))


def _compare(
    figure: _Figure, measures: Mapping[str, EditMeasures], known: Sequence[EditMeasures]
) -> Iterator[tuple[str, Alarm]]:
    """The edits that are far from the middle of the half of those known that lies closest together (Rousseeuw 1984);
    none in small families.

    Median and median deviation would be drawn towards outliers where these are many, and all on one side.
    """
    values = np.sort([value for one in known if (value := figure.read(one)) is not None])
    if len(values) < LEAST_FAMILY:
        return
    half = len(values) // 2 + 1
    widths = values[half - 1 :] - values[: len(values) - half + 1]
    at = int(widths.argmin())
    middle = float(values[at] + values[at + half - 1]) / 2
    spread = max(_DEVIATION * float(widths[at]) / 2, figure.floor)
    usual = values[np.abs(values - middle) < _LIMIT * spread]
    low, high = figure.show(float(usual.min())), figure.show(float(usual.max()))
    family = low if low == high else f"{low} to {high}"
    for name, one in measures.items():
        value = figure.read(one)
        excess = 0.0 if value is None else abs(value - middle) / spread
        if value is not None and excess >= _LIMIT:
            text = f"{figure.text.format(figure.show(value))}, the family {family}"
            yield name, Alarm(figure.kind, text, excess)


def _log_extent(one: EditMeasures) -> float | None:
    ratios = [_log_ratio(*pair) for pair in zip(one.extents_before, one.extents_after, strict=True)]
    known = [ratio for ratio in ratios if ratio is not None]
    return max(known, key=lambda ratio: (abs(ratio), ratio)) if known and one.hulls_after else None


def _log_ratio(before: float, after: float) -> float | None:
    return log(max(after / before, _LEAST_SHARE)) if before > 0 else None


def _show_change(ratio: float) -> str:
    return f"{round(100 * expm1(ratio)) or 0:+d}%"


# Floors and the limit were chosen on the calibration families of the benchmark: 0.5% of right edits have an alarm.
_FIGURES = (
    _Figure("volume", "volume {}", 0.1, lambda one: _log_ratio(one.volume_before, one.volume_after), _show_change),
    _Figure("extent", "extents {}", 0.16, _log_extent, _show_change),
    _Figure(
        "hulls",
        "number of hulls {}",
        0.25,
        lambda one: log((one.hulls_after + 1) / (one.hulls_before + 1)),
        _show_change,
    ),
    _Figure(
        "filled",
        "{} of the free space is filled",
        0.07,
        lambda one: one.filled if one.free >= _LEAST_FREE else None,
        "{:.0%}".format,
    ),
    _Figure("freed", "{} of the covered space is free", 0.05, lambda one: one.freed, "{:.0%}".format),
)
