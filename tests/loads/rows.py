"""What each reader finds, counted by format, and what it finds otherwise than MeshForge."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from tests.loads.asking import Answers
from tests.loads.assets import Made
from tests.loads.comparing import differences
from tests.loads.readers import Reader, Seen

_OWN = Reader("MeshForge itself", "", "", {}, lambda _: iter(()), rounds=0.06)


@dataclass
class Cell:
    """Of a reader and a format: files and shapes that agree, and files that do not."""

    files: int = 0
    shapes: int = 0
    wrong: int = 0


@dataclass
class Row:
    """Of a reader: version is None where it was not run; cells by suffix; limits: files left to these, by suffix."""

    reader: Reader
    version: str | None
    cells: dict[str, Cell] = field(default_factory=dict)
    limits: set[tuple[str, str]] = field(default_factory=set)
    differences: list[str] = field(default_factory=list)

    def add(self, one: Made, wanted: Sequence[Seen], told: Sequence[str]) -> None:
        """Count a file, of which this is told."""
        cell = self.cells.setdefault(one.suffix, Cell())
        if told and (one.suffix, one.asset) in self.reader.limits:
            self.limits.add((one.suffix, one.asset))
        elif told:
            cell.wrong += 1
            name = f"{one.suffix or 'folder'} {one.asset}{', edited' * one.edited}"
            self.differences.append(f"{self.reader.title}, {name}: {'; '.join(told[:3])}")
        else:
            cell.files, cell.shapes = cell.files + 1, cell.shapes + len(wanted)


def row_of_own(files: Sequence[Made]) -> Row:
    """MeshForge's own: what it reads back is what was to be written."""
    row = Row(_OWN, "")
    for one in files:
        hulls = [seen for seen in one.shapes if seen.kind != "opaque"]
        row.add(one, one.meant, differences(one.meant, hulls, _OWN, one.suffix))
    return row


def row_of(reader: Reader, files: Sequence[Made], answers: Answers | None) -> Row:
    """What a reader found, held against what MeshForge reads in the same files."""
    row = Row(reader, answers.version if answers else None)
    for one, found in zip(files, answers.found if answers else (), strict=answers is not None):
        told = [found] if isinstance(found, str) else differences(one.shapes, found, reader, one.suffix)
        row.add(one, one.shapes, told)
    return row
