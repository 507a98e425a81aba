"""Reading assets, alone or many, with the labels that lie beside them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from meshforge.asset import Asset
from meshforge.errors import AssetError
from meshforge.files import globbed
from meshforge.formats.base import ReadOptions
from meshforge.formats.registry import SUFFIXES, asset_at, format_of, is_asset
from meshforge.formats.units import refuse_beyond, unit_note
from meshforge.symbolic import SymbolicMesh, follow_labels, read_labels

NO_GEOMETRY = "it has no collision geometry: `meshforge new --decompose` makes hulls of what is shown"
"""The note on an asset that holds nothing to reason about."""


def read(path: str | Path, options: ReadOptions | None = None) -> Asset:
    """The asset in a file, or in a folder: of mesh files, or of a Gazebo model. Raises AssetError.

    options: None takes those of the environment.
    """
    path = asset_at(Path(path))
    asset = format_of(path).read(path, options or ReadOptions.from_environment())
    refuse_beyond(asset)
    found = [note for note in (_absence(asset), unit_note(asset)) if note]
    return replace(asset, notes=(*asset.notes, *found)) if found else asset


def _absence(asset: Asset) -> str | None:
    """A note on an asset that holds nothing to reason about."""
    if asset.geoms or asset.opaque:
        return None
    return NO_GEOMETRY


def load(path: str | Path, labels: str | Path | None = None) -> SymbolicMesh:
    """The symbolic mesh of a file, with the labels of a labels file; without one, of the file beside it if present.

    Raises AssetError: the asset or the labels cannot be read.
    """
    path = asset_at(Path(path))
    mesh = SymbolicMesh.of(read(path))
    beside = Path(labels) if labels is not None else labels_beside(path)
    if labels is None and not beside.is_file():
        return mesh
    return follow_labels(read_labels(beside), mesh).mesh


def load_many(patterns: str | Path | Iterable[str | Path]) -> Iterator[SymbolicMesh]:
    """The symbolic meshes of all files that the patterns match (`**` too), sorted, each read when it is asked for.

    Raises AssetError at once where a pattern matches no asset.
    """
    several = [patterns] if isinstance(patterns, str | Path) else list(patterns)
    paths = sorted({path for pattern in several for path in _matches(str(pattern))})
    return (load(path) for path in paths)


def labels_beside(path: Path) -> Path:
    """Where the labels of an asset lie: beside it, `table.labels.json` for table.urdf and for a folder `table`."""
    stem = path.name if path.is_dir() or path.suffix.lower() not in SUFFIXES else path.stem
    return path.with_name(f"{stem}.labels.json")


def _matches(pattern: str) -> list[Path]:
    if Path(pattern).exists():
        return [Path(pattern)]
    found = [Path(name) for name in globbed(pattern)]
    known = [p for p in found if is_asset(p)]
    if not known:
        problem = "no file matches" if not found else "none of the files it matches is an asset"
        raise AssetError(problem, where=pattern, remedy=f"Known suffixes: {', '.join(SUFFIXES)}.")
    return known
