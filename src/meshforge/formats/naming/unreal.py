"""The names by which Unreal knows collision: `UCX_table_00` is a hull of the mesh `table` (docs/formats.md)."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import ClassVar

from meshforge.asset import Geom, What
from meshforge.formats.naming.base import EngineNames, Names, cleaned
from meshforge.formats.naming.marks import Unreal

_PREFIXES: dict[str, Unreal] = {"box": "UBX", "sphere": "USP", "capsule": "UCP"}
_ANYWHERE = re.compile(r"UCX|UBX|USP|UCP|MCDCX")  # the FBX importer looks for them anywhere in a name
_REFUSED = r"""["' ,/.:|&!~\\\r\n\t@#(){}\[\]=;^%$`*?<>]+"""  # what names of Unreal's assets may not have
_END = re.compile(r"_(?=[0-9_]*\Z)")

NATIVE = tuple(_PREFIXES)
"""The kinds of shapes, besides hulls, that Unreal makes of a mesh."""


class UnrealNames(EngineNames):
    """A mesh for each body, and hulls that are called after it."""

    engine: ClassVar[Names] = "unreal"
    title: ClassVar[str] = "Unreal"
    holds: ClassVar[frozenset[What]] = EngineNames.holds - {What.OPAQUE} | {What.BOXES, What.SPHERES, What.CAPSULES}
    shows: ClassVar[bool] = True
    takes_opaque: ClassVar[bool] = False
    centred: ClassVar[bool] = False  # its older importers take no notice of where a collision node is

    def body(self, wanted: str) -> str:
        """No prefix in it, nor a number at its end: `leg_01` would take the hull `UCX_leg_01` of `leg`."""
        name = _END.sub("", cleaned(wanted, _REFUSED)) or "part"
        return _ANYWHERE.sub(lambda found: found[0].lower(), name)

    def hull(self, body: str, geom: Geom, number: int, own: str) -> str:
        return f"{prefix_of(geom)}_{body}_{number:02}"


def prefix_of(geom: Geom) -> Unreal:
    """The prefix of a mesh that stands for a shape."""
    return _PREFIXES.get(geom.shape.kind, "UCX")


def next_name(geom: Geom, base: str, names: Iterable[str]) -> str:
    """The name of a new hull of the mesh `base`, with the number after the last of those that there are."""
    taken = [re.fullmatch(rf"U\w\w_{re.escape(base)}_(\d+)", name, re.I) for name in names]
    number = max((int(found[1]) for found in taken if found), default=0) + 1
    return f"{prefix_of(geom)}_{base}_{number:02}"
