"""OBJ for Unreal: what is seen of each body as a group, and its hulls as groups that are called after that."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import ClassVar

from meshforge.asset import Asset, Surface, What
from meshforge.formats.base import Output
from meshforge.formats.naming.base import instead_of
from meshforge.formats.naming.families import Family, families
from meshforge.formats.naming.unreal import UnrealNames
from meshforge.formats.plain.obj import Obj
from meshforge.formats.plain.obj_text import parts_text
from meshforge.formats.plain.parts import SEEN, Part, PlainDocument, Wanted, corners_of

_UNREAL = UnrealNames()
_SCALE = (
    "numbers are metres: Unreal's importers of OBJ take them for centimetres, so import it with a uniform scale of 100"
)


class ObjForUnreal(Obj):
    """OBJ files whose collision Unreal knows by name."""

    title = "OBJ for Unreal"
    up = "z"  # Interchange's translator of OBJ turns nothing, and Unreal is z-up
    holds = _UNREAL.holds - {What.COLORS}
    instead: ClassVar[Mapping[What, str]] = {**instead_of(_UNREAL), What.BODIES: "written as groups"}

    def can_write_back(self, asset: Asset) -> bool:
        return isinstance(asset.document, PlainDocument) and asset.document.marked and super().can_write_back(asset)

    def create(self, asset: Asset, name: str) -> Output:
        found = families(asset, _UNREAL, PurePosixPath(name).stem)
        parts = [part for family in found.each for part in _parts(family)]
        hulls = set(found.names.values())
        whose = [part.name if part.name in hulls else SEEN for part in parts for _ in part.surface.faces]
        data = parts_text(parts, words=(b"o", b"g"))
        read = self._check_output(data, Path(name), Wanted(whose, corners_of(parts)), hulls, asset.path)
        names = {name: read.get(now, now) for name, now in found.names.items() if read.get(now, now) != name}
        return Output(data, names=names, lost=found.lost, notes=(_SCALE, *found.notes))


def _parts(family: Family) -> Sequence[Part]:
    """What is seen of a body, and its hulls."""
    seen = [Part(family.name, surface) for surface in family.surfaces]
    hulls = {name: geom.shape.tessellate() for name, geom in family.hulls.items()}
    return [*seen, *(Part(name, Surface(hull.vertices, hull.faces)) for name, hull in hulls.items())]
