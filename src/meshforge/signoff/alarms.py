"""Edits that stand out without a look at labels: outliers of their family, and what is wrong in any family."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import expm1, log
from typing import Literal

import numpy as np

from meshforge.signoff.measures import EditMeasures

LEAST_FAMILY = 4
"""Of fewer edits none is an outlier: nobody can say which are the odd ones."""
BLOCK, MORE = 0.5, 0.15
"""An edit that fills such a share of the free space of an asset makes one solid block of it, unless the same was shown:
then one that fills so much more than any that a person showed."""
_LIMIT = 5.0  # robust z from which on an edit stands out
_DEVIATION = 1.4826  # of a normal distribution, in median absolute deviations
_LEAST_SHARE = 1e-3  # smaller shares of a volume or an extent count as this
_LEAST_FREE = 0.1  # of the box of an asset: in less free space points tell nothing

AlarmKind = Literal["deleted", "block", "volume", "extent", "hulls", "filled", "freed"]


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
    """The alarms of those edits of a family that have any, the farthest out first; measures: by asset; shown: of the
    same program on assets that a person demonstrated or accepted."""
    block = max([BLOCK, *(one.filled + MORE for one in shown if one.free >= _LEAST_FREE)])
    found: dict[str, list[Alarm]] = {name: list(_find_absolute(one, block)) for name, one in measures.items()}
    known = [one for name, one in measures.items() if not found[name]]
    for figure in _FIGURES:
        if usual := _find_usual(figure, known):
            for name, one in measures.items():
                found[name] += _compare(figure, one, usual)
    return {name: tuple(sorted(alarms, key=lambda alarm: -alarm.excess)) for name, alarms in found.items() if alarms}


def describe_odd_results(
    measures: Mapping[str, EditMeasures], shown: Iterable[EditMeasures] = ()
) -> dict[str, tuple[str, ...]]:
    """Sentences on those edits of a family that stand out, the farthest out first, by asset."""
    return {name: tuple(alarm.text for alarm in alarms) for name, alarms in find_alarms(measures, shown).items()}


def _find_absolute(one: EditMeasures, block: float) -> Iterator[Alarm]:
    if one.hulls_before and not one.hulls_after:
        yield Alarm("deleted", "no hull is left", float("inf"))
    if one.free >= _LEAST_FREE and one.filled >= block:
        yield Alarm("block", f"nearly one solid block: {one.filled:.0%} of the free space is filled", float("inf"))


@dataclass(frozen=True, slots=True)
class _Usual:
    """What edits of a family have in common; spread: one robust deviation; low, high: of those that are no outliers."""

    middle: float
    spread: float
    low: float
    high: float


def _find_usual(figure: _Figure, edits: Sequence[EditMeasures]) -> _Usual | None:
    """The middle and the spread of the half that lies closest together (Rousseeuw 1984), None for small families.

    Median and median deviation would be drawn towards outliers where these are many, and all on one side.
    """
    values = np.sort([value for one in edits if (value := figure.read(one)) is not None])
    if len(values) < LEAST_FAMILY:
        return None
    half = len(values) // 2 + 1
    widths = values[half - 1 :] - values[: len(values) - half + 1]
    at = int(widths.argmin())
    middle = float(values[at] + values[at + half - 1]) / 2
    spread = max(_DEVIATION * float(widths[at]) / 2, figure.floor)
    usual = values[np.abs(values - middle) < _LIMIT * spread]
    return _Usual(middle, spread, float(usual.min()), float(usual.max()))


def _compare(figure: _Figure, one: EditMeasures, usual: _Usual) -> Iterator[Alarm]:
    value = figure.read(one)
    excess = 0.0 if value is None else abs(value - usual.middle) / usual.spread
    if value is not None and excess >= _LIMIT:
        low, high = figure.show(usual.low), figure.show(usual.high)
        family = low if low == high else f"{low} to {high}"
        yield Alarm(figure.kind, f"{figure.text.format(figure.show(value))}, the family {family}", excess)


def _log_volume(one: EditMeasures) -> float | None:
    return _log_ratio(one.volume_before, one.volume_after)


def _log_extent(one: EditMeasures) -> float | None:
    """Of the side of the box that changes most."""
    ratios = [_log_ratio(*pair) for pair in zip(one.extents_before, one.extents_after, strict=True)]
    known = [ratio for ratio in ratios if ratio is not None]
    return max(known, key=lambda ratio: (abs(ratio), ratio)) if known and one.hulls_after else None


def _log_hulls(one: EditMeasures) -> float | None:
    return log((one.hulls_after + 1) / (one.hulls_before + 1))


def _log_ratio(before: float, after: float) -> float | None:
    return log(max(after / before, _LEAST_SHARE)) if before > 0 else None


def _fill_share(one: EditMeasures) -> float | None:
    return one.filled if one.free >= _LEAST_FREE else None


def _show_change(ratio: float) -> str:
    return f"{round(100 * expm1(ratio)) or 0:+d}%"


def _show_share(share: float) -> str:
    return f"{share:.0%}"


# Floors and the limit were chosen on the calibration families of the benchmark: 0.5% of right edits have an alarm.
_FIGURES = (
    _Figure("volume", "volume {}", 0.1, _log_volume, _show_change),
    _Figure("extent", "extents {}", 0.16, _log_extent, _show_change),
    _Figure("hulls", "number of hulls {}", 0.25, _log_hulls, _show_change),
    _Figure("filled", "{} of the free space is filled", 0.07, _fill_share, _show_share),
    _Figure("freed", "{} of the covered space is free", 0.05, lambda one: one.freed, _show_share),
)
