"""Which mesh to demonstrate first: the one on which selections that people mean can best be told apart."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import permutations

from meshforge.errors import MeshForgeError
from meshforge.language import EXTREMITY, Attach, Extractor, Geo, Is, Orient, select_mask, stage
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.remember import remembered
from meshforge.synthesis.repair import Labels

HULL, WRONG = 0.15, 8.0
"""What a mesh must tell apart for each hull more, which is more to show, and for each label that is expected to be
wrong, in selections. Measured on the calibration set (`script/bench tuning`): with true labels as many sessions end
right as without, with noisy ones a third of the corrections are spared."""


def most_telling(
    meshes: Mapping[str, SymbolicMesh],
    vocabulary: Sequence[str],
    orient: Orient | None = None,
    contact: float | None = None,
    extremity: float | None = None,
    among: Collection[str] | None = None,
) -> str | None:
    """The id of the mesh on which the small selections that people mean come out in most different ways, for its hulls
    and the labels that may be wrong.

    Of equals the first. None where no mesh can be turned as `orient` says, or none has a label. orient, contact,
    extremity: as of `synthesize`; among: the ids of those in question, by default all: labels are judged by all.
    """
    delta = EXTREMITY if extremity is None else extremity
    staged = {name: one for name, mesh in meshes.items() if (one := _staged(mesh, orient, contact))}
    errors = Labels({}, staged, vocabulary).errors
    worth: dict[str, float] = {}
    for name, mesh in staged.items():
        told = _told_apart(mesh, vocabulary, delta) if among is None or name in among else 0
        if told > 1:
            worth[name] = told - HULL * len(mesh.hulls) - WRONG * errors[name]
    return max(worth, key=worth.__getitem__, default=None)


def _staged(mesh: SymbolicMesh, orient: Orient | None, contact: float | None) -> SymbolicMesh | None:
    """The mesh as the first rule meets it, None where it cannot be turned so."""
    try:
        return remembered(mesh, (orient, contact), SymbolicMesh, lambda: stage(mesh, orient, contact)[0])
    except MeshForgeError:
        return None


def _told_apart(mesh: SymbolicMesh, vocabulary: Sequence[str], delta: float) -> int:
    """How many different sets of hulls are selected on a mesh, the empty one too."""

    def count() -> int:
        used = [label for label in vocabulary if any(hull.label == label for hull in mesh.hulls)]
        return len({0, *(select_mask(one, mesh, delta) for one in _small(used))})

    return remembered(mesh, ("told apart", tuple(vocabulary), delta), int, count)


def _small(labels: Sequence[str]) -> Iterator[Extractor]:
    """A label alone, those of its hulls that touch another label, and its highest and lowest ones."""
    yield from map(Is, labels)
    yield from (Attach(Is(one), Is(other)) for one, other in permutations(labels, 2))
    yield from (Geo(Is(one), up) for one in labels for up in ("+Z", "-Z"))
