"""What is kept of an SDF to write it back: its files, and which hulls were read from which of their elements."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from meshforge.asset import Document
from meshforge.formats.element_plan import Authored
from meshforge.formats.sdf.files.sources import Source


@dataclass(frozen=True, slots=True)
class InFile:
    """Where an element is: the number of its file, and the byte offset in that file's text."""

    source: int
    start: int


@dataclass(frozen=True, eq=False, slots=True)
class SdfDocument(Document):
    """The source of an asset read from an SDF.

    sources: the files, main first; authored: one entry a `<collision>`, and `at`, where that is; links: the element of
    each link by the name of its body; worlds: the names of worlds in the file, which is read only then; computed: the
    bodies whose masses Gazebo computes of their collisions; digests: of mesh files that hold several pieces.
    """

    sources: tuple[Source, ...]
    authored: tuple[Authored, ...]
    at: tuple[InFile, ...]
    links: dict[str, InFile]
    worlds: tuple[str, ...] = ()
    computed: tuple[str, ...] = ()
    digests: tuple[tuple[Path, str], ...] = ()
