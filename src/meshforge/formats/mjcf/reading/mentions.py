"""What an MJCF calls its geoms besides their names: by class, mesh and material, and by what their bodies show."""

from __future__ import annotations

from collections.abc import Hashable
from functools import cached_property
from typing import TYPE_CHECKING

from meshforge.asset import Mentions
from meshforge.formats.mentioned import Named, mentions

if TYPE_CHECKING:
    from collections.abc import Sequence

    import mujoco

_UNNAMED = "main"  # the class of all that have none


class GeomMentions:
    """What is said of the geoms of one model, in its order; collides: whether each takes part in collisions."""

    def __init__(self, geoms: Sequence[mujoco.MjsGeom], bodies: Sequence[str], collides: Sequence[bool]) -> None:
        self.geoms, self.bodies, self.collides = geoms, bodies, collides

    def of(self, k: int) -> Mentions:
        """What is said of the k-th geom."""
        geom, shown = self.geoms[k], self._visual_names.get(self.bodies[k], [])
        kind = geom.classname.name if geom.classname else ""
        return mentions(_named(geom), shown, [("class", kind)] if kind != _UNNAMED else [])

    @cached_property
    def _visual_names(self) -> dict[str, list[Named]]:
        """What each body has to be looked at alone."""
        found: dict[str, list[Named]] = {}
        for geom, body, collides in zip(self.geoms, self.bodies, self.collides, strict=True):
            if not collides:
                found.setdefault(body, []).append(_named(geom, geom.name))
        return found


def _named(geom: mujoco.MjsGeom, name: str = "") -> Named:
    place: Hashable = (geom.type, *geom.size.tolist(), *geom.pos.tolist(), *geom.quat.tolist())
    return Named(geom.meshname or place, name, geom.meshname, geom.material)
