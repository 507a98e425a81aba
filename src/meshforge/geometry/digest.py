"""A digest of a shape's geometry, the same after a trip through a file of single precision."""

from __future__ import annotations

import hashlib
from weakref import WeakKeyDictionary

import numpy as np

from meshforge.geometry.shapes import Polytope, Shape

_known: WeakKeyDictionary[Polytope, str] = WeakKeyDictionary()
"""Polytopes never change, and labels are looked up by their digests again and again."""


def digest(shape: Shape) -> str:
    """Sixteen hexadecimal digits of the shape's kind and its vertices in single precision, in sorted order."""
    if not isinstance(shape, Polytope):
        return _made(shape)
    known = _known.get(shape)
    if known is None:
        known = _known[shape] = _made(shape)
    return known


def _made(shape: Shape) -> str:
    rounded = np.unique(shape.vertices.astype(np.float32) + np.float32(0), axis=0)
    return hashlib.blake2b(shape.kind.encode() + rounded.tobytes(), digest_size=8).hexdigest()


def same_shape(a: Shape, b: Shape, tolerance: float = 0.0) -> bool:
    """Whether two shapes are of one kind with equal tessellations, each coordinate within `tolerance` [m]."""
    if a.kind != b.kind or a.vertices.shape != b.vertices.shape:
        return False
    return bool(np.abs(a.vertices - b.vertices).max() <= tolerance) and np.array_equal(a.faces, b.faces)
