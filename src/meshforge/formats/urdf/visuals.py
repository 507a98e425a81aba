"""What a URDF shows: surfaces that are read only when somebody looks, so that batches do not wait for them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import overload

import numpy as np

from meshforge.asset import Surface
from meshforge.errors import MeshForgeError
from meshforge.formats.triangles import read_triangles
from meshforge.formats.urdf.numbers import origin
from meshforge.formats.urdf.references import Resolver
from meshforge.formats.urdf.shapes import geometry_of, mesh_scale, placed, primitive
from meshforge.formats.urdf.tree import Element
from meshforge.geometry import Floats, Pose, Shape


@dataclass(frozen=True, eq=False, slots=True)
class Visual:
    """A visual element in the root frame: a shape, or a mesh file under x -> linear @ x + offset."""

    what: Shape | Path
    linear: Floats
    offset: Floats

    def surfaces(self) -> list[Surface]:
        """Its surfaces; none where the file cannot be read."""
        if isinstance(self.what, Shape):
            return [Surface(self.what.vertices, self.what.faces)]
        try:
            return [placed(s.vertices, s.faces, self.linear, self.offset) for s in read_triangles(self.what)]
        except MeshForgeError:
            return []


class LazySurfaces(Sequence[Surface]):
    """The surfaces of visuals, made at the first look; pickles as the visuals."""

    def __init__(self, visuals: tuple[Visual, ...]) -> None:
        self._visuals = visuals
        self._made: tuple[Surface, ...] | None = None

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


def read_visuals(
    links: Mapping[str, Element], poses: Mapping[str, Pose], resolver: Resolver, where: str
) -> LazySurfaces:
    """The visuals of all links; one that is not understood is left out, it never fails."""
    return LazySurfaces(
        tuple(
            visual
            for name, link in links.items()
            for element in link.each("visual")
            for visual in _visual(element, poses[name], resolver, where)
        )
    )


def _visual(element: Element, pose: Pose, resolver: Resolver, where: str) -> Iterator[Visual]:
    kind = geometry_of(element)
    if kind is None:
        return
    try:
        at = pose @ origin(element, where)
        if kind.tag != "mesh":
            shape = primitive(kind, at, where).shape
            if shape is not None:
                yield Visual(shape, np.eye(3), np.zeros(3))
        elif path := resolver.find(kind.attributes.get("filename", "")):
            yield Visual(path, at.rotation * mesh_scale(kind, where, "visual"), at.translation)
    except MeshForgeError:
        return
