"""The geoms of an edited MJCF, before they are text: those of the file, kept or gone, and new ones."""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass, field

from meshforge.asset import Asset, Geom
from meshforge.formats.mjcf.document import Authored, MjcfDocument
from meshforge.formats.mjcf.files.sources import Node
from meshforge.formats.slots import Slot


@dataclass(slots=True, eq=False)
class Place:
    """A `<geom>` of the file: its element, None for one out of another model, and what is made of it.

    own: itself, None where it goes; after: the new elements that follow it.
    """

    authored: Authored
    node: Node | None
    own: Slot | None
    after: list[Slot] = field(default_factory=list)


@dataclass(frozen=True, slots=True, eq=False)
class Kept:
    """A geom of the model as read: its number there, and the element that may get a name attribute, None if fixed."""

    number: int
    slot: Slot | None


@dataclass(frozen=True, slots=True, eq=False)
class Made:
    """A new geom: its element, and its hull."""

    slot: Slot
    geom: Geom


def is_edited(asset: Asset, document: MjcfDocument) -> bool:
    """Whether any hull is made, or gone."""
    kept, owned = kept_names(asset), {name for authored in document.authored for name in authored.names}
    gone = any(removed_names(authored, kept) for authored in document.authored)
    return gone or any(geom.parent is not None or geom.name not in owned for geom in asset.geoms)


def kept_names(asset: Asset) -> set[str]:
    """The names of the collision geoms that stay as they were."""
    return {geom.name for geom in asset.geoms if geom.parent is None} | {opaque.name for opaque in asset.opaque}


def removed_names(authored: Authored, kept: Container[str]) -> list[str]:
    """The hulls of an element that an edit takes away."""
    return [name for name in authored.names if name not in kept] if authored.collides else []
