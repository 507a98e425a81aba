"""What was worked out about a mesh is remembered for as long as the mesh lives.

A program is learned anew after every answer, from the same meshes, and most of its rules stay what they were.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import TypeVar
from weakref import WeakKeyDictionary

from meshforge.symbolic import SymbolicMesh

Made = TypeVar("Made")
_known: WeakKeyDictionary[SymbolicMesh, dict[Hashable, object]] = WeakKeyDictionary()


def remembered(mesh: SymbolicMesh, key: Hashable, kind: type[Made], make: Callable[[], Made]) -> Made:
    """What `make` gives for the mesh and the key, made once.

    It must not hold on to the mesh itself, which would then live for ever; errors are not remembered.
    """
    known = _known.setdefault(mesh, {})
    found = known.get((kind, key))
    if isinstance(found, kind):
        return found
    made = make()
    known[kind, key] = made
    return made
