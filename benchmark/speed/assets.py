"""The assets that speed is measured on: real ones from the corpus by fixed rules, and the bundled tables."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from benchmark.report import Tell
from meshforge.common import MeshForgeError
from meshforge.formats import SUFFIXES, read
from meshforge.geometry import digest
from meshforge.samples import TABLES
from meshforge.symbolic import SymbolicMesh

WANTED = 100
_FEWEST, _MOST = 2, 128  # hulls of a mesh
_LARGEST = 640 << 10  # bytes of a file; larger ones are made for the eye
_FOLDERS = ("collision/*/*",)  # folders of one hull a file; others are no asset but a heap of parts


def corpus() -> Path | None:
    """The folder of real assets, None where it is not here."""
    given = os.environ.get("MESHFORGE_CORPUS")
    place = Path(given) if given else Path(__file__).resolve().parents[3] / "shared" / "corpus"
    return place if place.is_dir() else None


def corpus_files(suffix: str, largest: int = 8 << 20) -> list[Path]:
    """The files of the corpus of one suffix, in order, up to so many bytes."""
    root = corpus()
    found = sorted(root.rglob("*")) if root else []
    return [p for p in found if p.suffix.lower() == suffix and p.is_file() and p.stat().st_size <= largest]


def name_of(path: Path) -> str:
    """The path of an asset as results name it: below the corpus, or just its name."""
    root = corpus()
    return path.relative_to(root).as_posix() if root and path.is_relative_to(root) else path.name


def multi_hull(tell: Tell, wanted: int = WANTED, bundled_only: bool = False) -> dict[str, SymbolicMesh]:
    """Meshes of several hulls, by the names of their files.

    The rule: the files of the corpus that MeshForge reads as 2 to 128 hulls, no two with the same hulls, ranked by the
    number of hulls, and of these evenly many from few to many. Where there are fewer, the bundled tables join them.
    """
    found: dict[str, SymbolicMesh] = {}
    seen: set[tuple[str, ...]] = set()
    for path in sorted(TABLES.glob("*.obj")) if bundled_only else _candidates():
        if path.parent == TABLES and len(found) >= wanted:
            break
        mesh = _read(path)
        if mesh is None or not _FEWEST <= len(mesh.hulls) <= _MOST:
            continue
        key = tuple(sorted(digest(hull.shape) for hull in mesh.hulls))
        if key not in seen:
            seen.add(key)
            found[name_of(path)] = mesh
            tell(f"{len(found)} meshes of several hulls read")
    ranked = sorted(found, key=lambda name: (len(found[name].hulls), name))
    count = min(wanted, len(ranked))
    return {name: found[name] for name in (ranked[k * len(ranked) // count] for k in range(count))}


def _candidates() -> Iterator[Path]:
    root = corpus()
    if root:
        for pattern in _FOLDERS:
            yield from (p for p in sorted(root.rglob(pattern)) if p.is_dir())
        yield from (
            p
            for p in sorted(root.rglob("*"))
            if p.is_file() and p.suffix.lower() in SUFFIXES and p.stat().st_size <= _LARGEST
        )
    yield from sorted(TABLES.glob("*.obj"))


def _read(path: Path) -> SymbolicMesh | None:
    try:
        return SymbolicMesh.of(read(path))
    except MeshForgeError:
        return None
