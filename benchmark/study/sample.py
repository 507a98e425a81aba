"""Which results a guided person looks at before keeping a program: a dozen, the most revealing first."""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import islice
from math import exp

from benchmark.study.condition import SEEN
from meshforge.label_model import LabelBeliefs
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import LearningOutcome
from meshforge.synthesis.repair.explain import DISTRUST_PER_ERROR


def select_sample(
    outcome: LearningOutcome, meshes: Mapping[str, SymbolicMesh], labels: Sequence[str], known: Collection[str]
) -> list[str]:
    """The meshes whose results to look at; none of those that are known.

    First each time the mesh on which most belief is in candidates that none before it would refute, then the one that
    stands for most hulls unlike any before. Each counts less for each label that is expected to be wrong.
    """
    errors = LabelBeliefs({}, meshes, labels).errors
    trust = {name: exp(-DISTRUST_PER_ERROR * errors.get(name, 0.0)) for name in sorted(meshes) if name not in known}
    chosen = list(islice(_rank_by_difference(outcome, trust), SEEN))
    rest = {name: worth for name, worth in trust.items() if name not in chosen}
    return [*chosen, *islice(_rank_by_novelty(meshes, rest, [*known, *chosen]), SEEN - len(chosen))]


def _rank_by_difference(outcome: LearningOutcome, trust: Mapping[str, float]) -> Iterator[str]:
    """Meshes one by one, each the one with most belief in candidates that do as the program on all before it."""
    left = list(outcome.candidates)
    while True:
        stake = {name: round(sum(one.belief for one in left if name in one.differs_on), 12) for name in trust}
        best = max(trust, key=lambda name: stake[name] * trust[name], default=None)
        if best is None or not stake[best]:
            return
        yield best
        left = [one for one in left if best not in one.differs_on]


def _rank_by_novelty(
    meshes: Mapping[str, SymbolicMesh], trust: Mapping[str, float], before: Collection[str]
) -> Iterator[str]:
    """Meshes one by one, each the one whose kinds of hulls stand for most hulls that are unlike any before."""
    kinds = {name: _list_kinds(mesh) for name, mesh in meshes.items()}
    many = Counter(kind for some in kinds.values() for kind in some)
    seen, rest = {kind for name in before for kind in kinds.get(name, ())}, list(trust)
    while rest:
        best = max(rest, key=lambda name: trust[name] * sum(many[kind] for kind in set(kinds[name]) - seen))
        yield best
        rest.remove(best)
        seen.update(kinds[best])


def _list_kinds(mesh: SymbolicMesh) -> list[tuple[str, ...]]:
    """Of each hull its label, and those of the hulls that it touches."""
    words = [str(hull.label) for hull in mesh.hulls]
    return [(words[k], *sorted({words[other] for other in mesh.neighbours(k)})) for k in range(len(words))]
