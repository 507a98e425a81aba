"""What is kept of a glTF file to write it back: its bytes, and which hulls were read from which nodes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from meshforge.geometry import Ints
from meshforge.symbolic import Document

Convention = Literal["khr", "omi", "omi collider", "unreal", "godot", "unity", "plain"]
"""How a file marks its collision geometry: by an extension, by names, or not at all, then all meshes are collision."""

BODY = "body"
"""The name of the body of all collision that is part of no rigid body."""


@dataclass(frozen=True, eq=False, slots=True)
class NodeRecord:
    """A node of the file with collision: its body, the names of its pieces in order, hulls and non-convex ones.

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
