"""The labels that a learned program may ask for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from meshforge.errors import DemonstrationError, nearest
from meshforge.language import Orient, Program
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.demonstration import Demonstration, named


def learned_vocabulary(
    demos: Sequence[Demonstration],
    batch: Iterable[SymbolicMesh],
    orient: Orient | None,
    given: Sequence[str] | None,
) -> tuple[str, ...]:
    """The given vocabulary, or else every label of the meshes, the steps and the orientation, sorted.

    Raises DemonstrationError for a demonstration with a label that a given vocabulary lacks.
    """
    landmarks = Program(orient=orient).labels_in_use
    if given is None:
        meshes = [*(demo.mesh for demo in demos), *batch]
        on_hulls = {hull.label for mesh in meshes for hull in mesh.hulls if hull.label}
        return tuple(sorted({*on_hulls, *landmarks, *(label for demo in demos for label in _given_in(demo))}))
    for name, demo in named(demos):
        for hull in demo.mesh.hulls:
            if hull.label:
                _check(hull.label, given, f"{name}, hull {hull.name!r}")
        for label in _given_in(demo):
            _check(label, given, f"{name}, steps")
    return tuple(given)


def _given_in(demo: Demonstration) -> list[str]:
    """The labels that steps give to what they make."""
    return [step.label for step in demo.steps if step.label]


def _check(label: str, vocabulary: Sequence[str], where: str) -> None:
    if label not in vocabulary:
        like = nearest(label, vocabulary)
        hint = f"Did you mean {like!r}? " if like else ""
        raise DemonstrationError(
            f"the label {label!r} is not in the vocabulary",
            where=where,
            remedy=f"{hint}The vocabulary is {', '.join(vocabulary) or 'empty'}.",
        )
