"""Bodies that reach into each other before anything moves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from meshforge.checks.physics.model import FLOOR, compiled
from meshforge.checks.physics.touching import Touching
from meshforge.checks.physics.tree import Tree
from meshforge.symbolic import SymbolicMesh


@dataclass(frozen=True, slots=True)
class Overlap:
    """Two bodies that reach into each other at rest pose; depth: at most [m]; joined: whether a joint holds them.

    excluded: whether the file lets these hulls pass through each other, so that it does no harm.
    """

    bodies: tuple[str, str]
    hulls: tuple[str, str]
    depth: float
    joined: bool
    excluded: bool = False


def overlapping(mesh: SymbolicMesh, tree: Tree) -> tuple[Overlap, ...]:
    """The deepest contact of each pair of bodies that can move against each other, at rest pose, deepest first.

    Contacts that the file excludes count for themselves. Raises ValueError where MuJoCo refuses the model.
    """
    import mujoco

    model = compiled(mesh, tree, everything=True)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    rigid, numbers, touching = tree.rigid_roots(), _numbers(model), Touching(mesh)
    found: dict[tuple[str, str, bool], Overlap] = {}
    for contact in data.contact[: data.ncon]:
        first, second = sorted(numbers[int(g)] for g in contact.geom)
        if first < 0 or contact.dist >= 0:
            continue
        a, b = mesh.hulls[first], mesh.hulls[second]
        excluded = not touching.may_touch(first, second)
        key = a.body, b.body, excluded
        if rigid[a.body] == rigid[b.body] or (key in found and found[key].depth >= -contact.dist):
            continue
        joined = tree.above.get(a.body) == b.body or tree.above.get(b.body) == a.body
        found[key] = Overlap((a.body, b.body), (a.name, b.name), -float(contact.dist), joined, excluded)
    return tuple(sorted(found.values(), key=lambda overlap: (-overlap.depth, overlap.bodies)))


def _numbers(model: Any) -> list[int]:
    """The number of the hull of each geom, -1 for the plane."""
    names = [model.geom(g).name for g in range(model.ngeom)]
    return [-1 if name == FLOOR else int(name.rpartition(" ")[2]) for name in names]
