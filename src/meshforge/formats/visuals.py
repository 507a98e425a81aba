"""What an asset shows: surfaces that are read only when somebody looks, so that batches do not wait for them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import overload

from meshforge.asset import Surface
from meshforge.errors import MeshForgeError
from meshforge.formats.mesh_parts import placed
from meshforge.formats.triangles import read_triangles
from meshforge.geometry import Floats, Pose, Shape

Rgba = tuple[float, float, float, float]


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

    def moved(self, pose: Pose) -> Visual:
        """The visual in another root frame; pose: new_T_old."""
        if isinstance(self.what, Shape):
            return replace(self, what=self.what.moved(pose))
        offset = pose.rotation @ self.offset + pose.translation
        return replace(self, linear=pose.rotation @ self.linear, offset=offset)

    def surfaces(self) -> list[Surface]:
        """Its surfaces; none where the file cannot be read."""
        if isinstance(self.what, Shape):
            return [Surface(self.what.vertices, self.what.faces, self.body, self.rgba)]
        try:
            read = read_triangles(self.what)
        except MeshForgeError:
            return []
        found = [placed(s.vertices, s.faces, self.linear, self.offset, self.body) for s in read]
        return [replace(surface, rgba=self.rgba) for surface in found]


class LazySurfaces(Sequence[Surface]):
    """The surfaces of visuals, made at the first look; pickles as the visuals."""

    def __init__(self, visuals: tuple[Visual, ...]) -> None:
        self._visuals = visuals
        self._made: tuple[Surface, ...] | None = None

    @property
    def visuals(self) -> tuple[Visual, ...]:
        """What the surfaces are made from."""
        return self._visuals

    @property
    def _surfaces(self) -> tuple[Surface, ...]:
        if self._made is None:
            self._made = tuple(surface for visual in self._visuals for surface in visual.surfaces())
        return self._made

    @overload
    def __getitem__(self, index: int) -> Surface: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Surface, ...]: ...
    def __getitem__(self, index: int | slice) -> Surface | tuple[Surface, ...]:
        return self._surfaces[index]

    def __len__(self) -> int:
        return len(self._surfaces)

    def __reduce__(self) -> tuple[Callable[[tuple[Visual, ...]], LazySurfaces], tuple[tuple[Visual, ...]]]:
        return LazySurfaces, (self._visuals,)
