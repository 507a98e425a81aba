"""Puts like steps together: legs merged one by one are one `Each` step, deletes in a row are one delete."""

from __future__ import annotations

from collections.abc import Sequence

from meshforge.language import Delete, Each
from meshforge.symbolic import SymbolicMesh, components, mask_of
from meshforge.synthesis.demonstration import Step, core


def consolidated(steps: Sequence[Step], mesh: SymbolicMesh) -> tuple[Step, ...]:
    """The steps with like neighbours put together, numbered anew; steps that cannot be are left as they are.

    mesh: the one the steps were done on, for its names and contacts. Two steps are put together where both are
    shown, do the same under the same label, and either delete or act on different connected components of what
    they select together. Hulls that a step made are not in the mesh; steps on them stay apart.
    """
    done: list[Step] = []
    for step in steps:
        both = _both(done[-1], step, mesh) if done else None
        if both:
            done[-1] = both
        else:
            done.append(step)
    return tuple(Step(number, step.select, step.action, step.label) for number, step in enumerate(done, 1))


def _both(one: Step, other: Step, mesh: SymbolicMesh) -> Step | None:
    """One step that does what two do, None where there is none."""
    if not one.select or not other.select or one.select & other.select:
        return None
    both = one.select | other.select
    if (core(one.action), one.label) != (core(other.action), other.label) or not both <= mesh.index.keys():
        return None
    if isinstance(core(one.action), Delete):
        return Step(one.rule, both, Delete(), one.label)
    parts = _parts(one, mesh) + _parts(other, mesh)
    if sorted(parts) != sorted(components(mesh, _mask(both, mesh))):
        return None
    return Step(one.rule, both, Each(core(one.action)), one.label)


def _parts(step: Step, mesh: SymbolicMesh) -> list[int]:
    """What the step acts on one by one; without `Each` that is all of its selection."""
    mask = _mask(step.select or frozenset(), mesh)
    return components(mesh, mask) if isinstance(step.action, Each) else [mask]


def _mask(names: frozenset[str], mesh: SymbolicMesh) -> int:
    return mask_of(mesh.index[name] for name in names)
