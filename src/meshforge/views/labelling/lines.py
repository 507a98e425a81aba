"""What meets on a page: boxes and the straight lines between places, many at once."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshforge.geometry import Floats


def overlaps(boxes: Floats, others: Floats, gap: float) -> Any:
    """Which boxes (n, 4) come nearer than `gap` to which others (m, 4): (n, m); left, top, right, bottom [px]."""
    (left, top, right, bottom), (west, north, east, south) = _columns(boxes), _rows(others)
    return (left - gap < east) & (west - gap < right) & (top - gap < south) & (north - gap < bottom)


def cuts(lines: Floats, boxes: Floats) -> Any:
    """Which lines (n, 4), from one point to another, enter which boxes (m, 4): (n, m) (Liang and Barsky)."""
    (x, y, end_x, end_y), (left, top, right, bottom) = _columns(lines), _rows(boxes)
    step_x, step_y = _steep(end_x - x), _steep(end_y - y)
    a, b, c, d = (left - x) / step_x, (right - x) / step_x, (top - y) / step_y, (bottom - y) / step_y
    enter = np.maximum(np.minimum(a, b), np.minimum(c, d))
    leave = np.minimum(np.maximum(a, b), np.maximum(c, d))
    return np.maximum(enter, 0) < np.minimum(leave, 1)


def crosses(lines: Floats, others: Floats) -> Any:
    """Which lines (n, 4) cross which others (m, 4): (n, m)."""
    (ax, ay, bx, by), (cx, cy, dx, dy) = _columns(lines), _rows(others)
    apart = _side(ax, ay, bx, by, cx, cy) * _side(ax, ay, bx, by, dx, dy) < 0
    return apart & (_side(cx, cy, dx, dy, ax, ay) * _side(cx, cy, dx, dy, bx, by) < 0)


def _side(ax: Floats, ay: Floats, bx: Floats, by: Floats, x: Floats, y: Floats) -> Floats:
    """On which side of the line from a to b a point lies, by its sign."""
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax)


def _steep(step: Floats) -> Floats:
    """A step that can be divided by."""
    return np.where(np.abs(step) < 1e-9, 1e-9, step)


def _columns(rows: Floats) -> Floats:
    """The parts (4, n, 1) of boxes or lines (n, 4)."""
    return np.ascontiguousarray(rows.T)[:, :, None]


def _rows(rows: Floats) -> Floats:
    return np.ascontiguousarray(rows.T)[:, None]
