"""The names of collision elements, as they read back: those of their links and their own, or a number."""

from __future__ import annotations

from collections.abc import Sequence

from meshforge.asset import unique_names
from meshforge.formats.slots import Slot


def piece_names(elements: Sequence[tuple[str, str | None, int]]) -> list[tuple[str, ...]]:
    """The names that the pieces of collision elements read as; for each element its link, name attribute and pieces.

    `link/name`, or `link/geomK` where the K-th element of a link has no name; `#k` for one of several pieces.
    """
    count: dict[str, int] = {}
    bases = []
    for link, name, _ in elements:
        bases.append(f"{link}/{name or 'geom' + str(count.get(link, 0))}")
        count[link] = count.get(link, 0) + 1
    each = [
        [base] if pieces == 1 else [f"{base}#{k}" for k in range(pieces)]
        for base, (_, _, pieces) in zip(unique_names(bases), elements, strict=True)
    ]
    unique = iter(unique_names(name for names in each for name in names))
    return [tuple(next(unique) for _ in names) for names in each]


def settle(slots: Sequence[Slot]) -> dict[str, str]:
    """Name the elements, given in the order of the output, that would else read back under other names.

    Returns the names that cannot be had all the same, with what they read back as: a hull of a format whose names do
    not begin with the body, or an element that its author called like a piece of another.
    """
    for _ in range(4):
        for slot, _names in _misread(slots):
            slot.name = attribute_for(slot)
    return {wanted: name for slot, names in _misread(slots) for wanted, name in zip(slot.names, names, strict=True)}


def _misread(slots: Sequence[Slot]) -> list[tuple[Slot, tuple[str, ...]]]:
    """The elements that read back under other names, with these."""
    read = piece_names([(slot.body, slot.name, len(slot.names)) for slot in slots])
    return [(slot, names) for slot, names in zip(slots, read, strict=True) if names != slot.names]


def attribute_for(slot: Slot) -> str:
    """The name attribute under which a slot's pieces have their names: that of the first, without link and `#0`."""
    name = slot.names[0].removeprefix(f"{slot.body}/")
    return name if len(slot.names) == 1 else name.removesuffix("#0")
