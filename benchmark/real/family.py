"""A family of real assets as its folder tells it: where each lies in the corpus, what it is made of, and its digest."""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from benchmark.speed.assets import corpus
from meshforge.common import AssetError, UsageError
from meshforge.formats import read
from meshforge.symbolic import Asset

FOLDER = Path(__file__).resolve().parent
CACHE = FOLDER.parents[1] / ".bench" / "real"
"""Where wrapper files and decompositions are kept."""
_PICTURES = frozenset({".png", ".jpg", ".jpeg", ".tga", ".bmp"})  # the corpus holds placeholders of these


@dataclass(frozen=True)
class Source:
    """One asset of a family.

    path: below the corpus folder; where there is a wrapper, the place that its text stands in for.
    repository, commit, origin, licence: of `PROVENANCE.md`, origin being the path in the repository.
    digest: of all files that make up the asset, but for images. kind: the variant; rare: few are like it.
    surface: what is labelled, `visual` or `collision`; by default what a body shows, or its collision geometry where
    it shows nothing. up: the axis that points up in the file, by default what its format says, or z; turn: about that
    axis [degrees], so that its front looks to -Y; without: patterns of names of pieces and hulls that are no part of
    the asset; close: patterns of names of pieces that are solid, though their surface has planar holes; decompose:
    false where there is no visual mesh, so that it is measured as it comes only. wrapper: the text of the main file
    where the corpus has parts of one only.
    """

    name: str
    path: str
    repository: str
    commit: str
    origin: str
    licence: str
    digest: str
    kind: str = ""
    rare: bool = False
    surface: str | None = None
    up: str | None = None
    turn: float = 0.0
    without: tuple[str, ...] = ()
    close: tuple[str, ...] = ()
    decompose: bool = True
    wrapper: str | None = field(default=None, repr=False)

    def file(self) -> Path:
        """The file to be read. Raises AssetError where the corpus or the file is not here."""
        root = corpus()
        if root is None:
            raise AssetError("no corpus is here", where=self.name, remedy="Set MESHFORGE_CORPUS to its folder.")
        place = self._wrap(root) if self.wrapper is not None else root / self.path
        if not place.exists():
            raise AssetError("the corpus has no such file", where=str(place))
        return place

    def _wrap(self, root: Path) -> Path:
        """The wrapper's file, in a folder of links to all that lies where it would lie in the corpus."""
        assert self.wrapper is not None
        folder = CACHE / "wrappers" / Path(self.path).parent
        folder.mkdir(parents=True, exist_ok=True)
        for entry in (root / self.path).parent.iterdir():
            link = folder / entry.name
            if not link.is_symlink():
                link.symlink_to(entry)
        place = folder / Path(self.path).name
        place.write_text(self.wrapper, "utf-8")
        return place

    def read(self) -> Asset:
        """The asset as MeshForge reads its file."""
        return read(self.file())

    def measure_digest(self) -> str:
        """The digest of the files as they are now: their paths below the corpus and their contents."""
        root = corpus()
        assert root is not None
        asset = self.read()
        files = {file.resolve() for file in (asset.path, *asset.files)}
        inside = {p for p in files if p.is_relative_to(root.resolve()) and p.suffix.lower() not in _PICTURES}
        total = hashlib.sha256(self.wrapper.encode() if self.wrapper else b"")
        for file in sorted(inside):
            name = file.relative_to(root.resolve()).as_posix()
            total.update(f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {name}\n".encode())
        return total.hexdigest()


@dataclass(frozen=True)
class Family:
    """A family: its labels in order, and its assets."""

    name: str
    vocabulary: tuple[str, ...]
    sources: tuple[Source, ...]

    @property
    def folder(self) -> Path:
        return FOLDER / self.name

    def source(self, name: str) -> Source:
        """The asset of that name. Raises UsageError where there is none."""
        for source in self.sources:
            if source.name == name:
                return source
        raise UsageError(f"family {self.name} has no asset {name}", remedy=f"It has {', '.join(self.names)}.")

    @property
    def names(self) -> list[str]:
        return [source.name for source in self.sources]


@cache
def family(name: str) -> Family:
    """The family of that name. Raises UsageError where there is none."""
    path = FOLDER / name / "family.toml"
    if not path.is_file():
        raise UsageError(f"there is no family {name}", remedy=f"Families are {', '.join(families()) or 'none'}.")
    data = tomllib.loads(path.read_text("utf-8"))
    return Family(name, tuple(data["vocabulary"]), tuple(_source(row) for row in data["asset"]))


def families() -> list[str]:
    """The names of all families."""
    return sorted(path.parent.name for path in FOLDER.glob("*/family.toml"))


def _source(row: Mapping[str, Any]) -> Source:
    return Source(**{**row, "without": tuple(row.get("without", ())), "close": tuple(row.get("close", ()))})


def describe_source(path: str, name: str, wrapper: str | None = None) -> str:
    """The block of `family.toml` for a file of the corpus: what `PROVENANCE.md` says of it, and its digest."""
    root = corpus()
    assert root is not None
    row = _find_provenance(root / "PROVENANCE.md", path)
    folder, repository, commit, base, licence = row
    below = Path(path).relative_to(folder).as_posix()
    origin = below if base in (".", "") else f"{base}/{below}"
    source = Source(name, path, repository, commit, origin, licence, "", wrapper=wrapper)
    lines = ["[[asset]]", *(f'{key} = "{getattr(source, key)}"' for key in ("name", "path", "repository", "commit"))]
    lines += [f'origin = "{origin}"', f'licence = "{licence}"', f'digest = "{source.measure_digest()}"']
    return "\n".join(lines) + "\n"


def _find_provenance(page: Path, path: str) -> tuple[str, str, str, str, str]:
    """Folder, repository, commit, root in the repository and licence of the row of the table that fits a path best."""
    best: tuple[int, tuple[str, str, str, str, str]] | None = None
    for line in page.read_text("utf-8").splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) < 9 or not cells[2] or not path.startswith(cells[2] + "/"):
            continue
        below = path[len(cells[2]) + 1 :]
        items = [item.strip() for item in cells[6].split(",")]
        fit = max((len(item) for item in items if below.startswith(item.rstrip("*"))), default=0)
        if best is None or (len(cells[2]), fit) > (best[0] // 1000, best[0] % 1000):
            licence = cells[7].replace('"', "'")
            best = len(cells[2]) * 1000 + fit, (cells[2], cells[3], cells[4], cells[5], licence)
    if best is None:
        raise UsageError(f"PROVENANCE.md has no row for {path}")
    return best[1]
