"""Chairs, a GLB or glTF text each: seats, legs of 1 to 3 hulls, backs of 1 to 9, some with arms and rails.

What holds for all, so that one program is right for them: every leg is a body of its own, which rails may touch; a
back is nearly a plane, so that its hull leaves the seat free. Collision is said in each way that engines know.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshforge.formats import EngineName, format_for, format_with_names
from meshforge.geometry import Polytope, Pose
from meshforge.samples.families import Files
from meshforge.symbolic import Asset, Body, Document, Geom, Surface
from script.families.parts import format_labels, join_surfaces, name_hulls
from script.families.pieces import (
    Y_UP,
    Cut,
    Point,
    X,
    Y,
    Z,
    bar_points,
    block,
    hull_of,
    post_points,
    slice_all,
    stack,
    superellipse,
)

Hulls = list[Polytope]


@dataclass(frozen=True, eq=False)
class Chair:
    """One chair: its parts, built with Z up and the back at +Y.

    file: its name with the suffix; yaw: how it is turned [degrees]; engine: by whose names its collision is known, None
    for KHR_physics_rigid_bodies; order: of the parts in the file; rgba: its colour.
    """

    file: str
    seat: Hulls
    legs: Hulls
    back: Sequence[Polytope] = ()
    arms: Sequence[Polytope] = ()
    rails: Sequence[Polytope] = ()
    yaw: float = 0.0
    engine: EngineName | None = None
    order: str = "seat leg back arm rail"
    rgba: tuple[float, float, float, float] = (0.62, 0.42, 0.25, 1.0)

    def write(self) -> Files:
        """Its files and its labels."""
        body = Path(self.file).stem
        parts = {"seat": self.seat, "leg": self.legs, "back": self.back, "arm": self.arms, "rail": self.rails}
        pose = Y_UP @ Pose.from_rpy((0, 0, 0), (0, 0, float(np.radians(self.yaw))))
        hulls = name_hulls([(label, parts[label]) for label in self.order.split()], f"{body}/hull_{{}}", pose)
        shown = join_surfaces(hull.shape for hull in hulls)
        visual = Surface(shown.vertices, shown.faces, body, self.rgba)
        geoms = tuple(Geom(hull.name, body, hull.shape) for hull in hulls)
        asset = Asset(
            Path(self.file), "memory", (Body(body, Pose.identity()),), geoms, Document(), visuals=(visual,), up="y"
        )
        known = format_for(asset.path, asset.format)
        output = (format_with_names(known, self.engine) if self.engine else known).create(asset, self.file)
        names = (output.names.get(hull.name, hull.name) for hull in hulls)
        labels = format_labels(names, (hull.label for hull in hulls))
        return {self.file: output.main, **output.made, f"{body}.labels.json": labels}


def build_chairs() -> Files:
    """All chairs."""
    return {path: content for chair in _list_chairs() for path, content in chair.write().items()}


def _slab(
    width: float, depth: float, top: float, thickness: float, power: float = 8.0, cuts: Iterable[Cut] = ()
) -> Hulls:
    """A level plate about the Z axis, cut up."""
    outline = superellipse(2.0, 2.0 * depth / width, power, 16)
    return slice_all(stack(outline, [(width / 2, top - thickness), (width / 2, top)]), cuts)


def _legs(
    places: Iterable[tuple[float, float]],
    top: float,
    size: float,
    *,
    splay: float = 1.0,
    sides: int = 4,
    pieces: int = 1,
) -> Hulls:
    """Tapered legs below places (x, y); splay: how much wider they stand; pieces: of each."""
    posts = [hull_of(post_points((splay * x, splay * y, 0.0), (x, y, top), 0.7 * size, size, sides)) for x, y in places]
    return slice_all(posts, ((Z, pieces),))


def _corners(width: float, depth: float) -> list[tuple[float, float]]:
    return [(x * width / 2, y * depth / 2) for x in (-1, 1) for y in (-1, 1)]


def _bars(ends: Iterable[tuple[Point, Point]], width: float, sides: int = 6) -> Hulls:
    return [hull_of(bar_points(start, end, width, sides)) for start, end in ends]


def _rungs(count: int, width: float, y: float, low: float, high: float, height: float) -> Hulls:
    """Level boards behind a seat, one above the other."""
    return [
        block((-width / 2, y - 0.008, z - height / 2), (width / 2, y + 0.008, z + height / 2))
        for z in np.linspace(low, high, count).tolist()
    ]


def _uprights(places: Iterable[float], y: float, low: float, high: float, width: float, lean: float = 0.0) -> Hulls:
    """Upright bars behind a seat at places along X, leaning back."""
    return _bars([((x, y, low), (1.05 * x, y + lean, high)) for x in places], width)


def _list_chairs() -> list[Chair]:
    square = _corners(0.38, 0.36)
    ring = [(0.14 * np.cos(turn), 0.14 * np.sin(turn)) for turn in (np.arange(3) + 0.25) * 2 * np.pi / 3]
    tall = _corners(0.24, 0.24)
    feet = [(1.3 * x, 1.3 * y, 0.25) for x, y in (tall[0], tall[1], tall[3], tall[2])]
    return [
        Chair(
            "kitchen_chair.glb",
            seat=_slab(0.44, 0.42, 0.45, 0.03),
            legs=_legs(square, 0.42, 0.04),
            back=_uprights((-0.19, 0.19), 0.2, 0.45, 0.9, 0.035) + _rungs(2, 0.38, 0.2, 0.62, 0.84, 0.06),
        ),
        Chair(
            "ladder_back.glb",
            seat=_slab(0.44, 0.4, 0.44, 0.03, cuts=((X, 2),)),
            legs=_legs(square, 0.41, 0.04, pieces=2),
            back=_uprights((-0.2, 0.2), 0.185, 0.44, 1.02, 0.035, 0.03) + _rungs(5, 0.4, 0.2, 0.55, 0.95, 0.05),
            rails=_bars([((s * 0.18, -0.17, 0.18), (s * 0.18, 0.17, 0.18)) for s in (-1, 1)], 0.02),
            yaw=25.0,
            order="leg rail seat back",
            rgba=(0.4, 0.26, 0.16, 1.0),
        ),
        Chair(
            "windsor.gltf",
            seat=_slab(0.46, 0.44, 0.46, 0.035, 2.5, ((X, 2), (Y, 2))),
            legs=_legs(_corners(0.28, 0.26), 0.425, 0.04, splay=1.4, sides=6),
            back=_uprights(np.linspace(-0.17, 0.17, 6).tolist(), 0.17, 0.46, 0.9, 0.014, 0.06)
            + _rungs(1, 0.42, 0.24, 0.92, 0.92, 0.05),
            yaw=-40.0,
            order="back leg seat",
            rgba=(0.2, 0.2, 0.18, 1.0),
        ),
        Chair(
            "stool.gltf",
            seat=_slab(0.36, 0.36, 0.48, 0.04, 2.0),
            legs=_legs(ring, 0.44, 0.045, splay=1.3, sides=8, pieces=2),
            engine="godot",
            order="leg seat",
        ),
        Chair(
            "bar_stool.glb",
            seat=_slab(0.32, 0.32, 0.75, 0.04, 2.0, ((X, 3),)),
            legs=_legs(tall, 0.71, 0.035, splay=1.6, pieces=3),
            back=_rungs(1, 0.3, 0.14, 0.86, 0.86, 0.08) + _uprights((-0.06, 0.06), 0.14, 0.75, 0.82, 0.02),
            rails=_bars(list(zip(feet, feet[1:] + feet[:1], strict=True)), 0.02),
            yaw=15.0,
            engine="unity",
            order="seat back rail leg",
            rgba=(0.3, 0.3, 0.33, 1.0),
        ),
        Chair(
            "armchair.glb",
            seat=_slab(0.6, 0.58, 0.42, 0.14, cuts=((Y, 2),)),
            legs=_legs(_corners(0.5, 0.48), 0.28, 0.06, sides=8),
            back=slice_all([block((-0.3, 0.2, 0.42), (0.3, 0.29, 0.95))], ((X, 3),)),
            arms=[block((s * 0.34 - 0.04, -0.25, 0.3), (s * 0.34 + 0.04, 0.29, 0.6)) for s in (-1, 1)],
            engine="unreal",
            order="seat arm back leg",
            rgba=(0.35, 0.42, 0.5, 1.0),
        ),
        Chair(
            "bench.glb",
            seat=_slab(1.3, 0.4, 0.45, 0.03, 12.0, ((Y, 4),)),
            legs=_legs([(x, y) for x in (-0.58, 0.0, 0.58) for y in (-0.16, 0.16)], 0.42, 0.06, pieces=2),
            back=_uprights((-0.58, 0.0, 0.58), 0.18, 0.45, 0.9, 0.045) + _rungs(4, 1.24, 0.18, 0.55, 0.85, 0.06),
            arms=[block((s * 0.61 - 0.025, -0.18, 0.45), (s * 0.61 + 0.025, 0.15, 0.65)) for s in (-1, 1)],
            yaw=90.0,
            order="leg seat arm back",
            rgba=(0.5, 0.36, 0.2, 1.0),
        ),
        Chair(
            "child_chair.gltf",
            seat=_slab(0.28, 0.26, 0.28, 0.02),
            legs=_legs(_corners(0.22, 0.2), 0.26, 0.03),
            back=_rungs(1, 0.26, 0.12, 0.43, 0.43, 0.3),
            engine="godot",
            order="back seat leg",
            rgba=(0.8, 0.25, 0.2, 1.0),
        ),
        Chair(
            "garden_chair.glb",
            seat=_slab(0.46, 0.44, 0.42, 0.025, 12.0, ((X, 5),)),
            legs=_legs(_corners(0.4, 0.38), 0.395, 0.05),
            back=_uprights(np.linspace(-0.19, 0.19, 5).tolist(), 0.2, 0.42, 0.88, 0.05, 0.1),
            arms=[block((s * 0.22 - 0.03, -0.2, 0.6), (s * 0.22 + 0.03, 0.22, 0.625)) for s in (-1, 1)],
            rails=[hull_of(post_points((s * 0.22, -0.17, 0.42), (s * 0.22, -0.17, 0.6), 0.03, 0.03)) for s in (-1, 1)],
            yaw=-10.0,
            engine="unreal",
            order="seat leg back arm rail",
            rgba=(0.85, 0.85, 0.8, 1.0),
        ),
        Chair(
            "office_chair.glb",
            seat=_slab(0.5, 0.48, 0.46, 0.05, 3.0, ((X, 2),)),
            legs=_legs(square, 0.41, 0.03, sides=8),
            back=slice_all(_rungs(1, 0.44, 0.22, 0.72, 0.72, 0.4), ((X, 3), (Z, 3))),
            rails=_bars([((0.0, 0.22, 0.46), (0.0, 0.22, 0.53))], 0.06),
            yaw=60.0,
            order="rail leg back seat",
            rgba=(0.15, 0.15, 0.17, 1.0),
        ),
    ]
