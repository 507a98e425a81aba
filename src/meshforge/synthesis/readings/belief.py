"""How believable each reading is: the weights, in one place, and what was measured.

A reading's weight is exp(-nats), its belief the share of its weight in that of all readings of the rule. The nats are
linear in the features below; the factors are the most likely ones given rules of known meaning: those of the
benchmark's tasks on its calibration set, which count twice, and 54 extractors on four families of boxes, demonstrated
on one, two or three meshes (`script/bench calibrate` fits them anew, and judges them on rules that were not fitted).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from meshforge.language import All, Attach, Extractor, Geo, Is
from meshforge.synthesis.readings.evidence import Evidence, untried
from meshforge.synthesis.search.term import Joined, Term

NODE = 0.36
"""For each syntax node."""
ALL = 2.6
"""For each `All`: people think in parts."""
UPRIGHT, SIDEWAYS = 0.3, 1.65
"""For each direction: six are tried, so they fit by accident; up and down are meant more often than the others."""
SELF = 6.0
"""For a label attached to itself: that tells how parts were cut rather than what they are."""
UNTRIED = 1.6
"""For each set operator with an operand that makes no difference on the demonstrated meshes. Measured was 1.1, where
demonstrations were drawn blindly; a person shows what is wanted on a mesh that has it."""
UNNEEDED = 0.9
"""For each `Attach` or `Geo` that leaves nothing out of its label on the demonstrated meshes."""
IDLE = 0.11
"""Times the share of assets where it selects nothing: nearly no evidence, since many a rule is about a rare part."""
STRANGE, STRANGEST = 0.23, 9.0
"""Times how unlike the demonstrated hulls the selected ones are, at most so much."""
NEITHER = 3.0
"""For each asset where a person refused what it selects: it is not meant, or a label is wrong there."""
FEW = 5
"""What the batch says counts n / (n + FEW) with n assets that are not demonstrated."""
LARGER = 2.0
"""A reading that is larger than the smallest is taken where it is believed so many times as much."""


def beliefs(
    terms: Sequence[Term],
    found: Sequence[Evidence],
    shown: int,
    assets: int,
    refused: Sequence[int] | None = None,
    unneeded: Sequence[int] | None = None,
) -> tuple[float, ...]:
    """The belief in each of the consistent terms of a rule, in 0..1, in all 1.

    found: what the batch says of each; shown: the groups of demonstrated hulls; assets: that are not demonstrated.
    refused: on how many assets a person refused what each of the terms selects; unneeded: how much in each of them
    leaves nothing out of its label on the demonstrated meshes.
    """
    share, leaves, none = assets / (assets + FEW), dict[Extractor, float](), [0] * len(terms)
    nats = [
        NODE * term.size
        + _doubts(term, leaves)
        + UNTRIED * untried(term, shown)
        + UNNEEDED * idle
        + share * _evidence(facts)
        + NEITHER * against
        for term, facts, against, idle in zip(terms, found, refused or none, unneeded or none, strict=True)
    ]
    least = min(nats)
    weights = [math.exp(least - nat) for nat in nats]
    total = math.fsum(weights)
    return tuple(weight / total for weight in weights)


def taken(terms: Sequence[Term], shares: Sequence[float]) -> int:
    """The place of the reading that the program takes: a smallest one, unless a larger is far more believable."""
    smallest = min(term.size for term in terms)
    best = max(range(len(terms)), key=lambda k: (shares[k], -k))
    first = max((k for k in range(len(terms)) if terms[k].size == smallest), key=lambda k: (shares[k], -k))
    return best if shares[best] >= LARGER * shares[first] else first


def _evidence(facts: Evidence) -> float:
    return IDLE * facts.idle + STRANGE * min(facts.strange, STRANGEST)


def _doubts(term: Term, known: dict[Extractor, float]) -> float:
    made = term.form
    if isinstance(made, Joined):
        return _doubts(made.left, known) + _doubts(made.right, known)
    if made not in known:
        known[made] = _leaf_doubts(made)
    return known[made]


def _leaf_doubts(leaf: All | Is | Attach | Geo) -> float:
    match leaf:
        case All():
            return ALL
        case Is():
            return 0.0
        case Attach(selected, anchor):
            either = ALL * (isinstance(selected, All) + isinstance(anchor, All))
            return either + SELF * (selected == anchor)
        case Geo(base, direction):
            return (UPRIGHT if direction[1] == "Z" else SIDEWAYS) + ALL * isinstance(base, All)
