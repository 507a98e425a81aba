"""The files that make up an SDF: the main one, and those of the models that it includes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from meshforge.formats.sdf.files.resolver import ModelResolver
from meshforge.formats.xml import Text


@dataclass(frozen=True, eq=False, slots=True)
class Source:
    """An authored file.

    path: absolute; place: where an output has it, relative to the main file's folder, None for one that is included by
    an absolute path; reference: as the `<include>` has it, empty for the main file; count: how often it is included.
    """

    path: Path
    place: str | None
    reference: str
    raw: bytes
    resolver: ModelResolver
    count: int = 1

    @property
    def text(self) -> Text:
        """The text in which offsets of elements count."""
        return Text.of(self.raw)
