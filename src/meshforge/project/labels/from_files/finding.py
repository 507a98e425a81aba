"""Which file says what the hulls of an asset are: a labels file, segmented points, or PartNet's semantics."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from meshforge.batch import Found, asset_id
from meshforge.errors import UsageError
from meshforge.formats import labels_beside
from meshforge.formats.segmented import POINTS_SUFFIXES, SEMANTICS, points_beside

Kind = Literal["labels file", "points", "semantics"]
_LINKS = ".urdf"  # the format whose links semantics are about


def label_files(found: Found, source: Path | None) -> dict[str, Path]:
    """The file of each asset that has one; beside each asset: labels file, then points, then semantics.

    source: a file for a single asset, or a folder that mirrors the assets; None for those beside them.
    Raises UsageError: nothing there, a kind of file that says no labels, or one file for several assets.
    """
    if source is None:
        files = {asset: beside(path) for asset, path in found.ids.items()}
    elif source.is_file():
        kind_of(source)
        if len(found) > 1:
            problem = f"one file cannot serve {len(found)} assets"
            raise UsageError(problem, where=str(source), remedy="Give a folder that mirrors theirs.")
        files = dict.fromkeys(found.ids, source)
    elif source.is_dir():
        files = {asset: _mirrored(source / asset_id(path, found.base), path) for asset, path in found.ids.items()}
    else:
        raise UsageError("there is no such labels file or folder", where=str(source))
    return {asset: file for asset, file in files.items() if file}


def kind_of(file: Path) -> Kind:
    """What a file is by its name. Raises UsageError for one that says no labels."""
    match file.suffix.lower():
        case ".json":
            return "labels file"
        case ".txt":
            return "semantics"
        case suffix if suffix in POINTS_SUFFIXES:
            return "points"
    remedy = f"Labels files are .json, segmented points {', '.join(POINTS_SUFFIXES)}; PartNet's are {SEMANTICS}."
    raise UsageError("this is no kind of file that labels are read from", where=str(file), remedy=remedy)


def beside(asset: Path) -> Path | None:
    """The file beside an asset, None where there is none."""
    labels = labels_beside(asset)
    return labels if labels.is_file() else points_beside(labels) or _semantics(asset)


def _mirrored(place: Path, asset: Path) -> Path | None:
    """The file in a folder of them; place: where the asset would be there, which may be where it is."""
    labels = labels_beside(place)
    plain = (place.with_name(place.name + ".json"), labels)
    points = (place.with_suffix(suffix) for suffix in POINTS_SUFFIXES)
    return (
        next((path for path in plain if path.is_file()), None)
        or points_beside(labels)
        or next((path for path in points if path != asset and path.is_file()), None)
        or _semantics(place)
    )


def _semantics(asset: Path) -> Path | None:
    file = asset.with_name(SEMANTICS)
    return file if asset.suffix.lower() == _LINKS and file.is_file() else None
