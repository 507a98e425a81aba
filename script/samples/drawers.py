"""Hollow drawers, open above, with a front and a handle; built facing -Y, then turned to where they look."""

from __future__ import annotations

from collections.abc import Callable

from manifold3d import Manifold

from script.samples.part import Part, move_parts
from script.samples.solids import bar, block, box, revolve, tube, union

FRONT = 0.02
WALL = 0.012
SUNK = 0.003  # how far a handle's posts reach into the front [m]

Handle = Callable[[], Manifold]
"""Makes a handle whose mounting plane is y = 0 and which stands out along -Y."""


def drawer(
    name: str, size: tuple[float, float, float], handle: Handle, x: float, y: float, z: float, turn: float = 0.0
) -> list[Part]:
    """A drawer and its handle.

    size: outer width, depth and height [m]; the middle of its front's face is put at (x, y), the bottom at z;
    turn: 0 looks to -Y, 90 to +X, 180 to +Y, 270 to -X.
    """
    width, depth, height = size
    w = width / 2
    tray = block((-w, 0.001, 0.006), (w, depth, height - 0.012)) - block(
        (-w + WALL, FRONT, 0.006 + WALL), (w - WALL, depth - WALL, height)
    )
    front = block((-w - 0.004, 0, 0), (w + 0.004, FRONT, height))
    parts = [
        Part(name, "drawer", tray + front),
        Part(f"{name}_handle", "handle", handle().translate((0, 0, height / 2))),
    ]
    return move_parts(parts, x, y, z, turn)


def knob(radius: float = 0.017) -> Manifold:
    """A mushroom knob."""
    r = radius
    return revolve([(0.45 * r, -SUNK), (0.45 * r, 0.9 * r), (r, 1.2 * r), (r, 1.7 * r), (0.6 * r, 2.1 * r)], 10).rotate(
        (90, 0, 0)
    )


def bow(width: float = 0.13, reach: float = 0.035, thickness: float = 0.012) -> Manifold:
    """A bow handle: a bent bar, which most decompositions fill."""
    w = width / 2
    return tube(
        [
            (-w, SUNK, 0),
            (-w * 0.92, -reach * 0.7, 0),
            (-w * 0.6, -reach, 0),
            (w * 0.6, -reach, 0),
            (w * 0.92, -reach * 0.7, 0),
            (w, SUNK, 0),
        ],
        thickness,
        6,
    )


def rod(width: float = 0.16, reach: float = 0.03, thickness: float = 0.014) -> Manifold:
    """A straight rod on two posts."""
    posts = [bar((x, SUNK, 0), (x, -reach, 0), thickness * 0.8, 6) for x in (-width * 0.36, width * 0.36)]
    return union([bar((-width / 2, -reach, 0), (width / 2, -reach, 0), thickness, 8), *posts])


def cup(width: float = 0.09, reach: float = 0.03) -> Manifold:
    """A cup pull, hollow from below."""
    outer = revolve([(width / 2, 0), (width / 2 * 0.9, 0.02), (width / 2 * 0.5, 0.032)], 14)
    inner = revolve(
        [(width / 2 - 0.006, -0.01), (width / 2 - 0.006, 0.004), (width / 2 * 0.8, 0.02), (width / 2 * 0.4, 0.027)], 14
    )
    shell = (outer - inner).scale((1, 2 * reach / width, 1))
    return shell.trim_by_plane((0, -1, 0), -SUNK).translate((0, 0, -0.016)) + box(
        (width * 0.96, 2 * SUNK, 0.01), (0, 0, 0.004)
    )
