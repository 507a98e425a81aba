"""Figures of an examination beside those of the asset before, in the words of the page."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeVar

from meshforge.checks import Examination
from meshforge.checks.physics import Physics
from meshforge.studio.wire.checks import Figure, Unit

Measured = TypeVar("Measured")


def fit_figures(was: Examination, now: Examination) -> Iterator[Figure]:
    """How far hulls stick out, and what lies bare."""
    before, after = (found.fit if found.fit and found.fit.hulls else None for found in (was, now))
    if after is None:
        return
    yield _figure("Hulls stick out, at most", "m", before, after, lambda fit: fit.out)
    yield _figure("Visual surface uncovered", "%", before, after, lambda fit: 100 * fit.bare_share)
    yield _figure("It lies off hulls, at most", "m", before, after, lambda fit: fit.bare)


def clearance_figures(was: Examination, now: Examination) -> Iterator[Figure]:
    """What hulls close and open of the space about the visual mesh; then what the edit did."""
    if now.clearance:
        yield _figure("Closed, against the visual", "l", was.clearance, now.clearance, lambda c: c.closed)
        yield _figure("Opened, against the visual", "l", was.clearance, now.clearance, lambda c: c.opened)
    if now.changed:
        yield _figure("Closed by the edit", "l", None, now.changed, lambda c: c.closed)
        yield _figure("Opened by the edit", "l", None, now.changed, lambda c: c.opened)


def physics_figures(now: Examination) -> Iterator[Figure]:
    """How it rests, and what of it overlaps."""
    physics, earlier = now.physics, now.earlier
    was, rest = earlier.rest if earlier else None, physics.rest if physics else None
    if rest is not None:
        yield _figure("Shakes at rest", "m/s", was, rest, lambda r: r.jitter)
        yield _figure("Turned", "°", was, rest, lambda r: r.tilt)
        yield _figure("Wandered", "m", was, rest, lambda r: r.moved)
        yield _figure("Mass", "kg", was, rest, lambda r: r.mass)
    if physics and (rest is not None or physics.overlaps):
        yield _figure("Overlaps of bodies", "", earlier, physics, lambda found: len(found.overlaps))
        if any(found.overlaps for found in (earlier, physics) if found):
            yield _figure("Deepest of them", "m", earlier, physics, _deepest)


def _deepest(found: Physics) -> float:
    return max((overlap.depth for overlap in found.overlaps), default=0.0)


def _figure(
    what: str, unit: Unit, before: Measured | None, after: Measured | None, of: Callable[[Measured], float]
) -> Figure:
    values = [None if found is None else float(of(found)) for found in (before, after)]
    return Figure(what=what, unit=unit, before=values[0], after=values[1])
