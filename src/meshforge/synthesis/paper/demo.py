"""One demonstrated mesh of a rule, and what extractors select there under its labels or under others."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from typing import assert_never

from meshforge.language import (
    EXTREMITY,
    All,
    Attach,
    Diff,
    Direction,
    Extractor,
    Geo,
    Intersect,
    Is,
    Union,
    attach_mask,
    geo_mask,
)
from meshforge.synthesis.example import Example

Labels = Mapping[str, int]
"""The hulls of each label, as bit sets."""

Change = tuple[int, str]
"""A hull, by its index, and the label that it gets."""


class Demo:
    """An example with its hulls by label; what is in contact or farthest is looked up once for the same bit sets."""

    def __init__(self, example: Example, extremity: float = EXTREMITY) -> None:
        mesh = self.mesh = example.mesh
        self.name, self.target = example.name, example.selection
        self.everything = (1 << len(mesh.hulls)) - 1
        self.labels = _by_label([hull.label for hull in mesh.hulls])

        @cache
        def attach(selected: int, anchor: int) -> int:
            return attach_mask(mesh, selected, anchor)

        @cache
        def geo(base: int, direction: Direction) -> int:
            return geo_mask(mesh, base, direction, extremity)

        self.attach, self.geo = attach, geo

    def select(self, extractor: Extractor, labels: Labels | None = None) -> int:
        """What an extractor selects, as a bit set; labels: those to go by, without them the mesh's own."""
        labels = self.labels if labels is None else labels
        match extractor:
            case All():
                return self.everything
            case Is(label):
                return labels.get(label, 0)
            case Attach(selected, anchor):
                return self.attach(self.select(selected, labels), self.select(anchor, labels))
            case Geo(base, direction):
                return self.geo(self.select(base, labels), direction)
            case Union(left, right):
                return self.select(left, labels) | self.select(right, labels)
            case Intersect(left, right):
                return self.select(left, labels) & self.select(right, labels)
            case Diff(left, right):
                return self.select(left, labels) & ~self.select(right, labels)
            case _:
                assert_never(extractor)

    def differences(self, extractor: Extractor) -> int:
        """The hulls that an extractor selects though they were not shown, or the other way round, as a bit set."""
        return self.select(extractor) ^ self.target

    def relabel(self, changes: Iterable[Change]) -> Labels:
        """The labels after some changes."""
        labels = dict(self.labels)
        for index, to in changes:
            was = self.mesh.hulls[index].label
            if was is not None:
                labels[was] &= ~(1 << index)
            labels[to] = labels.get(to, 0) | 1 << index
        return labels


def _by_label(labels: Iterable[str | None]) -> dict[str, int]:
    masks: dict[str, int] = {}
    for index, label in enumerate(labels):
        if label is not None:
            masks[label] = masks.get(label, 0) | 1 << index
    return masks
