"""What an asset shows: surfaces that are read only when somebody looks, so that batches do not wait for them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, overload

import numpy as np

from meshforge.common import MeshForgeError
from meshforge.formats import base, collision_pieces, looks, mesh_reader
from meshforge.formats.meshfile.surface import GAMMA
from meshforge.formats.surface_parts import parts_of_surfaces
from meshforge.geometry import Floats, Ints, Pose, Shape
from meshforge.symbolic import Asset, FeatureKind, Rgba, Surface


@dataclass(frozen=True, eq=False, slots=True)
class Visual:
    """What a body shows, in the root frame: a shape, or a mesh file under x -> linear @ x + offset.

    rgba: its colour, four shares of 1; None where that is left to the mesh file.
    """

    body: str
    what: Shape | Path
    linear: Floats
    offset: Floats
    rgba: Rgba | None = None

    def move(self, pose: Pose) -> Visual:
        """The visual in another root frame; pose: new_T_old."""
        if isinstance(self.what, Shape):
            return replace(self, what=self.what.move(pose))
        offset = pose.rotation @ self.offset + pose.translation
        return replace(self, linear=pose.rotation @ self.linear, offset=offset)

    def surfaces(self) -> list[Surface]:
        """Its surfaces; none where the file cannot be read."""
        if isinstance(self.what, Shape):
            return [Surface(self.what.vertices, self.what.faces, self.body, self.rgba)]
        try:
            read = mesh_reader.read_triangles(self.what)
        except MeshForgeError:
            return []
        return [
            replace(self._place(s.vertices, s.faces), rgba=self.rgba, parts=parts_of_surfaces([s], self.what.stem))
            for s in read
        ]

    def explain_absence(self) -> str:
        """Why it has no surfaces: what is wrong with its file."""
        assert isinstance(self.what, Path)
        try:
            mesh_reader.read_triangles(self.what)
        except MeshForgeError as error:
            return error.sentence
        return f"{self.what}: it has no triangles"

    def surfaces_with_looks(self) -> list[Surface]:
        """Its surfaces with the base colours and pictures of their file, unless it has a colour itself."""
        if isinstance(self.what, Shape) or self.rgba is not None:
            return self.surfaces()
        try:
            read = looks.read_looks(self.what)
        except MeshForgeError:
            return []
        return [replace(self._place(s.vertices, s.faces), rgba=s.rgba, texture=s.texture) for s in read]

    def _place(self, vertices: Floats, faces: Ints) -> Surface:
        return collision_pieces.place_surface(vertices, faces, self.linear, self.offset, self.body)


class LazySurfaces(Sequence[Surface], ABC):
    """Surfaces that are made at the first look; pickles without them."""

    _made: tuple[Surface, ...] | None = None

    @abstractmethod
    def _make(self) -> Iterable[Surface]:
        """The surfaces."""

    @property
    def _surfaces(self) -> tuple[Surface, ...]:
        if self._made is None:
            self._made = tuple(self._make())
        return self._made

    @overload
    def __getitem__(self, index: int) -> Surface: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Surface, ...]: ...
    def __getitem__(self, index: int | slice) -> Surface | tuple[Surface, ...]:
        return self._surfaces[index]

    def __len__(self) -> int:
        return len(self._surfaces)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in vars(self).items() if name != "_made"}


class VisualSurfaces(LazySurfaces):
    """The surfaces of visuals."""

    def __init__(self, visuals: tuple[Visual, ...]) -> None:
        self.visuals = visuals
        self._absent = list[Visual]()

    def _make(self) -> Iterator[Surface]:
        self._absent = []
        for visual in self.visuals:
            own = visual.surfaces()
            self._absent += [] if any(len(surface.faces) for surface in own) else [visual]
            yield from own

    def explain_absent(self) -> list[tuple[str, str]]:
        """The body of each visual that shows nothing, and why."""
        assert self._surfaces is not None  # looked for now
        return [(visual.body, visual.explain_absence()) for visual in self._absent]


def visuals_of(asset: Asset) -> list[tuple[str, Visual | Surface]]:
    """What each body shows; what belongs to none is shown by the first."""
    first = asset.bodies[0].name if asset.bodies else ""
    found = asset.visuals.visuals if isinstance(asset.visuals, VisualSurfaces) else asset.visuals
    return [(visual.body or first, visual) for visual in found]


def read_visual_surfaces(asset: Asset) -> tuple[list[tuple[str, Surface]], list[base.Loss]]:
    """The surfaces of visuals with their bodies, colours and pictures, and what cannot be read."""
    found: list[tuple[str, Surface]] = []
    refused: list[str] = []
    for body, visual in visuals_of(asset):
        surfaces = visual.surfaces_with_looks() if isinstance(visual, Visual) else [visual]
        found += [(body, surface) for surface in surfaces if len(surface.faces)]
        if not surfaces:
            refused.append(body)
    return found, unreadable_visuals(refused)


def unreadable_visuals(bodies: Sequence[str]) -> list[base.Loss]:
    """The loss of the visuals of some bodies, named once each; none where there are no such bodies."""
    names = tuple(dict.fromkeys(bodies))
    return [base.Loss(FeatureKind.VISUALS, names, "their files cannot be read")] if names else []


def linear_color(rgba: Rgba) -> list[float]:
    """Red, green and blue of a colour as glTF and USD have them."""
    return [round(float(share), 6) for share in np.clip(rgba[:3], 0, 1) ** GAMMA]
