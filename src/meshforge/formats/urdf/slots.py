"""The collision elements of an edited URDF, before they are text: which pieces stand in each, under which names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from meshforge.formats.urdf.document import piece_names
from meshforge.formats.xml import Element, Splice, attribute, spliced, without_comments

_NEW = Element("collision", {}, line=0, start=0, inside=len(b"<collision>"))


@dataclass(slots=True, eq=False)
class Slot:
    """One `<collision>` of the output.

    names: what its pieces must read back as; name: its name attribute, which `settle` sets where it must be;
    source: the authored element that it is, or is copied from with `edits`; a copy leaves the comments out.
    text: of an element without a source.
    """

    link: str
    names: tuple[str, ...]
    name: str | None = None
    source: Element | None = None
    edits: tuple[Splice, ...] = ()
    copy: bool = False
    text: bytes = b""

    @property
    def untouched(self) -> bool:
        """Whether it is an element of the file to which nothing is done."""
        same_name = self.source is not None and self.name == self.source.attributes.get("name")
        return same_name and not self.edits and not self.copy

    def written(self, data: bytes) -> bytes:
        """Its text; data: the authored document."""
        if self.source is None:
            return spliced(self.text, [attribute(self.text, _NEW, "name", self.name)])
        edits = self.edits
        if self.name != self.source.attributes.get("name"):
            edits = (*edits, attribute(data, self.source, "name", self.name))
        text = spliced(data, edits, self.source.start, self.source.end)
        return without_comments(text) if self.copy else text


def settle(slots: Sequence[Slot]) -> dict[str, str]:
    """Name the elements, given in the order of the output, that would else read back under other names.

    Returns the names that cannot be had all the same, with what they read back as: a hull of a format whose names do
    not begin with the body, or an element that its author called like a piece of another.
    """
    for _ in range(4):
        for slot, _names in _misread(slots):
            slot.name = _attribute_for(slot)
    return {wanted: name for slot, names in _misread(slots) for wanted, name in zip(slot.names, names, strict=True)}


def _misread(slots: Sequence[Slot]) -> list[tuple[Slot, tuple[str, ...]]]:
    """The elements that read back under other names, with these."""
    read = piece_names([(slot.link, slot.name, len(slot.names)) for slot in slots])
    return [(slot, names) for slot, names in zip(slots, read, strict=True) if names != slot.names]


def _attribute_for(slot: Slot) -> str:
    """The name attribute under which a slot's pieces have their names: that of the first, without link and `#0`."""
    name = slot.names[0].removeprefix(f"{slot.link}/")
    return name if len(slot.names) == 1 else name.removesuffix("#0")
