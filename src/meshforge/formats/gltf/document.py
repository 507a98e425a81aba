"""What is kept of a glTF file to write it back: its bytes, which hulls were read from which nodes, and how hulls are
named."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from meshforge.geometry import Ints
from meshforge.symbolic import Document, unique_names

Convention = Literal["khr", "omi", "omi collider", "unreal", "godot", "unity", "plain"]
"""How a file tells its collision geometry: by an extension, by names, or not at all, then all meshes are collision."""

BODY = "body"
"""The name of the body of all collision that is part of no rigid body."""


@dataclass(frozen=True, eq=False, slots=True)
class NodeRecord:
    """A node of the file with collision: its body, the names of its pieces in order, hulls and opaque ones.

    owner: the piece (m,) of each triangle of its mesh; None where the pieces are not parts of a mesh.
    """

    node: int
    body: str
    names: tuple[str, ...]
    owner: Ints | None = None


@dataclass(frozen=True, eq=False, slots=True)
class GltfDocument(Document):
    """The source of an asset read from a glTF file or GLB.

    source: the bytes of the file; bodies: the nodes that are bodies, with the names of those;
    digests: of the files with its buffers, so that one changed since then is noticed.
    """

    source: bytes
    convention: Convention
    authored: tuple[NodeRecord, ...]
    bodies: tuple[tuple[int, str], ...] = ()
    digests: tuple[tuple[Path, str], ...] = ()


def name_hulls(sources: Sequence[tuple[str | None, str | None, int]]) -> list[tuple[str, ...]]:
    """The names of the pieces of collision sources; of each its body, its own name, and how many pieces it has.

    `body/name`, without body for None; `geomK` for the K-th source of a body where it has no name; `#k` for one of
    several pieces.
    """
    count: dict[str | None, int] = {}
    bases = []
    for body, name, _ in sources:
        base = name or f"geom{count.get(body, 0)}"
        bases.append(base if body is None else f"{body}/{base}")
        count[body] = count.get(body, 0) + 1
    each = [
        [base] if pieces == 1 else [f"{base}#{k}" for k in range(pieces)]
        for base, (_, _, pieces) in zip(unique_names(bases), sources, strict=True)
    ]
    unique = iter(unique_names(name for names in each for name in names))
    return [tuple(next(unique) for _ in names) for names in each]
