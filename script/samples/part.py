"""A named, labelled solid of a table; a table is a list of these."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from manifold3d import Manifold

LABELS = ("panel", "leg", "handle", "drawer", "misc")


@dataclass(frozen=True)
class Part:
    """One watertight part, z up, the floor at z = 0 [m]."""

    name: str
    label: str
    solid: Manifold

    def __post_init__(self) -> None:
        self.solid.num_tri()  # evaluated as it was built: a lazy one would round otherwise once it is moved

    def move(self, x: float = 0.0, y: float = 0.0, z: float = 0.0, turn: float = 0.0) -> Part:
        """The part turned about Z [degrees], then shifted [m]."""
        return replace(self, solid=self.solid.rotate((0, 0, turn)).translate((x, y, z)))

    def rename(self, name: str) -> Part:
        """The part under another name."""
        return replace(self, name=name)


def move_parts(parts: Iterable[Part], x: float = 0.0, y: float = 0.0, z: float = 0.0, turn: float = 0.0) -> list[Part]:
    """All parts turned about Z [degrees], then shifted [m]."""
    return [part.move(x, y, z, turn) for part in parts]
