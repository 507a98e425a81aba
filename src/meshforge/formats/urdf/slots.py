"""The names of the collision elements of an edited URDF."""

from __future__ import annotations

from collections.abc import Sequence

from meshforge.formats.slots import Slot
from meshforge.formats.urdf.document import piece_names


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
    read = piece_names([(slot.body, slot.name, len(slot.names)) for slot in slots])
    return [(slot, names) for slot, names in zip(slots, read, strict=True) if names != slot.names]


def _attribute_for(slot: Slot) -> str:
    """The name attribute under which a slot's pieces have their names: that of the first, without link and `#0`."""
    name = slot.names[0].removeprefix(f"{slot.body}/")
    return name if len(slot.names) == 1 else name.removesuffix("#0")
