"""Files that a description refers to: where a reference leads, and where the file goes in an output folder."""

from __future__ import annotations

import os
import posixpath
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote, urlsplit

from meshforge.common import is_file, nearest_name

_PACKAGE = re.compile(r"(?:package|model)://+([^/]+)/(.*)", re.S)
_FILE = re.compile(r"file:(?://[^/]*(?=/)|//)?(.*)", re.S)
_LONG = 100  # characters of a name in a message
_NAME = re.compile(rb"<name>\s*([^<\s]+)\s*</name>")


@dataclass(frozen=True, slots=True)
class Resolver:
    """Finds referenced files from the folder of the description and the given package roots, both absolute."""

    folder: Path
    roots: tuple[Path, ...] = ()

    def find(self, reference: str) -> Path | None:
        """The file a reference leads to, None where it is not there."""
        return next((path for path in self.candidates(reference) if is_file(path)), None)

    def candidates(self, reference: str) -> Iterator[Path]:
        """The places where the file may be, likeliest first; none for an address in the network."""
        reference = reference.strip()
        if package := _PACKAGE.fullmatch(reference):
            yield from self._in_package(package[1], package[2])
        elif file := _FILE.fullmatch(reference):
            yield self._join(self.folder, unquote(file[1]))
        elif reference and not is_address(reference):
            yield self._join(self.folder, reference)
            if "\\" in reference:
                yield self._join(self.folder, reference.replace("\\", "/"))

    def place(self, reference: str) -> str | None:
        """Where the file of a reference goes in an output: `placement`."""
        return placement(reference)

    def _in_package(self, package: str, rest: str) -> Iterator[Path]:
        for home in self._homes(package):
            yield self._join(home, rest)

    def _homes(self, package: str) -> Iterator[Path]:
        """Where a package may be, in the given roots, then upwards: by a folder's name, or by its package.xml."""
        for root in (*self.roots, self.folder, *self.folder.parents):
            yield root / package
            if root.name == package or _read_package_name(root) == package:
                yield root

    @staticmethod
    def _join(folder: Path, rest: str) -> Path:
        return Path(os.path.normpath(folder / rest))

    def advice(self, reference: str) -> str:
        """Where the file of a reference was looked for, and what to do about it."""
        reference = reference.strip()
        if is_address(reference):
            return "Addresses are not followed: download the file and refer to the copy."
        if "$(" in reference or "${" in reference:
            return "This is a xacro expression: expand the file with xacro first."
        if reference.startswith(("package:", "model:")) and not _PACKAGE.fullmatch(reference):
            return "Write package://NAME/PATH."
        looked = list(self.candidates(reference))
        like = next((near for path in looked if (near := _find_similar(path))), None)
        hint = f" A file of a similar name is there: {like}." if like else ""
        if package := _PACKAGE.fullmatch(reference):
            homes = [home for home in self._homes(package[1]) if home.is_dir()]
            if homes:
                return f"The package {package[1]!r} is at {homes[0]}, but holds no such file.{hint}"
            is_model = reference.startswith("model:")
            roots = f", nor in {', '.join(map(str, self.roots))}" if self.roots else ""
            return (
                f"No folder {package[1]!r} is in {self.folder} or above it{roots}. "
                f"Put the folder that holds it on {'GZ_SIM_RESOURCE_PATH' if is_model else 'ROS_PACKAGE_PATH'}."
            )
        if odd := next((path for path in looked if os.path.lexists(path)), None):
            return f"{odd} is no file, or a link that leads nowhere."
        return f"Looked for {' and '.join(map(_shorten_path, looked))}.{hint} Put it there, or correct the reference."


def _shorten_path(path: Path) -> str:
    """A path as messages show it, of long names the beginning."""
    return str(Path(*(name if len(name) <= _LONG else f"{name[:_LONG]}..." for name in path.parts)))


def is_address(reference: str) -> bool:
    """Whether a reference leads into the network."""
    return urlsplit(reference).scheme in ("http", "https", "ftp") if "://" in reference else False


def placement(reference: str) -> str | None:
    """Where the file of a reference goes, relative to the folder of the written URDF, so that it is found there.

    None for an absolute reference, which is found wherever the URDF lies, and for an address.
    """
    reference = reference.strip()
    if package := _PACKAGE.fullmatch(reference):
        reference = f"{package[1]}/{package[2]}"
    elif _FILE.fullmatch(reference) or Path(reference).is_absolute() or is_address(reference):
        return None
    return posixpath.normpath(reference.replace("\\", "/"))


def _read_package_name(folder: Path) -> str | None:
    """The name that a folder's package.xml gives it."""
    try:
        found = _NAME.search((folder / "package.xml").read_bytes()[:10_000])
    except OSError:
        return None
    return found[1].decode("utf-8", "replace") if found else None


def _find_similar(path: Path) -> Path | None:
    """A file in the same folder whose name is nearly that of `path`."""
    try:
        entries = [entry for entry in path.parent.iterdir() if entry.suffix.lower() == path.suffix.lower()]
        names = sorted(entry.name for entry in entries if entry.is_file())
    except (OSError, ValueError):
        return None
    cased = next((name for name in names if name.lower() == path.name.lower()), None)
    like = cased or nearest_name(path.name, names)
    return path.parent / like if like else None
