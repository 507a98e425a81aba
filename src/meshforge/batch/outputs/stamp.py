"""The stamp of an output: what it was made from and what was written, kept beside the outputs for resuming."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from pydantic import BaseModel, ConfigDict, ValidationError

from meshforge.batch.assets.digests import file_digest
from meshforge.batch.assets.folder import STATE
from meshforge.batch.outcome import Edited, Failed, RuleLine, Skipped, Unchanged
from meshforge.files import write_atomically

if TYPE_CHECKING:
    from meshforge.batch.outputs.draft import Draft


class Inputs(BaseModel):
    """Digests of all that decides what an output is; asset: of each file, by its path relative to the common folder."""

    model_config = ConfigDict(frozen=True)

    asset: dict[str, str]
    preparation: str | None = None
    labels: str | None
    program: str
    templates: dict[str, str]
    corrections: str | None
    settings: str
    software: str

    def changes(self, other: Inputs) -> tuple[str, ...]:
        """What differs between the two: `asset`, `labels`, `program`, ..."""
        return tuple(name for name in type(self).model_fields if getattr(self, name) != getattr(other, name))


class Stamp(BaseModel):
    """One output.

    outputs: the digest of every file, by its path in the output folder; out: the main one of them.
    labels: of its hulls, in the order that the main file has them; empty where they are not known.
    """

    model_config = ConfigDict(frozen=True)

    asset: str
    status: Literal["edited", "unchanged", "failed"]
    inputs: Inputs | None = None
    outputs: dict[str, str] = {}
    out: str = ""
    labels: tuple[str | None, ...] = ()
    rules: tuple[RuleLine, ...] = ()
    before: int = 0
    after: int = 0
    notes: tuple[str, ...] = ()
    flags: tuple[str, ...] = ()
    error: str | None = None

    @staticmethod
    def of(outcome: Edited | Unchanged, inputs: Inputs, draft: Draft) -> Stamp:
        """The stamp of a run that came to its end."""
        return Stamp(
            asset=outcome.asset,
            status="edited" if isinstance(outcome, Edited) else "unchanged",
            inputs=inputs,
            outputs=dict(draft.files),
            out=draft.main,
            labels=draft.labels,
            rules=outcome.rules,
            before=outcome.before,
            after=outcome.after,
            notes=outcome.notes,
            flags=outcome.flags,
        )

    @staticmethod
    def of_failure(outcome: Failed, inputs: Inputs | None) -> Stamp:
        """The stamp of an asset that was not written; inputs: as far as they are known."""
        return Stamp(asset=outcome.asset, status="failed", inputs=inputs, error=outcome.error)

    def to_skipped(self, folder: Path) -> Skipped:
        """The outcome of finding this output up to date."""
        out = str(folder / self.out)
        return Skipped(self.asset, out, self.rules, self.before, self.after, 0.0, self.notes, self.flags)

    def is_whole(self, folder: Path) -> bool:
        """Whether all files of this output are there, as they were written."""
        if self.status == "failed":
            return False
        return all(
            (folder / name).is_file() and file_digest(folder / name) == known for name, known in self.outputs.items()
        )

    def write(self, path: Path) -> None:
        """Write this stamp to disk."""
        write_atomically(path, self.model_dump_json(indent=1))


def stamp_path(folder: Path, asset: str) -> Path:
    """Where the stamp of an asset is kept."""
    return folder / STATE / "stamps" / f"{asset}.json"


def read_stamp(folder: Path, asset: str) -> Stamp | None:
    """The stamp of an asset's output; None where there is none, or none that can be read, so that it is made again."""
    return stamp_in(stamp_path(folder, asset))


def all_stamps(folder: Path) -> Iterator[Stamp]:
    """The stamps of all outputs in a folder, in the order of their paths."""
    for path in sorted((folder / STATE / "stamps").rglob("*.json")):
        stamp = stamp_in(path)
        if stamp:
            yield stamp


def stamp_in(path: Path) -> Stamp | None:
    """The stamp in a file; None where there is none, or none that can be read."""
    try:
        return Stamp.model_validate_json(path.read_bytes())
    except (OSError, ValidationError):
        return None
