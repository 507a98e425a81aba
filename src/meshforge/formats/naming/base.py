"""What the names of an engine are: which things in a file they tell, and how bodies and hulls are called."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Iterable
from typing import ClassVar, Literal

from meshforge.asset import PRIMITIVES, Geom, What
from meshforge.formats.naming.marks import unmarked

Names = Literal["unreal", "godot", "unity"]
"""The engines whose names for collision can be written."""


class EngineNames(ABC):
    """The names of one engine.

    title: the engine's name for people; holds: what a scene tells by them; shows: whether collision counts only where
    its body has a mesh to be seen; takes_opaque: whether a mesh that is no hull can collide as it is; centred: whether
    the mesh of a hull may lie about its own middle, and its node in place.
    """

    engine: ClassVar[Names]
    title: ClassVar[str]
    holds: ClassVar[frozenset[What]] = frozenset({What.NAMES, What.VISUALS, What.COLORS, What.OPAQUE})
    shows: ClassVar[bool] = False
    takes_opaque: ClassVar[bool] = True
    centred: ClassVar[bool] = True

    @abstractmethod
    def body(self, wanted: str) -> str:
        """A name for what is seen of a body, as near to the wanted one as the engine lets it be seen alone."""

    @abstractmethod
    def hull(self, body: str, geom: Geom, number: int, own: str) -> str:
        """The name of a hull; body: the name of its body; number: its place there, from 0; own: the name it had."""

    def holder(self, body: str) -> str | None:
        """The name of a node that holds what collides of a body; None where that lies right below the body's."""
        return None

    def opaque(self, own: str) -> str:
        """The name of a piece that collides with its triangles."""
        raise AssertionError(f"{self.title} takes no such pieces")

    def notes(self, geoms: Iterable[Geom]) -> tuple[str, ...]:
        """What a user should know about hulls that are written for the engine."""
        return ()


def cleaned(name: str, not_taken: str) -> str:
    """A name without characters that an engine changes, and without marks of any; not_taken: a pattern of them."""
    return unmarked(re.sub(not_taken, "_", name)).strip() or "part"


def instead_of(names: EngineNames) -> dict[What, str]:
    """How a scene has what names do not tell."""
    triangles = {what: "written as triangles" for what in PRIMITIVES.values() if what not in names.holds}
    return {**triangles, What.BODIES: "written as nodes"}
