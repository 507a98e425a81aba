"""The posterior over the labels of a family: a log-linear model over a few sums of evidence, applied in rounds, each on
the probabilities of the one before (auto-context, Tu 2008). The weights of each round were fitted by the log loss of
the true label on calibration families (`python -m benchmark.labels consensus`). How reliable each source of labels is
in a family is found together with the labels by expectation maximization (Dawid and Skene 1979)."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.label_model.lookalikes import PER_MESH, Places
from meshforge.label_model.table import NO_LABEL, Bools, FamilyTable, Observations, read_weights
from meshforge.symbolic import LABEL_SOURCES

WEIGHTS_FILE = "consensus.json"
EVIDENCE = (
    "what its source says",
    "whether the source errs on this kind here",
    "what its source says, where look-alikes are far",
    "whether the source errs on this kind here, where look-alikes are far",
    "its nearest hulls",
    "hulls of other meshes",
    "hulls of other meshes together",
    "hulls of its own mesh",
    "how common the label is",
    "hulls that it touches",
)
"""What the columns of `collect_evidence` are, in words."""

_OF_OTHERS = slice(4, None)

PERSON = 0.9995
"""How much a person's label is believed."""
_CERTAIN = 0.8  # from which probability on a hull of which nothing is said helps with others
_HELP = 0.5  # what such a hull counts
_UNSAID = 0.3  # what a hull of which nothing is said counts for how common a label is
_DISTINCT, _NEAREST = 12, 12  # look-alikes of distinct meshes, and the nearest
_TOGETHER = 10  # look-alikes of distinct meshes whose evidence is multiplied
_ALIKE, _SOFT = 9.0, 1.5  # the distance at which two hulls are half alike, and how soon it ends
_ALIKE_NEAREST, _ALIKE_OWN = 10.0, 7.0
_FAR, _SOFT_FAR = 6.5, 1.0  # the distance of the nearest look-alike at which it is half far, and how soon
_AT_MOST = 0.97  # to which degree two hulls are alike
_TWINS = 1.5  # the distance up to which hardly anything tells two hulls of a mesh apart
_PRIOR_SHARE = 0.3  # of the prior beside look-alikes
_START = 0.9  # what each label is believed at the start
_NOBODY_GAVE = 1.0
"""What speaks in each round for a label of the vocabulary that nothing gives yet [nats]: on calibration families of
which one, two or three assets are labelled, such labels then have 17, 10 and 6% of the probability, and 16, 12 and 7%
of the hulls; with nothing for them 4, 2 and 1%."""
_PAIRS = 0.5  # pairs of labels count as having touched so often before any are seen

EXPECTED = {"file": 0.97, "name": 0.95}
"""The share of right labels that is assumed of a source before any is looked at."""
EXPECTED_OF_OTHERS = 0.9
_COUNTS_FOR = 20.0  # hulls that this assumption counts for
_RIDGE = 10.0  # what holds the slope in the confidence near 0
_FIT_STEPS = 8
_LEAST_RATE, _MOST_RATE = 0.03, 0.997  # bounds of a reliability
_COUNTS_FOR_KIND = 2.0  # hulls that the mean of a source counts for in one kind of part of one mesh


def infer_chances(
    table: FamilyTable, seen: Observations, weights: Floats | None = None, evidence: Floats | None = None
) -> tuple[Floats, Floats]:
    """Return the probability of each label that anything says for each hull of a family: by all, and but for what is
    said of the hull itself. Both (n, labels).

    evidence: (n, labels), more that speaks for each label of each hull [nats].
    """
    seen = _drop_outweighed(table, seen)
    context = FamilyContext(table, seen)
    chances = by_others = context.start()
    more = np.where(np.isin(np.arange(context.count), seen.codes), 0.0, _NOBODY_GAVE)
    more = more if evidence is None else more + evidence
    for row in read_weights(WEIGHTS_FILE) if weights is None else weights:
        scores = context.collect_evidence(chances)
        scores *= row
        by_others = softmax(scores[:, :, _OF_OTHERS].sum(axis=2))
        chances = context.fix_known(softmax(scores.sum(axis=2) + more))
        del scores
    return chances, by_others


def _drop_outweighed(table: FamilyTable, seen: Observations) -> Observations:
    """What is said but for labels of another family where a hull that looks alike was labelled otherwise by a person,
    which those, being more, would outweigh: with one of eight real cabinets labelled by hand 0.67 of the others' hulls
    get the right label so, else 0.32; of tables 0.53 and 0.49, of chairs and cups as many."""
    like = seen.known & (seen.sources == LABEL_SOURCES.index("like"))
    if not like.any() or not seen.fixed.any():
        return seen
    hulls, apart = (found[:, 0] for found in table.find_lookalikes(seen).nearest(seen.fixed, 1, 1))
    outweighed = like & (apart <= _ALIKE_NEAREST) & (seen.codes[hulls] != seen.codes)
    return replace(seen, codes=np.where(outweighed, NO_LABEL, seen.codes))


def softmax(scores: Floats) -> Floats:
    """Return scores (n, k) [nats] as probabilities."""
    weights = np.exp(scores - scores.max(axis=1, keepdims=True, initial=-np.inf))
    found: Floats = weights / weights.sum(axis=1, keepdims=True)
    return found


class _Helpers(NamedTuple):
    """Hulls that say something about others. usable: (n,); worth: (n,) what each counts."""

    usable: Bools
    worth: Floats


class FamilyContext:
    """A family with what is said of it, to be weighed round by round."""

    def __init__(self, table: FamilyTable, seen: Observations) -> None:
        from scipy.sparse import csr_matrix  # lazy: 0.5 s, half of all imports

        self.table, self.seen, self.count = table, seen, len(seen.labels)
        self.free = seen.known & ~seen.fixed
        self.lookalikes = table.find_lookalikes(seen)
        a, b = table.touching.T
        n = len(table.owner)
        links = csr_matrix((np.ones(2 * len(a)), (np.concatenate([a, b]), np.concatenate([b, a]))), shape=(n, n))
        degree = np.maximum(np.bincount(table.touching.ravel(), minlength=n), 1)
        self.links, self.degree = links, degree[:, None]
        _, apart = self.lookalikes.nearest(np.ones(n, np.bool_), 1, 1)
        self.far = 1 - _alike(np.where(np.isfinite(apart), apart, 99.0), _FAR, _SOFT_FAR)
        """How far the nearest hull of another mesh is, 0 to 1 (n, 1)."""

    def start(self) -> Floats:
        """Return what the sources say, each believed alike."""
        return self.fix_known(softmax(self._own(np.full(len(self.seen.codes), _START), self.seen.known)))

    def fix_known(self, chances: Floats) -> Floats:
        """Return the same with what people said."""
        fixed = self.seen.fixed
        chances[fixed] = (1 - PERSON) / max(self.count - 1, 1)
        chances[fixed, self.seen.codes[fixed]] = PERSON if self.count > 1 else 1.0
        return chances

    def _own(self, reliability: Floats, which: Bools) -> Floats:
        """The log-likelihood (n, labels) of what is said of some hulls."""
        found = np.zeros((len(which), self.count))
        found[which] = np.log((1 - reliability[which]) / max(self.count - 1, 1))[:, None]
        found[which, self.seen.codes[which]] = np.log(reliability[which])
        return found

    def collect_evidence(self, chances: Floats) -> Floats:
        """Return the evidence (n, labels, len(EVIDENCE)) [nats] on each label of each hull."""
        seen, rows = self.seen, np.arange(len(chances))
        sure = ~seen.known & (chances.max(axis=1, initial=0.0) > _CERTAIN)
        informed = _Helpers(seen.known | sure, np.where(seen.known, 1.0, _HELP))
        counted = chances * np.where(seen.known, 1.0, _UNSAID)[:, None]
        prior = counted.sum(axis=0) + 0.5
        prior /= prior.sum()
        heard = self._mix_twins(chances, informed)
        found = np.zeros((*chances.shape, len(EVIDENCE)))  # filled, not stacked: a tenth of a GiB of a large family
        found[:, :, 4] = np.log(self._share_nearest(heard, informed, prior))
        distinct, found[:, :, 6] = self._share_distinct(heard, informed, prior)
        found[:, :, 5], found[:, :, 7] = np.log(distinct), np.log(self._share_own(chances, informed, prior))
        found[:, :, 8], found[:, :, 9] = np.log(prior), self._hear_neighbors(chances, informed)
        observed = np.maximum(seen.codes, 0)
        by_others = softmax(found[:, :, 4] + 0.5 * found[:, :, 6])[rows, observed]
        reliability = estimate_reliability(seen, self.free, chances[rows, observed])
        kinds = find_wrong_kinds(seen, self.table.owner, self.free, by_others)
        found[self.free, seen.codes[self.free], 1] = kinds[self.free]
        found[:, :, 0] = self._own(reliability, self.free)
        np.multiply(found[:, :, :2], self.far[:, :, None], out=found[:, :, 2:4])
        return found

    def _mix_twins(self, chances: Floats, informed: _Helpers) -> Floats:
        """What hulls say to others: those of one mesh that hardly anything tells apart say what they say on average."""
        twins, apart = self.lookalikes.own, self.lookalikes.own_apart
        same = np.where(informed.usable[twins], np.exp(-((apart / _TWINS) ** 2)), 0.0)
        found: Floats = (chances + _sum_votes(same, chances, twins)) / (1 + same.sum(axis=1))[:, None]
        return found

    def _share_nearest(self, chances: Floats, informed: _Helpers, prior: Floats) -> Floats:
        hulls, apart = self.lookalikes.nearest(informed.usable, _NEAREST, PER_MESH)
        there = np.isfinite(apart)
        gaps = np.where(there, apart, 99.0)
        least = gaps.min(axis=1, keepdims=True)
        votes = np.exp(np.subtract(least, gaps, out=gaps), out=gaps)
        votes *= np.where(there, informed.worth[hulls], 0.0)
        total = votes.sum(axis=1, keepdims=True)
        strange = 0.05 + 0.5 * (1 - _alike(least, _ALIKE_NEAREST)) * total
        found: Floats = (_sum_votes(votes, chances, hulls) + strange * prior) / (total + strange)
        return found

    def _share_distinct(self, chances: Floats, informed: _Helpers, prior: Floats) -> tuple[Floats, Floats]:
        """Of the nearest hulls of distinct meshes the shares of the labels, and their evidence multiplied [nats]."""
        hulls, apart = self.lookalikes.nearest(informed.usable, _DISTINCT, 1)
        there = np.isfinite(apart)
        alike = np.where(there, _alike(np.where(there, apart, 99.0), _ALIKE), 0.0)
        alike *= informed.worth[hulls]
        share = (_sum_votes(alike, chances, hulls) + _PRIOR_SHARE * prior) / (alike.sum(axis=1) + _PRIOR_SHARE)[:, None]
        together = np.zeros_like(chances)
        for place in range(min(_TOGETHER, hulls.shape[1])):
            degree = np.minimum(alike[:, place], _AT_MOST)[:, None]
            together += np.log(degree * chances[hulls[:, place]] + (1 - degree) * prior)
        return share, together

    def _share_own(self, chances: Floats, informed: _Helpers, prior: Floats) -> Floats:
        hulls, apart = self.lookalikes.own, self.lookalikes.own_apart
        there = np.isfinite(apart) & informed.usable[hulls]
        alike = np.where(there, _alike(np.where(there, apart, 99.0), _ALIKE_OWN), 0.0) * informed.worth[hulls]
        total = (alike.sum(axis=1) + _PRIOR_SHARE)[:, None]
        found: Floats = (_sum_votes(alike, chances, hulls) + _PRIOR_SHARE * prior) / total
        return found

    def _hear_neighbors(self, chances: Floats, informed: _Helpers) -> Floats:
        """What hulls in contact say, by how much more often two labels touch than by accident."""
        weighty = chances * (informed.worth * informed.usable)[:, None]
        pairs = weighty.T @ np.asarray(self.links @ weighty) + _PAIRS
        joint = pairs / pairs.sum()
        alone = joint.sum(axis=1)
        bonds = np.log(joint / (alone[:, None] * alone[None]))
        heard: Floats = (self.links @ (chances @ bonds.T)) / self.degree
        return heard


def _alike(apart: Floats, half: float, soft: float = _SOFT) -> Floats:
    found: Floats = 1 / (1 + np.exp((apart - half) / soft))
    return found


def _sum_votes(votes: Floats, chances: Floats, hulls: Places) -> Floats:
    """The sum over k look-alikes (n, k) of votes times their chances: (n, labels)."""
    found = np.zeros((len(votes), chances.shape[1]))
    for place in range(hulls.shape[1]):
        found += votes[:, place, None] * chances[hulls[:, place]]
    return found


def estimate_reliability(seen: Observations, free: Bools, right: Floats) -> Floats:
    """Return the probability (n,) that what is said of each hull is right, by source and confidence.

    free: which hulls a machine speaks of; right: (n,) how probable that is by all that is known.
    """
    found = np.full(len(right), EXPECTED_OF_OTHERS)
    for source in np.unique(seen.sources[free]).tolist():
        mine = free & (seen.sources == source)
        expected = EXPECTED.get(LABEL_SOURCES[source], EXPECTED_OF_OTHERS)
        found[mine] = _fit_rate(seen.confidence[mine], right[mine], expected)
    clipped: Floats = np.clip(found, _LEAST_RATE, _MOST_RATE)
    return clipped


def _fit_rate(confidence: Floats, right: Floats, expected: float) -> Floats:
    """A logistic regression of being right on the logit of the confidence, ridged, with the expectation as a prior."""
    base = (right.sum() + expected * _COUNTS_FOR) / (len(right) + _COUNTS_FOR)
    bounded = np.clip(confidence, 0.02, 0.98)
    x = np.log(bounded / (1 - bounded))
    spread = float(x.std())
    level, slope = float(np.log(base / (1 - base))), 0.0
    if spread < 1e-6:
        return np.full(len(right), base)
    x = (x - x.mean()) / spread
    for _ in range(_FIT_STEPS):
        rate = 1 / (1 + np.exp(-(level + slope * x)))
        weight = np.maximum(rate * (1 - rate), 1e-4)
        at_mean = 1 / (1 + np.exp(-level))
        gradient = np.array(
            [(right - rate).sum() + _COUNTS_FOR * (expected - at_mean), ((right - rate) * x).sum() - _RIDGE * slope]
        )
        cross = float((weight * x).sum())
        curvature = np.array([[weight.sum() + _COUNTS_FOR * 0.09, cross], [cross, (weight * x * x).sum() + _RIDGE]])
        step = np.linalg.solve(curvature, gradient)
        level, slope = level + float(step[0]), slope + float(step[1])
    found: Floats = 1 / (1 + np.exp(-(level + slope * x)))
    return found


def find_wrong_kinds(seen: Observations, owner: Ints, free: Bools, right: Floats) -> Floats:
    """Return how much less reliable what is said is where one label of one mesh is wrong altogether [nats], (n,), at
    most 0.

    right: (n,) the probability that what is said is right by look-alikes alone.
    """
    found = np.zeros(len(right))
    if not free.any():
        return found
    key = owner[free] * len(seen.labels) + seen.codes[free]
    _, kind = np.unique(key, return_inverse=True)
    count, total = np.bincount(kind), np.bincount(kind, right[free])
    mean = float(right[free].mean())
    share = (total + _COUNTS_FOR_KIND * mean) / (count + _COUNTS_FOR_KIND)
    odds = np.log(share / (1 - share + 1e-6)) - np.log(mean / (1 - mean + 1e-6))
    found[free] = np.minimum(odds, 0.0)[kind]
    return found
