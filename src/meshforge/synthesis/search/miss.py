"""What comes nearest where nothing matches, and why nothing can."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from meshforge.language import Extractor
from meshforge.symbolic import bits
from meshforge.synthesis.example import Example
from meshforge.synthesis.search.field import Field


@dataclass(frozen=True, slots=True)
class NearMiss:
    """An extractor that nearly matches, and how it differs on the mesh where it differs most.

    extra: names of hulls it selects though they were not shown; missing: names of those it leaves out.
    """

    extractor: Extractor
    asset: str
    extra: tuple[str, ...]
    missing: tuple[str, ...]


class Errors:
    """Counts the demonstrated hulls on which a selection of groups is wrong.

    The weights of all groups are kept as planes of binary digits, so that a count takes a few operations on bit sets.
    """

    def __init__(self, field: Field, selections: Sequence[int], width: int) -> None:
        shown, others = [0] * width, [0] * width
        for mask, groups in zip(selections, field.groups, strict=False):
            for hull, group in enumerate(groups):
                (shown if mask >> hull & 1 else others)[group] += 1
        self._missed, self._extra = _planes(shown), _planes(others)

    def count(self, chosen: int) -> int:
        """How many hulls a selection of groups has too many or too few."""
        extra = sum((chosen & plane).bit_count() << k for k, plane in enumerate(self._extra))
        return extra + sum((~chosen & plane).bit_count() << k for k, plane in enumerate(self._missed))


def near_miss(extractor: Extractor, field: Field, examples: Sequence[Example]) -> NearMiss:
    """Where and how an extractor's selection differs from what was shown."""
    found = field.bits(extractor)
    on = [field.on(found, k) for k in range(len(examples))]
    extra = [mask & ~example.selection for mask, example in zip(on, examples, strict=True)]
    missing = [example.selection & ~mask for mask, example in zip(on, examples, strict=True)]
    worst = max(range(len(examples)), key=lambda k: (extra[k].bit_count() + missing[k].bit_count(), -k))
    example = examples[worst]
    return NearMiss(extractor, example.name, _names(example, extra[worst]), _names(example, missing[worst]))


def lookalikes(field: Field, selections: Sequence[int], examples: Sequence[Example]) -> str | None:
    """A sentence on two hulls that no extractor tells apart though only one of them was selected."""
    found = field.find_conflict(selections)
    if not found:
        return None
    shown, other = (f"{examples[mesh].mesh.hulls[hull].name!r} of {examples[mesh].name}" for mesh, hull in found)
    return (
        f"{shown} was selected and {other} was not, yet every extractor treats them alike; "
        "a label of its own for one of them would tell them apart"
    )


def _names(example: Example, mask: int) -> tuple[str, ...]:
    return tuple(example.mesh.hulls[index].name for index in sorted(bits(mask)))


def _planes(weights: Sequence[int]) -> list[int]:
    """Bit set k holds the positions whose weight has binary digit k."""
    return [
        sum(1 << place for place, weight in enumerate(weights) if weight >> k & 1)
        for k in range(max(weights, default=0).bit_length())
    ]
