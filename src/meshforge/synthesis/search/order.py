"""Which of two extractors that select the same a person would rather believe: the order in which the search answers.

The order is total, but for the operands of `Union` and `Intersect` changing places. Putting an earlier part in place
of a part makes the whole earlier, so the earliest extractor is made of earliest parts, and of all parts that select
the same the search may forget all but the first.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, assert_never

from meshforge.language import All, Attach, Base, Diff, Direction, Extractor, Geo, Intersect, Is, Union

Key = tuple[Any, ...]
"""Sorts extractors; entry 0 is the size, entry 1 the doubts."""

Joint = type[Union] | type[Intersect] | type[Diff]

_IS, _ALL, _ATTACH, _GEO = range(4)
JOINT_RANK: Mapping[Joint, int] = {Union: 4, Intersect: 5, Diff: 6}
"""Of equal size and doubts: labels, then contact, then position, then what adds, and last what takes away."""

DIRECTION_RANK: Mapping[Direction, int] = {"+Z": 0, "-Z": 1, "+X": 2, "-X": 3, "+Y": 4, "-Y": 5}
"""Up and down first: an orientation settles them, while the turn about the upright axis is often a convention."""


def leaf_key(leaf: All | Is | Attach | Geo, labels: Mapping[str, int]) -> Key:
    """The key of an extractor without set operators; labels: the place of each label in the vocabulary.

    Doubts count what fits by accident more easily than labels, and contact between two labels, do: `All`; a
    direction, since there are six to try; an `Attach` that is not between two labels, since it tells how parts
    were cut rather than what they are.
    """
    match leaf:
        case Is(label):
            return (1, 0, _IS, labels[label])
        case All():
            return (1, 1, _ALL)
        case Attach(selected, anchor):
            doubts = _all_count(selected, anchor) + (not _between_labels(selected, anchor))
            return (3, doubts, _ATTACH, leaf_key(selected, labels), leaf_key(anchor, labels))
        case Geo(base, direction):
            return (2, 1 + _all_count(base), _GEO, leaf_key(base, labels), DIRECTION_RANK[direction])
        case _:
            assert_never(leaf)


def joint_key(joint: Joint, left: Key, right: Key) -> Key:
    """The key of a set operator over two extractors; the operands of `Union` and `Intersect` count in order."""
    if joint is not Diff and right < left:
        left, right = right, left
    return (1 + left[0] + right[0], left[1] + right[1], JOINT_RANK[joint], left, right)


def order(extractor: Extractor, labels: Mapping[str, int]) -> Key:
    """The key of any extractor: what sorts first is smaller, or as small and more believable."""
    match extractor:
        case Union(left, right) | Intersect(left, right) | Diff(left, right):
            return joint_key(type(extractor), order(left, labels), order(right, labels))
        case All() | Is() | Attach() | Geo():
            return leaf_key(extractor, labels)
        case _:
            assert_never(extractor)


def _all_count(*bases: Base) -> int:
    return sum(isinstance(base, All) for base in bases)


def _between_labels(selected: Base, anchor: Base) -> bool:
    return isinstance(selected, Is) and isinstance(anchor, Is) and selected != anchor
