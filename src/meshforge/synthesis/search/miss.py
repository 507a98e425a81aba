"""What comes nearest where nothing matches, and why nothing can."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from meshforge.language import Extractor
from meshforge.symbolic import bits
from meshforge.synthesis.example import Example
from meshforge.synthesis.search.atoms import split_by
from meshforge.synthesis.search.columns import positions
from meshforge.synthesis.search.space import Space
from meshforge.synthesis.search.term import Term


@dataclass(frozen=True, slots=True)
class NearMiss:
    """An extractor that nearly matches, and how it differs on the mesh where it differs most.

    extra: names of hulls it selects though they were not shown; missing: names of those it leaves out.
    """

    extractor: Extractor
    asset: str
    extra: tuple[str, ...]
    missing: tuple[str, ...]


def nearest_term(terms: Iterable[Term], groups: Sequence[int], target: int) -> Term | None:
    """The term that differs from the target by the fewest hulls; of equals, the first in the order."""
    gain = [(group & ~target).bit_count() - (group & target).bit_count() for group in groups]
    return min(terms, key=lambda term: (sum(gain[p] for p in positions(term.bits)), term.key), default=None)


def near_miss(term: Term, groups: Sequence[int], target: int, examples: Sequence[Example], space: Space) -> NearMiss:
    """Where and how a term's selection differs from the target."""
    found = sum(groups[p] for p in positions(term.bits))
    extra, missing = space.split(found & ~target), space.split(target & ~found)
    worst = max(range(len(examples)), key=lambda k: (extra[k].bit_count() + missing[k].bit_count(), -k))
    example = examples[worst]
    return NearMiss(term.extractor, example.name, _names(example, extra[worst]), _names(example, missing[worst]))


def lookalikes(groups: Sequence[int], target: int, examples: Sequence[Example], space: Space) -> str | None:
    """A sentence on two hulls that no extractor tells apart though only one of them was selected."""
    split = split_by(target, groups)
    if not split:
        return None
    shown = _first_named(examples, space.split(split[0] & target))
    other = _first_named(examples, space.split(split[0] & ~target))
    return (
        f"{shown} was selected and {other} was not, yet every extractor treats them alike; "
        "a label of its own for one of them would tell them apart"
    )


def _names(example: Example, mask: int) -> tuple[str, ...]:
    return tuple(example.mesh.hulls[index].name for index in sorted(bits(mask)))


def _first_named(examples: Sequence[Example], masks: Sequence[int]) -> str:
    return next(f"{_names(e, mask)[0]!r} of {e.name}" for e, mask in zip(examples, masks, strict=True) if mask)
