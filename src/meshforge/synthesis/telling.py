"""Which mesh to demonstrate first: the one on which selections that people mean can best be told apart."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import permutations

from meshforge.errors import MeshForgeError
from meshforge.language import EXTREMITY, Attach, Extractor, Geo, Is, Orient, select_mask, stage
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.remember import remembered

HULL, DOUBTFUL = 0.15, 6.0
"""What a mesh must tell apart for each hull more, which is more to show, and for each label that is expected to be
wrong by its confidence, in selections. Measured on the calibration set (`script/bench tuning`): with true labels as
many sessions end right as without, 118 of 120; with noisy ones 99 instead of 85."""


def most_telling(
    meshes: Mapping[str, SymbolicMesh],
    vocabulary: Sequence[str],
    orient: Orient | None = None,
    contact: float | None = None,
    extremity: float | None = None,
) -> str | None:
    """The id of the mesh on which the small selections that people mean come out in most different ways, for its hulls
    and the labels that may be wrong.

    Of equals the first. None where no mesh can be turned as `orient` says, or none has
    a label. orient, contact, extremity: as of `synthesize`.
    """
    delta = EXTREMITY if extremity is None else extremity
    worth: dict[str, float] = {}
    for name, mesh in meshes.items():
        try:
            told = _told_apart(mesh, vocabulary, orient, contact, delta)
        except MeshForgeError:
            continue
        if told > 1:
            worth[name] = told - HULL * len(mesh.hulls) - DOUBTFUL * doubtful(mesh)
    return max(worth, key=worth.__getitem__, default=None)


def doubtful(mesh: SymbolicMesh) -> float:
    """How many labels are expected to be wrong or missing."""
    return sum(1 - (hull.annotation.confidence if hull.annotation else 0) for hull in mesh.hulls)


def _told_apart(
    mesh: SymbolicMesh, vocabulary: Sequence[str], orient: Orient | None, contact: float | None, delta: float
) -> int:
    """How many different sets of hulls are selected on a mesh, the empty one too."""

    def count() -> int:
        staged = remembered(mesh, (orient, contact), SymbolicMesh, lambda: stage(mesh, orient, contact)[0])
        used = [label for label in vocabulary if any(hull.label == label for hull in staged.hulls)]
        return len({0, *(select_mask(one, staged, delta) for one in _small(used))})

    return remembered(mesh, ("told apart", tuple(vocabulary), orient, contact, delta), int, count)


def _small(labels: Sequence[str]) -> Iterator[Extractor]:
    """A label alone, those of its hulls that touch another label, and its highest and lowest ones."""
    yield from map(Is, labels)
    yield from (Attach(Is(one), Is(other)) for one, other in permutations(labels, 2))
    yield from (Geo(Is(one), up) for one in labels for up in ("+Z", "-Z"))
