"""Which asset to demonstrate first, to ask about, to demonstrate next, or to look at before accepting."""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import islice, permutations

import numpy as np

from meshforge import language
from meshforge.common import MeshForgeError, pluralize
from meshforge.label_model import LabelBeliefs
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.candidates.rank import RankedCandidates
from meshforge.synthesis.demonstration import Hint, OpenRule
from meshforge.synthesis.task import memoize

MAX_NEITHER_ANSWERS = 4
"""After so many answers that neither choice is right a rule is not asked about: what is meant is none of its readings,
or too many labels are wrong."""

SAMPLE_SIZE = 12
"""So many results a person looks at before keeping a program (paper, protocol)."""

_NOTHING = 1e-12  # belief that is none

FieldCandidates = tuple[RankedCandidates, Sequence[str]]
"""The readings of a rule, and the names of the meshes of their field."""

COST_OF_HULL, COST_OF_WRONG_LABEL = 0.15, 8.0
"""What a mesh must tell apart for each hull more, which is more to show, and for each label that is expected to be
wrong, in selections. Measured on the calibration set (`script/bench tuning`): with true labels as many sessions end
right as without, with noisy ones a third of the corrections are spared."""


def find_open_rule(
    rule: int, ranked: RankedCandidates, names: Sequence[str], trust: Mapping[str, float], declined: Collection[str]
) -> OpenRule | None:
    """Return the asset on which an answer about a rule is worth a person's time, None where there is none.

    names: of the meshes of the field; trust: how much an answer about each is worth; declined: those for which a person
    said that neither choice is right.
    """
    if len(declined) >= MAX_NEITHER_ANSWERS:
        return None
    split = ranked.best_question({k: trust[name] for k, name in enumerate(names) if name not in declined})
    if not split or not split.is_worth_asking:
        return None
    field, mesh = ranked.field, ranked.field.meshes[split.asset]
    masks = (field.on(ranked.terms[candidate].bits, split.asset) for candidate in split.choices)
    return OpenRule(rule, names[split.asset], tuple(frozenset(mesh.names_of(mask)) for mask in masks))


def suggest_demonstration(learned: Sequence[tuple[RankedCandidates, Sequence[str]]]) -> Hint | None:
    """Return the asset on which the readings of all rules differ most; else the one with most hulls unlike those shown.

    learned: for each rule its readings, and the names of the meshes of their field.
    """
    gains: dict[str, float] = {}
    for ranked, names in learned:
        for place, gain in ranked.question_value.gains(len(ranked.examples)).items():
            gains[names[place]] = gains.get(names[place], 0.0) + gain
    if gains:
        return Hint(max(gains, key=lambda name: (gains[name], name)), "believable readings of the rules differ there")
    return _suggest_strangest(*learned[0]) if learned else None


def _suggest_strangest(ranked: RankedCandidates, names: Sequence[str]) -> Hint | None:
    field, count = ranked.field, len(ranked.examples)
    shown = (1 << field.width_of(count)) - 1
    fresh = {
        name: sum(not shown >> group & 1 for group in field.groups[place])
        for place, name in enumerate(names[count:], count)
    }
    asset = max(fresh, key=lambda name: (fresh[name], name), default=None)
    if asset is None or not fresh[asset]:
        return None
    return Hint(asset, f"it has {pluralize(fresh[asset], 'hull')} unlike any that was demonstrated")


def select_sample(learned: Sequence[FieldCandidates], trust: Mapping[str, float]) -> tuple[str, ...]:
    """Return the assets whose results to look at, the most revealing first; none of which every rule is known.

    First each time the asset on which most belief is in readings that none before it would refute, then the one that
    stands for most hulls unlike any before. trust: how much each shows; where labels are doubtful less, since what is
    wrong there may be a label.
    """
    known = [set(names[: len(ranked.examples)]) for ranked, names in learned]
    every = {name for _, names in learned for name in names}
    names = sorted(name for name in every if not all(name in some for some in known))
    chosen = list(islice(_rank_by_difference(learned, names, trust), SAMPLE_SIZE))
    for name in (
        _rank_by_novelty(*learned[0], [name for name in names if name not in chosen], chosen, trust) if learned else ()
    ):
        if len(chosen) == SAMPLE_SIZE:
            break
        chosen.append(name)
    return tuple(chosen)


def _rank_by_difference(
    learned: Sequence[FieldCandidates], names: Sequence[str], trust: Mapping[str, float]
) -> Iterator[str]:
    """Assets one by one, each the one on which most belief is in readings that do as the program on all before it."""
    if not learned or not names:
        return
    place = {name: k for k, name in enumerate(names)}
    tables = []
    for ranked, called in learned:
        table = np.zeros((len(ranked.compared), len(names)))
        for row, candidate in enumerate(ranked.compared):
            others = [place[called[k]] for k in ranked.differences(candidate) if called[k] in place]
            table[row, others] = ranked.beliefs[candidate]
        tables.append(table)
    at_stake = np.concatenate(tables)
    weights = np.array([trust[name] for name in names])
    while True:
        gains = at_stake.sum(axis=0)
        best = int(np.argmax(np.round(gains, 12) * weights))
        if gains[best] <= _NOTHING:
            return
        yield names[best]
        at_stake = at_stake[at_stake[:, best] == 0]


def _rank_by_novelty(
    ranked: RankedCandidates,
    called: Sequence[str],
    names: Sequence[str],
    before: Sequence[str],
    trust: Mapping[str, float],
) -> Iterator[str]:
    """Assets one by one, each the one whose hulls stand for most hulls of the batch that are unlike any before."""
    groups = {name: frozenset(some) for name, some in zip(called, ranked.field.groups, strict=True)}
    many = Counter(group for some in groups.values() for group in some)
    seen = {group for name in [*called[: len(ranked.examples)], *before] for group in groups.get(name, ())}
    rest = [name for name in names if name in groups]
    while rest:
        best = max(rest, key=lambda name: trust[name] * sum(many[group] for group in groups[name] - seen))
        yield best
        rest.remove(best)
        seen |= groups[best]


def choose_first_demonstration(
    meshes: Mapping[str, SymbolicMesh],
    vocabulary: Sequence[str],
    orient: language.Orient | None = None,
    contact: float | None = None,
    extremity: float | None = None,
    among: Collection[str] | None = None,
) -> str | None:
    """Return the id of the mesh on which the small selections that people mean come out in most different ways, for its
    hulls and the labels that may be wrong.

    Of equals the first. None where no mesh can be turned as `orient` says, or none has a label. orient, contact,
    extremity: of the program; among: the ids of those in question, by default all: labels are judged by all.
    """
    delta = language.EXTREMITY if extremity is None else extremity
    staged = {name: one for name, mesh in meshes.items() if (one := _stage_or_none(mesh, orient, contact))}
    errors = LabelBeliefs({}, staged, vocabulary).errors
    worth: dict[str, float] = {}
    for name, mesh in staged.items():
        selections = _count_selections(mesh, vocabulary, delta) if among is None or name in among else 0
        if selections > 1:
            worth[name] = selections - COST_OF_HULL * len(mesh.hulls) - COST_OF_WRONG_LABEL * errors[name]
    return max(worth, key=worth.__getitem__, default=None)


def _stage_or_none(mesh: SymbolicMesh, orient: language.Orient | None, contact: float | None) -> SymbolicMesh | None:
    """The mesh as the first rule meets it, None where it cannot be turned so."""
    try:
        return language.to_canonical_frame(mesh, orient, contact, memoize)[0]
    except MeshForgeError:
        return None


def _count_selections(mesh: SymbolicMesh, vocabulary: Sequence[str], delta: float) -> int:
    def count() -> int:
        used = [label for label in vocabulary if any(hull.label == label for hull in mesh.hulls)]
        hulls = language.HullTable([mesh], extremity=delta)
        return len(
            {bytes(len(hulls)), *(language.select_hulls(one, hulls).tobytes() for one in _small_extractors(used))}
        )

    return memoize(mesh, ("told apart", tuple(vocabulary), delta), int, count)


def _small_extractors(labels: Sequence[str]) -> Iterator[language.Extractor]:
    """A label alone, those of its hulls that touch another label, and its highest and lowest ones."""
    yield from map(language.Is, labels)
    yield from (language.Attach(language.Is(one), language.Is(other)) for one, other in permutations(labels, 2))
    yield from (language.Geo(language.Is(one), up) for one in labels for up in ("+Z", "-Z"))
