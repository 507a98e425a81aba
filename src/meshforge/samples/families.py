"""The families by name, and writing one into a folder without touching what a user has there."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

from meshforge.common import UsageError, find_drafts, suggest_among, write_atomically

TABLES = Path(__file__).parent / "tables"
"""Fourteen tables as OBJ files with their labels beside them; `tables.mf`, `templates/` and `demonstrations/`."""


Files = dict[str, bytes]
"""What each file of a family holds, by its path within the folder of the family."""


@dataclass(frozen=True, slots=True)
class SampleFamily:
    """A family of assets that MeshForge writes.

    about: what they are, in a line; pattern: a glob that finds them in their folder; vocabulary: of their labels;
    files: a glob of what is written.
    """

    name: str
    about: str
    pattern: str
    vocabulary: tuple[str, ...]
    files: str = "**/*"

    @property
    def folder(self) -> Path:
        """Where its files lie."""
        return Path(__file__).parent / self.name

    def read(self) -> Files:
        """Return what its files hold."""
        paths = (path for path in sorted(self.folder.glob(self.files)) if path.is_file())
        return {path.relative_to(self.folder).as_posix(): path.read_bytes() for path in paths}


_ROWS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))
FAMILIES = tuple(SampleFamily(name, **{**row, "vocabulary": tuple(row["vocabulary"])}) for name, row in _ROWS.items())
"""Every family, with its assets in the order of their names."""


def family_of(name: str) -> SampleFamily:
    """Return the family of a name. Raises UsageError, naming the nearest."""
    known = {family.name: family for family in FAMILIES}
    if name not in known:
        raise UsageError(f"there is no family {name!r}", remedy=suggest_among(name, known, "There are"))
    return known[name]


def write_family(family: SampleFamily, folder: Path) -> int:
    """Write the files of a family below a folder; how many were missing there.

    A folder that holds all of them already is left as it is, whatever else it holds.
    Raises UsageError: a file of another content would be replaced, or files are missing where others are.
    """
    if folder.exists() and not folder.is_dir():
        raise UsageError("this is a file", where=str(folder), remedy="Name a folder.")
    files = family.read()
    missing = []
    for path, content in files.items():
        target = folder / path
        if not (target.exists() or target.is_symlink()):
            missing.append(path)
        elif not target.is_file() or target.read_bytes() != content:
            raise _refuse(family, folder, path)
    if missing and (other := _find_other(folder, files)):
        raise _refuse(family, folder, other)
    for path in missing:
        write_atomically(folder / path, files[path])
        for draft in find_drafts(folder / path):
            draft.unlink(missing_ok=True)
    return len(missing)


def _find_other(folder: Path, files: Files) -> str | None:
    """A file below a folder that is none of a family, nor one that a killed run left half-written."""
    own = {*(folder / path for path in files), *(draft for path in files for draft in find_drafts(folder / path))}
    others = sorted(path for path in folder.rglob("*") if not path.is_dir() and path not in own)
    return others[0].relative_to(folder).as_posix() if others else None


def _refuse(family: SampleFamily, folder: Path, other: str) -> UsageError:
    problem = f"this folder holds something else: {other}"
    remedy = f"Nothing was written; name an empty folder: meshforge samples {family.name} DIR"
    return UsageError(problem, where=str(folder), remedy=remedy)
