"""How believable each reading is: the weights, but for what leaves cost themselves, and what was measured.

A reading's weight is exp(-nats), its belief the share of its weight in that of all readings of the rule. The nats
are linear in the features below; the factors are the most likely ones given rules of known meaning: those of the
benchmark's tasks on its calibration set, which count twice, and 54 extractors on four families of boxes,
demonstrated on one, two or three meshes (`script/bench calibrate` fits them anew, and judges them on rules that
were not fitted).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import assert_never

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats
from meshforge.language import Diff, Extractor, Leaf
from meshforge.symbolic import bits_of, descriptors
from meshforge.synthesis.search.bank import unpack_bits
from meshforge.synthesis.search.observation_table import ObservationTable
from meshforge.synthesis.search.terms import Compound, Term

NODE = 0.36
"""For each syntax node."""
UNTRIED = 1.6
"""For each set operator with an operand that makes no difference on the demonstrated meshes. Measured was 1.1, where
demonstrations were drawn blindly; a person shows what is wanted on a mesh that has it."""
UNNEEDED = 0.9
"""For each `Attach` or `Geo` that leaves nothing out of its base on the demonstrated meshes."""
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

STRANGE_LABEL = 3.0
"""A hull whose label no demonstrated hull has counts as at least so far from them, in standard deviations."""


def compute_beliefs(
    terms: Sequence[Term],
    found: "Sequence[CandidateEvidence]",
    shown: int,
    assets: int,
    against: Sequence[float] | None = None,
    unneeded: Sequence[int] | None = None,
) -> tuple[float, ...]:
    """Return the belief in each of the consistent terms of a rule, in 0..1, in all 1.

    found: what the batch says of each; shown: the groups of demonstrated hulls; assets: that are not demonstrated.
    against: what a person said against each of the terms [nats]; unneeded: how much in each of them
    leaves nothing out of its label on the demonstrated meshes.
    """
    share, leaves, none = assets / (assets + FEW), dict[Extractor, float](), [0] * len(terms)
    nats = [
        NODE * term.size
        + _prior_nats(term, leaves)
        + UNTRIED * count_untested(term, shown)
        + UNNEEDED * idle
        + share * (IDLE * facts.idle + STRANGE * min(facts.strange, STRANGEST))
        + other
        for term, facts, other, idle in zip(terms, found, against or none, unneeded or none, strict=True)
    ]
    least = min(nats)
    weights = [math.exp(least - nat) for nat in nats]
    total = math.fsum(weights)
    return tuple(weight / total for weight in weights)


def choose_candidate(terms: Sequence[Term], shares: Sequence[float]) -> int:
    """Return the place of the reading to take: a smallest one, unless a larger is far more believable."""
    smallest = min(term.size for term in terms)
    best = max(range(len(terms)), key=lambda k: (shares[k], -k))
    first = max((k for k in range(len(terms)) if terms[k].size == smallest), key=lambda k: (shares[k], -k))
    return best if shares[best] >= LARGER * shares[first] else first


def _prior_nats(term: Term, known: dict[Extractor, float]) -> float:
    made = term.form
    if isinstance(made, Compound):
        return _prior_nats(made.left, known) + _prior_nats(made.right, known)
    if made not in known:
        known[made] = made.cost
    return known[made]


@dataclass(frozen=True, slots=True)
class CandidateEvidence:
    """Of one reading: the share of the assets where it selects nothing; and how far the hulls that it selects on the
    others are from the nearest demonstrated one, squared, in standard deviations of the descriptors.
    """

    idle: float
    strange: float


NO_EVIDENCE = CandidateEvidence(0.0, 0.0)


def measure_evidence(
    field: ObservationTable, selections: Sequence[int], candidates: Sequence[int]
) -> tuple[CandidateEvidence, ...]:
    """Return the evidence on some readings, given as groups of the field.

    selections: the hulls that were shown on each of the field's first meshes, as bit sets; the batch is the rest.
    """
    shown, rest = len(selections), len(field.meshes) - len(selections)
    counts = np.array([len(mesh.hulls) for mesh in field.meshes[shown:]], dtype=np.int64)
    if not rest or not counts.sum() or not any(selections):
        return tuple(NO_EVIDENCE for _ in candidates)
    places = np.array([group for groups in field.groups[shown:] for group in groups], dtype=np.int64)
    ends = np.concatenate([[0], np.cumsum(counts)])
    chosen = unpack_bits(candidates, field.width)[:, places]
    many = _sum_by_mesh(chosen.astype(float), ends)
    strange = _sum_by_mesh(chosen * _strangeness(field, selections), ends)
    active = many > 0
    strangeness = np.where(active, strange / np.maximum(many, 1), 0.0).sum(axis=1) / np.maximum(active.sum(axis=1), 1)
    idle = 1 - active.mean(axis=1)
    return tuple(CandidateEvidence(*row) for row in zip(idle.tolist(), strangeness.tolist(), strict=True))


def _strangeness(field: ObservationTable, selections: Sequence[int]) -> Floats:
    """How far each hull of the batch is from the nearest demonstrated one, squared."""
    from scipy.spatial import cKDTree  # lazy: 0.5 s, half of all imports

    rows = descriptors(field.meshes)
    rows = rows / np.maximum(rows.std(axis=0), 1e-9)
    starts = np.concatenate([[0], np.cumsum([len(mesh.hulls) for mesh in field.meshes])]).astype(int)
    hulls = [hull for mesh in field.meshes for hull in mesh.hulls]
    first = int(starts[len(selections)])
    shown = [
        int(start) + hull for start, mask in zip(starts, selections, strict=False) for hull in sorted(bits_of(mask))
    ]
    far = cKDTree(rows[shown]).query(rows[first:])[0]
    known = {hulls[place].label for place in shown}
    unknown = np.array([hull.label not in known for hull in hulls[first:]])
    return np.where(unknown, np.maximum(far, STRANGE_LABEL), far) ** 2


def _sum_by_mesh(values: Floats, ends: npt.NDArray[np.int64]) -> Floats:
    total = np.concatenate([np.zeros((len(values), 1)), np.cumsum(values, axis=1)], axis=1)
    summed: Floats = total[:, ends[1:]] - total[:, ends[:-1]]
    return summed


def count_untested(term: Term, shown: int) -> int:
    """Return how many set operators in a term could lose an operand without a difference on the demonstrated meshes.

    shown: the groups of demonstrated hulls.
    """
    made = term.form
    if not isinstance(made, Compound):
        return 0
    left, right = made.left.bits & shown, made.right.bits & shown
    idle = not left & right if made.operator is Diff else not left & ~right or not right & ~left
    return idle + count_untested(made.left, shown) + count_untested(made.right, shown)


def count_idle(term: Term, shown: int, field: ObservationTable) -> int:
    """Return how many leaves in a term leave nothing out of their base on the demonstrated meshes.

    shown: the groups of demonstrated hulls.
    """
    made = term.form
    match made:
        case Compound():
            return count_idle(made.left, shown, field) + count_idle(made.right, shown, field)
        case Leaf():
            return int(bool(made.bases) and field.bits(made.bases[0]) & shown == term.bits & shown)
        case _:
            assert_never(made)
