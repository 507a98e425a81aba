"""Where the references of an SDF lead, as Gazebo follows them: `model://NAME/PATH`, `file://PATH`, plain paths."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from meshforge.files import is_file
from meshforge.formats.references import Resolver, placement
from meshforge.formats.sdf.files.config import CONFIG, main_file

_MODEL = re.compile(r"(?:package|model)://+([^/]+)/(.*)", re.S)
_FILE = "file://"


@dataclass(frozen=True, slots=True)
class ModelResolver(Resolver):
    """Finds what a file refers to, from its folder, upwards, and in the roots."""

    def candidates(self, reference: str) -> Iterator[Path]:
        """The places where the file may be; what no model of that name has may be in this one, under another name."""
        reference = reference.strip()
        rest = reference.removeprefix(_FILE)
        if rest != reference and not rest.startswith("/"):  # Gazebo takes it for a path
            yield self._join(self.folder, rest)
        yield from Resolver.candidates(self, reference)
        if model := _MODEL.fullmatch(reference):
            yield self._join(self.folder, model[2])

    def place(self, reference: str) -> str | None:
        """Where the file goes in an output: what is in the model's own folder stays there."""
        reference = reference.strip()
        rest = reference.removeprefix(_FILE)
        if rest != reference and not rest.startswith("/") and self.find(reference) == self._join(self.folder, rest):
            return posixpath.normpath(rest)
        model = _MODEL.fullmatch(reference)
        if model and self._is_own(model[1], model[2]):
            return posixpath.normpath(model[2])
        return placement(reference)

    def _is_own(self, name: str, rest: str) -> bool:
        """Whether a model's file is, or is to be, in the folder itself."""
        found = next((path for path in Resolver.candidates(self, f"model://{name}/{rest}") if is_file(path)), None)
        if found is not None:
            return found == self._join(self.folder, rest)
        return self.folder.name == name or not any(home.is_dir() for home in self._homes(name))

    def find_model_file(self, reference: str) -> Path | None:
        """The file of a model that an `<include>` names: a file, or the folder of a model; None where it is not there.

        Raises AssetError: the folder's `model.config` is no XML.
        """
        reference = reference.strip().rstrip("/")
        if (path := next((p for p in Resolver.candidates(self, reference) if _is(p, "file")), None)) is not None:
            return path
        for beside in self.candidates(f"{reference}/{CONFIG}"):
            if _is(beside.parent, "dir") and (path := main_file(beside.parent)) is not None:
                return path
        return None

    def advise_on_model(self, reference: str) -> str:
        """Where the model of an `<include>` was looked for, and what to do about it."""
        is_folder = reference.strip().startswith("model:") and not _MODEL.fullmatch(reference.strip())
        return self.advice(f"{reference.strip()}/model.sdf" if is_folder else reference)


def _is(path: Path, kind: str) -> bool:
    try:
        return path.is_file() if kind == "file" else path.is_dir()
    except (OSError, ValueError):  # a name longer than those of files, or with a zero byte
        return False
