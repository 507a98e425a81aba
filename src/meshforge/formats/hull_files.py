"""The mesh files that an edited description gets: one OBJ a hull, beside the mesh it replaces, with its own name."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from meshforge.formats.plain.obj_text import rows_text
from meshforge.formats.references import Resolver, placement
from meshforge.geometry import Floats, Ints

_LONGEST = 120  # letters of a made file name, well below the 255 bytes of file systems


@dataclass(slots=True)
class HullFiles:
    """Collects the files of one output.

    stem: of the main file, with which every name begins; taken: stems that are in use, lower case, since MuJoCo names
    meshes by stem and some file systems do not tell cases apart.
    """

    stem: str
    resolver: Resolver | None = None
    taken: set[str] = field(default_factory=set)
    made: dict[str, bytes] = field(default_factory=dict)

    def avoid(self, references: Iterable[str]) -> None:
        """Take the names of referenced files, and of all files that are where these and the description are."""
        folders: dict[Path, None] = {self.resolver.folder: None} if self.resolver else {}
        for reference in references:
            self.taken.add(posixpath.splitext(posixpath.basename(reference.replace("\\", "/")))[0].lower())
            if self.resolver and (path := self.resolver.find(reference)):
                folders[path.parent] = None
        for folder in folders:
            self.taken |= {entry.stem.lower() for entry in folder.iterdir()} if folder.is_dir() else set()

    def add(self, name: str, folder: str, vertices: Floats, faces: Ints) -> str:
        """Make the file of a hull in a folder that `folder_of` gives; the reference to it."""
        safe = re.sub(r"[^A-Za-z0-9._-]+", "_", f"{self.stem}--{name}")[:_LONGEST].strip("._") or "hull"
        stem, number = safe, 2
        while stem.lower() in self.taken:
            stem, number = f"{safe}_{number}", number + 1
        self.taken.add(stem.lower())
        reference = f"{folder}{stem}.obj"
        self.made[self._placement_of(reference) or f"{stem}.obj"] = obj_text(vertices, faces)
        return reference

    def folder_of(self, reference: str | None) -> str:
        """The folder of a mesh reference as it is written, with a final slash, where hulls may join the mesh.

        The empty text, which is the folder of the description, where the mesh lies outside of it or at an absolute
        place.
        """
        place = self._placement_of(reference) if reference else None
        if reference is None or place is None or place.startswith(".."):
            return ""
        return reference[: reference.replace("\\", "/").rfind("/") + 1].lstrip()

    def _placement_of(self, reference: str) -> str | None:
        return self.resolver.place(reference) if self.resolver else placement(reference)


def obj_text(vertices: Floats, faces: Ints) -> bytes:
    """An OBJ of vertices (n, 3) in full precision and triangles (m, 3)."""
    return rows_text(vertices, faces)
