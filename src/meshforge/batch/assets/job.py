"""What a batch is given: one job an asset, and one task that is the same for all."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from meshforge.batch.assets.expand import Found, asset_id
from meshforge.batch.correction import Correction
from meshforge.errors import UsageError
from meshforge.formats import Mass, Names, labels_beside
from meshforge.language import Program, Template


@dataclass(frozen=True, slots=True)
class AssetJob:
    """One asset of a batch.

    id: its path below `base`, which the output mirrors; labels: its labels file, None for no labels;
    corrections: edits by hand, replayed after the program; preparation: the folder of what is done to it before.
    """

    id: str
    path: Path
    base: Path
    labels: Path | None = None
    corrections: tuple[Correction, ...] = ()
    preparation: Path | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Task:
    """What is done to every asset of a batch.

    out: the folder that is written; to: the suffix of the format that is written, None for the asset's own; names:
    the engine by whose names for collision they are made.
    """

    program: Program
    templates: Mapping[str, Template]
    out: Path
    mass: Mass = "keep"
    link: bool = False
    dry_run: bool = False
    resume: bool = True
    to: str | None = None
    names: Names | None = None


def jobs(found: Found, labels: Path | None = None) -> tuple[AssetJob, ...]:
    """A job for each asset, with its labels.

    labels: a labels file for a single asset, or a folder that mirrors the assets' (`ID.json` or the name it would have
    beside the asset); without it, the file beside each asset, if present.
    Raises UsageError: no such file or folder, or one file for several assets.
    """
    if labels is not None and labels.is_file() and len(found) > 1:
        raise UsageError(
            f"one labels file cannot serve {len(found)} assets",
            where=str(labels),
            remedy="Give a folder that mirrors theirs.",
        )
    return tuple(
        AssetJob(key, path, found.base, labels_for(path, labels, found.base)) for key, path in found.ids.items()
    )


def labels_for(path: Path, labels: Path | None, base: Path) -> Path | None:
    """The labels file of one asset, None where it has none; arguments as of `jobs`."""
    if labels is None:
        beside = labels_beside(path)
        return beside if beside.is_file() else None
    if labels.is_file():
        return labels
    if not labels.is_dir():
        raise UsageError("there is no such labels file or folder", where=str(labels))
    mirrored = labels / asset_id(path, base)
    candidates = (mirrored.with_name(mirrored.name + ".json"), labels_beside(mirrored))
    return next((place for place in candidates if place.is_file()), None)
