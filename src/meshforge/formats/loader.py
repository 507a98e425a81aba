"""Read assets and symbolic meshes, alone or many, with the labels that lie beside them; warn of odd sizes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, expand_glob
from meshforge.formats.base import ReadOptions
from meshforge.formats.meshfile.surface import FARTHEST
from meshforge.formats.registry import SUFFIXES, format_of, is_asset, resolve_asset_path
from meshforge.symbolic import Asset, SymbolicMesh, read_labels, transfer_labels

NO_GEOMETRY = "it has no collision geometry: `meshforge new --decompose` makes hulls of what is shown"
"""The note on an asset that holds nothing to reason about."""

_LARGE = 50.0  # m: beyond nearly all assets in metres; a mug in millimetres is 100 across
_SMALL = 1e-3  # m: below nearly all assets in metres


def read(path: str | Path, options: ReadOptions | None = None) -> Asset:
    """The asset in a file, or in a folder: of mesh files, or of a Gazebo model. Raises AssetError.

    options: None takes those of the environment.
    """
    path = resolve_asset_path(Path(path))
    asset = format_of(path).read(path, options or ReadOptions.from_environment())
    refuse_far(asset)
    note = note_if_odd_size(asset) if asset.geoms or asset.opaque else NO_GEOMETRY
    return replace(asset, notes=(*asset.notes, note)) if note else asset


def load(path: str | Path, labels: str | Path | None = None) -> SymbolicMesh:
    """The symbolic mesh of a file, with the labels of a labels file; without one, of the file beside it if present.

    Raises AssetError: the asset or the labels cannot be read.
    """
    path = resolve_asset_path(Path(path))
    mesh = SymbolicMesh.of(read(path))
    beside = Path(labels) if labels is not None else labels_beside(path)
    if labels is None and not beside.is_file():
        return mesh
    return transfer_labels(read_labels(beside), mesh).mesh


def load_many(patterns: str | Path | Iterable[str | Path]) -> Iterator[SymbolicMesh]:
    """The symbolic meshes of all files that the patterns match (`**` too), sorted, each read when it is asked for.

    Raises AssetError at once where a pattern matches no asset.
    """
    several = [patterns] if isinstance(patterns, str | Path) else list(patterns)
    paths = sorted({path for pattern in several for path in _match_pattern(str(pattern))})
    return (load(path) for path in paths)


def labels_beside(path: Path) -> Path:
    """Where the labels of an asset lie: beside it, `table.labels.json` for table.urdf and for a folder `table`."""
    stem = path.name if path.is_dir() or path.suffix.lower() not in SUFFIXES else path.stem
    return path.with_name(f"{stem}.labels.json")


def _match_pattern(pattern: str) -> list[Path]:
    if Path(pattern).exists():
        return [Path(pattern)]
    found = [Path(name) for name in expand_glob(pattern)]
    known = [p for p in found if is_asset(p)]
    if not known:
        problem = "no file matches" if not found else "none of the files it matches is an asset"
        raise AssetError(problem, where=pattern, remedy=f"Known suffixes: {', '.join(SUFFIXES)}.")
    return known


def refuse_far(asset: Asset) -> None:
    """Raise AssetError where a piece is not in a place of finite numbers, or so far out that numbers lose it."""
    corners = {geom.name: (geom.shape.aabb.min, geom.shape.aabb.max) for geom in asset.geoms}
    surfaces = {piece.name: piece.surface.vertices for piece in asset.opaque if piece.surface}
    for name, points in (corners | surfaces).items():
        if not (np.abs(points) <= FARTHEST).all():  # true of NaN as well
            problem = f"{name} reaches beyond all numbers that are read, {FARTHEST:g} m"
            raise AssetError(problem, where=str(asset.path), remedy="Fix its place, its size or its scale.")


def note_if_odd_size(asset: Asset) -> str | None:
    """A note on the size of an asset, None where that is usual."""
    points = [corner for geom in asset.geoms for box in [geom.shape.aabb] for corner in (box.min, box.max)]
    surfaces = [o.surface.vertices[np.unique(o.surface.faces)] for o in asset.opaque if o.surface]
    corners = np.concatenate([*(p[None] for p in points), *surfaces]) if points or surfaces else np.zeros((0, 3))
    if len(corners) == 0:
        return None
    size = float(np.linalg.norm(np.ptp(corners, axis=0)))
    if _SMALL <= size <= _LARGE or size == 0:
        return None
    advice = "export it in metres, or scale it where a URDF or MJCF refers to it"
    if size > _LARGE:
        return f"it is {size:,.4g} m across: if its unit is the millimetre, {advice}"
    return f"it is {size:.2g} m across: if its unit is not the metre, {advice}"
