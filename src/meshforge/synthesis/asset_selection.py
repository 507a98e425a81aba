"""Which asset to demonstrate first, and which to ask about."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import permutations

from meshforge import language
from meshforge.common import MeshForgeError
from meshforge.label_model import LabelBeliefs
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.candidates.rank import RankedCandidates
from meshforge.synthesis.demonstration import OpenRule
from meshforge.synthesis.task import memoize

MAX_NEITHER_ANSWERS = 4
"""After so many answers that neither choice is right a rule is not asked about: what is meant is none of its readings,
or too many labels are wrong."""

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
