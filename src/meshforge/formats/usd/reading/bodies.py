"""The bodies of a stage: its rigid bodies, and one for all that collides outside of them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from meshforge.asset import Body, unique_names
from meshforge.formats.usd.document import BODY
from meshforge.formats.usd.reading.colliders import body_of
from meshforge.formats.usd.reading.stage import Scene
from meshforge.geometry import Pose


class Bodies:
    """The rigid bodies of a stage by path, in its order; used: whether the body of all else is needed."""

    def __init__(self, scene: Scene, physics: bool) -> None:
        self.scene = scene
        found = [prim for prim in scene.prims() if physics and _is_body(scene, prim)]
        self.prims: dict[str, Any] = {str(prim.GetPath()): prim for prim in found}
        names = unique_names([BODY, *(scene.shorten_path(path) for path in self.prims)])[1:]
        self.names = dict(zip(self.prims, names, strict=True))
        self.used = not self.prims

    def of(self, prim: Any) -> str:
        """The name of the body that a prim is part of."""
        own = body_of(self.scene, prim)
        path = str(own.GetPath()) if own else ""
        self.used |= path not in self.names
        return self.names.get(path, BODY)

    def of_joint(self, prim: Any) -> str:
        """The same for a prim that a joint holds, which shows nothing yet."""
        own = body_of(self.scene, prim)
        return self.names.get(str(own.GetPath()), BODY) if own else BODY

    def list_bodies(self) -> tuple[Body, ...]:
        """The body of the root frame where something is part of it, then the rigid ones."""
        fixed = [Body(BODY, Pose.identity())] if self.used else []
        return (*fixed, *(Body(self.names[path], self.scene.pose(prim)) for path, prim in self.prims.items()))

    def hull_name(self, path: str, body: str) -> str:
        """The name of what a prim collides with: its path below its body, after the body's name where there are any."""
        of_body = next((own for own, name in self.names.items() if name == body), "")
        own = self.scene.shorten_path(path, of_body)
        return f"{body}/{own}" if self.names else own


def _is_body(scene: Scene, prim: Any) -> bool:
    own = body_of(scene, prim)
    return own is not None and own == prim


def piece_names(bases: Iterable[tuple[str, int]]) -> list[tuple[str, ...]]:
    """The names of the pieces of prims; of each its own name and how many pieces it has: `#k` for one of several."""
    each = [[base] if count == 1 else [f"{base}#{k}" for k in range(count)] for base, count in bases]
    unique = iter(unique_names(name for names in each for name in names))
    return [tuple(next(unique) for _ in names) for names in each]
