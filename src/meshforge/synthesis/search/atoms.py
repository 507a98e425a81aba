"""Hulls that no extractor can tell apart, taken as one: the search reasons about these groups only."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def atoms(masks: Iterable[int], everything: int) -> tuple[int, ...]:
    """The largest groups of hulls that every mask holds wholly or not at all, in order of their first hull.

    Set operators cannot split such a group either: a selection that does has no extractor of any size.
    """
    groups = [everything] if everything else []
    for mask in masks:
        groups = [part for group in groups for part in (group & mask, group & ~mask) if part]
    return tuple(sorted(groups, key=lambda group: group & -group))


def singles(everything: int) -> tuple[int, ...]:
    """Every hull as a group of its own."""
    return tuple(1 << k for k in range(everything.bit_length()) if everything >> k & 1)


def packed(mask: int, groups: Sequence[int]) -> int:
    """The mask over groups instead of hulls: bit k is set where group k touches the mask."""
    return sum(1 << k for k, group in enumerate(groups) if group & mask)


def split_by(mask: int, groups: Iterable[int]) -> tuple[int, ...]:
    """The groups that the mask splits."""
    return tuple(group for group in groups if group & mask not in (0, group))
