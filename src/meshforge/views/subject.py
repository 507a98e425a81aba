"""What a picture is of: a mesh in its colours, with what lies around it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.asset import Surface
from meshforge.geometry import Aabb, Floats
from meshforge.symbolic import Hull, SymbolicMesh
from meshforge.views.camera import Up, View, look
from meshforge.views.coloring import Coloring
from meshforge.views.film import Painted
from meshforge.views.paint import paint
from meshforge.views.palette import UNLABELLED, rgb
from meshforge.views.roundness import Skin, skin
from meshforge.views.stage import Layer, Stage, upright

_MANY = 60  # round primitives, from which on they are drawn with fewer sides
_FAR_OUT = 2.0  # things around a mesh that are this many times as large are not framed


@dataclass(frozen=True, eq=False, slots=True)
class Subject:
    """Layers to be drawn, and the points (n, 3) [m] that the picture must hold; points is empty for no hulls."""

    layers: tuple[Layer, ...]
    points: Floats
    up: Up

    @property
    def bounds(self) -> Aabb | None:
        return Aabb.of_points(self.points) if len(self.points) else None


def subject(
    mesh: SymbolicMesh,
    coloring: Coloring,
    ghost: Sequence[Surface] = (),
    lifted: frozenset[str] = frozenset(),
    up: Up | None = None,
) -> Subject:
    """A mesh in its colours; ghost: grey shells around it; lifted: hulls that shine through what hides them.

    up: as of `up_axis`.
    """
    skins = skins_of(mesh.hulls)
    solid = Layer(skins, coloring.colors, hatched=coloring.hatched)
    layers, shells = [solid], [s for s in map(skin, ghost) if len(s.faces)]
    if shells:
        layers.append(Layer(shells, np.tile(rgb(UNLABELLED), (len(shells), 1)), before=0.3))
    picked = [k for k, h in enumerate(mesh.hulls) if h.name in lifted]
    if picked:
        layers.append(Layer([skins[k] for k in picked], coloring.colors[picked], before=0.0, behind=0.38))
    return Subject(tuple(layers), framed(skins, shells), up_axis(mesh, up))


def up_axis(mesh: SymbolicMesh, up: Up | None) -> Up:
    """The axis that points up in a picture: the given one, or that of the mesh's file, or Z."""
    return up or ("Y" if mesh.asset and mesh.asset.up == "y" else "Z")


def skins_of(hulls: Sequence[Hull]) -> list[Skin]:
    """The triangles to draw hulls with; the more round ones there are, the fewer sides each has."""
    count = sum(h.shape.is_primitive for h in hulls)
    return [skin(h.shape, 96 if count <= _MANY else 32) for h in hulls]


def framed(skins: Sequence[Skin], shells: Sequence[Skin]) -> Floats:
    """The points (n, 3) [m] that a picture of hulls must hold, and of what lies around them unless it is far larger."""
    points = [s.vertices for s in skins]
    size = Aabb.of_points(np.concatenate(points)).diagonal if points else np.inf
    points += [s.vertices for s in shells if Aabb.of_points(s.vertices).diagonal <= _FAR_OUT * size]
    return np.concatenate(points) if points else np.zeros((0, 3))


def draw(what: Subject, bounds: Aabb | None, view: View, size: tuple[int, int]) -> Painted:
    """The subject, framed on `bounds`, or on all of its points."""
    held = bounds or what.bounds
    if held is None:
        width, height = size
        return Painted(np.zeros((height, width, 4), np.float32), np.full((height, width), -1))
    stage = Stage(held, upright(what.up))
    points = stage.to_unit(what.points if bounds is None else bounds.corners)
    fine = 2 if size[0] * size[1] > 250_000 else 3
    return paint(what.layers, stage, look(view, what.up, size, points), fine)
