"""Sites of kettles: a way past the body that only the spout is in, the grip, and where a peg and a plate are added."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from benchmark.assets.asset import Site
from benchmark.assets.decomposition import bounds
from meshforge.geometry import Floats
from script.samples.part import Part
from script.samples.solids import block

PEG, PLATE = 0.06, 0.01
"""How far the peg of the template reaches, and how thick the plate is [m]."""
_ROOM = 1.5  # a finger is so far from the middle of the grip, in half widths of it
_SLICE = 0.1  # of the length of the grip, on either side of its middle

Axes = tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]


def sites_of(parts: Sequence[Part]) -> list[Site]:
    """The sites of a kettle: `beside`, `peg` and `plate`, and `grip` where it has a handle."""
    body = bounds([part for part in parts if part.label == "body"])
    spout = bounds([part for part in parts if part.label == "spout"])
    middle = [(pair[0] + pair[1]) / 2 for pair in (body, spout)]
    way = middle[1] - middle[0]
    axis = int(np.abs(way[:2]).argmax())
    side = float(np.sign(way[axis]))
    return [_beside(body, spout, axis, side), _peg(body, axis, side), _plate(body), *_grip(parts)]


def _beside(body: tuple[Floats, Floats], spout: tuple[Floats, Floats], axis: int, side: float) -> Site:
    """A way across the spout, between the body and its tip, as long as the body is wide."""
    edge, tip = (float(box[1 if side > 0 else 0][axis]) for box in (body, spout))
    at = (body[0] + body[1]) / 2
    at[axis] = edge + 0.6 * (tip - edge)
    at[2] = (max(spout[0][2], body[0][2]) + spout[1][2]) / 2
    across = np.eye(3)[1 - axis]
    length = float((body[1] - body[0])[1 - axis])
    start = at - across * length / 2
    high = 0.3 * float((spout[1] - spout[0])[2])
    return Site("beside", _point(start), (length, 0.3 * abs(tip - edge), high), _axes(across, np.eye(3)[axis]))


def _peg(body: tuple[Floats, Floats], axis: int, side: float) -> Site:
    """Where one holds a peg at the side of the body's box where the spout is; fingers come from outside."""
    at = (body[0] + body[1]) / 2
    at[axis] = (body[1] if side > 0 else body[0])[axis] + side * 0.65 * PEG
    inwards = -side * np.eye(3)[axis]
    return Site("peg", _point(at), (0.25 * PEG, 0.35 * PEG, 0.1 * PEG), _axes(inwards, np.eye(3)[1 - axis]))


def _plate(body: tuple[Floats, Floats]) -> Site:
    """The middle of a plate below the body."""
    at = (body[0] + body[1]) / 2
    at[2] = body[0][2] - PLATE / 2
    return Site("plate", _point(at), (PLATE, PLATE, PLATE / 2))


def _grip(parts: Sequence[Part]) -> Iterator[Site]:
    """The middle of the grip: fingers come from above where it lies, and from outside where it is upright."""
    found = [part for part in parts if part.name == "grip"]
    if not found:
        return
    low, high = bounds(found)
    along = int((high - low).argmax())
    a, b = low - 1, high + 1
    middle, reach = (low + high)[along] / 2, _SLICE * (high - low)[along]
    a[along], b[along] = middle - reach, middle + reach
    box = np.asarray((found[0].solid ^ block(_point(a), _point(b))).bounding_box())
    at, half = (box[:3] + box[3:]) / 2, (box[3:] - box[:3]) / 2
    if along == 2:
        way = -at * [1, 1, 0]
        into = np.eye(3)[int(np.abs(way).argmax())] * np.sign(way[np.abs(way).argmax()])
    else:
        into = np.array([0.0, 0.0, -1.0])
    close = np.cross(np.eye(3)[along], into)
    deep, wide = (float(half @ np.abs(v)) for v in (into, close))
    yield Site("grip", _point(at), (0.8 * deep, _ROOM * wide, 0.5 * wide), _axes(into, close))


def _point(values: Floats) -> tuple[float, float, float]:
    return (float(values[0]), float(values[1]), float(values[2]))


def _axes(first: Floats, second: Floats) -> Axes:
    return _point(first), _point(second), _point(np.cross(first, second))
