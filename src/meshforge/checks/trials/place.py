"""Where something is tried on an asset, and why it does not work there."""

from dataclasses import dataclass

from meshforge.geometry import Floats, Shape
from meshforge.symbolic import Hull

TOLERANCE = 0.002
"""What counts as touching, of the diagonal of an asset."""


@dataclass(frozen=True, eq=False, slots=True)
class Place:
    """Where something is tried. at: (3,) [m]; size: (3,) along the axes [m], or as a trial says; axes: the columns of a
    rotation (3, 3)."""

    at: Floats
    size: Floats
    axes: Floats


@dataclass(frozen=True, eq=False, slots=True)
class Failure:
    """Why something does not work, in a sentence. hulls: names of those at fault; objects: what was tried there, where
    it was put."""

    text: str
    hulls: tuple[str, ...] = ()
    objects: tuple[Shape, ...] = ()

    def __str__(self) -> str:
        return self.text


def describe_hull(hull: Hull) -> str:
    """Return a hull in words, which are also the name of its geom."""
    return f"{hull.name} ({hull.label or 'no label'})"


def mm(length: float) -> str:
    """Return a length [m] in words."""
    return f"{1000 * length:.1f} mm"
