"""The mesh assets of an MJCF that is made: one file a hull, and the files of visuals, each scale of a file once."""

from __future__ import annotations

import posixpath

import numpy as np

from meshforge.formats.body_tree import free_name
from meshforge.formats.hull_files import HullFiles
from meshforge.formats.mjcf.elements import tag
from meshforge.formats.xml import shown
from meshforge.geometry import Floats, Polytope

_TINY = 1e-12  # [m^3], below which MuJoCo cannot compute a mass from the volume of a mesh


class MeshAssets:
    """Collects `<mesh>` elements and the files that are made for them; stem: of the main file."""

    def __init__(self, stem: str) -> None:
        self.files = HullFiles(stem)
        self._names: set[str] = set()
        self._elements: list[bytes] = []
        self._shown: dict[tuple[str, tuple[float, ...]], str] = {}

    def add_hull(self, name: str, shape: Polytope) -> str:
        """The name of the mesh of a hull, whose file is made."""
        extra = {"inertia": "shell"} if shape.volume < _TINY else {}
        return self._add(self.files.add(name, "", shape.vertices, shape.faces), extra)

    def add_visual(self, file: str, scale: Floats) -> str:
        """The name of the mesh of a visual file under scales (3,); nothing of it counts for masses or collisions."""
        key = file, tuple(scale.tolist())
        if key not in self._shown:
            scaled = {} if np.array_equal(scale, np.ones(3)) else {"scale": shown(scale)}
            self._shown[key] = self._add(file, {**scaled, "inertia": "shell"})
        return self._shown[key]

    def lines(self) -> list[bytes]:
        """The lines of the `<asset>`; none where there is no mesh."""
        inside = [b"    " + element for element in self._elements]
        return [b"  <asset>", *inside, b"  </asset>"] if inside else []

    def _add(self, file: str, attributes: dict[str, str]) -> str:
        name = free_name(
            posixpath.splitext(posixpath.basename(file))[0].removeprefix(f"{self.files.stem}--"), self._names
        )
        self._elements.append(tag("mesh", {"name": name, "file": file, **attributes}))
        return name
