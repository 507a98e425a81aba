"""What is kept of a URDF to write it back: its bytes, and which hulls were read from which of its elements."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from meshforge.asset import Document
from meshforge.formats.element_plan import Authored
from meshforge.formats.references import Resolver


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
