"""What was measured and drawn, kept in files by the key of the output; the oldest go."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import get_args

from pydantic import TypeAdapter, ValidationError

from meshforge.files import write_atomically
from meshforge.studio.wire.checks import Checked, CheckPicture, Fault, Part

PARTS: tuple[Part, ...] = get_args(Part)
MOST = 8000
"""Files that are kept when a studio is opened."""
_PICTURES = TypeAdapter(tuple[CheckPicture, ...])


@dataclass(frozen=True, slots=True)
class Shelf:
    """A folder of results; what cannot be read there counts as not measured."""

    folder: Path

    def read(self, key: str, part: Part) -> Checked | None:
        """A part that was measured."""
        try:
            return Checked.model_validate_json((self.folder / f"{key}.{part}.json").read_bytes())
        except (OSError, ValidationError):
            return None

    def write(self, key: str, checked: Checked) -> None:
        """Keep a part."""
        write_atomically(self.folder / f"{key}.{checked.part}.json", checked.model_dump_json())

    def missing_parts(self, key: str) -> tuple[Part, ...]:
        """The parts that were not measured yet."""
        return tuple(part for part in PARTS if self.read(key, part) is None)

    def read_faults(self, key: str) -> tuple[Fault, ...] | None:
        """All that was found, once every part is measured."""
        parts = [checked for part in PARTS if (checked := self.read(key, part))]
        whole = len(parts) == len(PARTS)
        return tuple(_fault(found) for checked in parts for found in checked.findings) if whole else None

    def read_pictures(self, key: str, part: Part) -> tuple[CheckPicture, ...] | None:
        """The pictures of a part that were drawn."""
        try:
            return _PICTURES.validate_json((self.folder / f"{key}.{part}.pictures.json").read_bytes())
        except (OSError, ValidationError):
            return None

    def write_pictures(self, key: str, part: Part, drawn: Iterable[tuple[CheckPicture, bytes]]) -> None:
        """Keep the pictures of a part; the list of them comes last."""
        drawn = tuple(drawn)
        for picture, data in drawn:
            write_atomically(self.picture_path(key, picture.name), data)
        names = _PICTURES.dump_json(tuple(picture for picture, _ in drawn))
        write_atomically(self.folder / f"{key}.{part}.pictures.json", names)

    def picture_path(self, key: str, name: str) -> Path:
        """Where a picture is kept."""
        return self.folder / f"{key}.{name}.png"

    def remove_oldest(self) -> None:
        """Remove the oldest."""
        files = sorted(self.folder.glob("*.*"), key=lambda path: path.stat().st_mtime_ns)
        for path in files[:-MOST]:
            path.unlink(missing_ok=True)


def _fault(found: Fault) -> Fault:
    return Fault(rule=found.rule, severity=found.severity, engine=found.engine, new=found.new)
