"""What is kept of a URDF to write it back: its bytes, and which hulls were read from which of its elements."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from meshforge.asset import Document, unique_names
from meshforge.formats.references import Resolver


@dataclass(frozen=True, slots=True)
class Authored:
    """A `<collision>` of the file: its link, and the names of its pieces in order, hulls and opaque ones."""

    link: str
    names: tuple[str, ...]


@dataclass(frozen=True, eq=False, slots=True)
class UrdfDocument(Document):
    """The source of an asset read from a URDF.

    source: the authored bytes; authored: one entry a `<collision>`, in order; resolver: finds its files;
    digests: of the mesh files that hold several pieces, so that a file changed since then is noticed.
    """

    source: bytes
    authored: tuple[Authored, ...]
    resolver: Resolver
    digests: tuple[tuple[Path, str], ...] = ()


def piece_names(elements: Sequence[tuple[str, str | None, int]]) -> list[tuple[str, ...]]:
    """The names that the pieces of collision elements read as; for each element its link, name attribute and pieces.

    `link/name`, or `link/geomK` where the K-th element of a link has no name; `#k` for one of several pieces.
    """
    count: dict[str, int] = {}
    bases = []
    for link, name, _ in elements:
        bases.append(f"{link}/{name or 'geom' + str(count.get(link, 0))}")
        count[link] = count.get(link, 0) + 1
    each = [
        [base] if pieces == 1 else [f"{base}#{k}" for k in range(pieces)]
        for base, (_, _, pieces) in zip(unique_names(bases), elements, strict=True)
    ]
    unique = iter(unique_names(name for names in each for name in names))
    return [tuple(next(unique) for _ in names) for names in each]


def digest_of(path: Path) -> str:
    """A digest of a file's bytes."""
    return hashlib.blake2b(path.read_bytes(), digest_size=16).hexdigest()
