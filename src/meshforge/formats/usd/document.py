"""What is kept of a USD stage to write it back: its root layer's bytes, and which hulls were read from which prims."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from meshforge.asset import Document

BODY = "body"
"""The name of the body of all collision that is part of no rigid body."""


@dataclass(frozen=True, slots=True)
class Authored:
    """A prim with collision: its path, its body, and the names of its pieces in order, hulls and opaque ones.

    fixed: why no edit can change it, empty where one can.
    """

    path: str
    body: str
    names: tuple[str, ...]
    fixed: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class UsdDocument(Document):
    """The source of an asset read from a USD file.

    source: the bytes of the file; physics: whether prims say that they collide, else all meshes count;
    bodies: the prims that are bodies, with the names of those; digests: of the layers besides the root layer.
    """

    source: bytes
    physics: bool
    authored: tuple[Authored, ...]
    bodies: tuple[tuple[str, str], ...] = ()
    digests: tuple[tuple[Path, str], ...] = ()
