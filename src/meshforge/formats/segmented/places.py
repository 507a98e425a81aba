"""Where segmented points of an asset lie beside it, so that they are not taken for assets themselves."""

from __future__ import annotations

from pathlib import Path

POINTS_SUFFIXES = (".ply", ".npz", ".npy")
"""Those of segmented points and meshes."""
_MARK = ".points"


def points_beside(place: Path) -> Path | None:
    """The file of segmented points beside an asset, None where there is none; place: that of its labels file."""
    stem = place.name.removesuffix(".labels.json")
    candidates = (place.with_name(f"{stem}{_MARK}{suffix}") for suffix in POINTS_SUFFIXES)
    return next((path for path in candidates if path.is_file()), None)


def is_segmented(path: Path) -> bool:
    """Whether a file is one of segmented points of some asset by its name, `table.points.ply`."""
    return path.suffix.lower() in POINTS_SUFFIXES and Path(path.stem).suffix.lower() == _MARK
