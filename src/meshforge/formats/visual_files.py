"""The visuals of an asset for a format that shows mesh files: copied as they are where it reads them, else as OBJs."""

from __future__ import annotations

import os
import posixpath
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from meshforge.asset import Surface
from meshforge.errors import MeshForgeError
from meshforge.formats.companions import companions
from meshforge.formats.hull_files import HullFiles
from meshforge.formats.meshfile import joined
from meshforge.formats.numbers import tidy
from meshforge.formats.triangles import read_triangles
from meshforge.formats.visuals import Rgba, Visual
from meshforge.geometry import Floats, Ints, Pose, Shape

_ROUNDING = 1e-14  # share that is lost when a rotation is taken off a scale, and back
_SHEAR = 1e-9


@dataclass(frozen=True, eq=False, slots=True)
class Shown:
    """A visual in the frame of its link: a shape, or a mesh file under a pose and scales (3,), one negative at most."""

    what: Shape | str
    pose: Pose
    scale: Floats
    rgba: Rgba | None


@dataclass(slots=True)
class VisualFiles:
    """Collects the files; takes: whether the format shows a mesh file as it is.

    copies: by their place beside the main file; refused: bodies whose visual cannot be read.
    """

    files: HullFiles
    takes: Callable[[Path], bool]
    copies: dict[str, Path] = field(default_factory=dict)
    refused: list[str] = field(default_factory=list)
    _base: Path | None = None
    _made: dict[Path, str | None] = field(default_factory=dict)

    def gather(self, visuals: Iterable[tuple[str, Visual | Surface]]) -> None:
        """Find the folder that holds all mesh files with what they need beside them; it becomes one of the output."""
        paths = {v.what for _, v in visuals if isinstance(v, Visual) and isinstance(v.what, Path)}
        beside = {path for mesh in paths for path in companions(mesh).values()}
        if paths:
            self._base = Path(os.path.commonpath([path.parent for path in (*paths, *beside)]))

    def add_visual(self, body: str, visual: Visual | Surface, root_t_link: Pose) -> Shown | None:
        """A visual as it is to be written; None where its file cannot be read."""
        link_t_root = root_t_link.inverse()
        if isinstance(visual, Surface):
            reference = self._make_obj(f"{body}-visual", link_t_root.apply(visual.vertices), visual.faces)
            return Shown(reference, Pose.identity(), np.ones(3), visual.rgba)
        moved = visual.move(link_t_root)
        if isinstance(moved.what, Shape):
            return Shown(moved.what, Pose.identity(), np.ones(3), moved.rgba)
        split = _split(moved.linear)
        if split is None:
            return self._bake(body, moved)
        file = self._place_file(moved.what)
        if file is None:
            self.refused.append(body)
            return None
        return Shown(file, Pose(split[0], tidy(moved.offset, 1.0)), split[1], moved.rgba)

    def _place_file(self, mesh: Path) -> str | None:
        """The reference to a mesh file in the output."""
        if mesh not in self._made:
            self._made[mesh] = self._copy(mesh) if self.takes(mesh) else self._convert(mesh)
        return self._made[mesh]

    def _copy(self, mesh: Path) -> str:
        place = self._place_of(mesh)
        self.copies[place] = mesh
        for key, path in companions(mesh).items():
            self.copies.setdefault(posixpath.normpath(posixpath.join(posixpath.dirname(place), key)), path)
        return place

    def _place_of(self, mesh: Path) -> str:
        assert self._base is not None  # `gather` saw the file
        return f"{self.files.stem}--visuals/{mesh.relative_to(self._base).as_posix()}"

    def _convert(self, mesh: Path) -> str | None:
        """An OBJ of a file of another kind; None where it cannot be read."""
        try:
            soup = joined(read_triangles(mesh))
        except MeshForgeError:
            return None
        return self._make_obj(f"{mesh.stem}-visual", soup.vertices, soup.faces)

    def _bake(self, body: str, visual: Visual) -> Shown | None:
        """An OBJ of a visual under a map that shears."""
        surfaces = visual.surfaces()
        if not surfaces:
            self.refused.append(body)
            return None
        starts = np.cumsum([0, *(len(s.vertices) for s in surfaces)])
        faces = np.concatenate([s.faces + start for s, start in zip(surfaces, starts, strict=False)])
        reference = self._make_obj(f"{body}-visual", np.concatenate([s.vertices for s in surfaces]), faces)
        return Shown(reference, Pose.identity(), np.ones(3), visual.rgba)

    def _make_obj(self, name: str, vertices: Floats, faces: Ints) -> str:
        """An OBJ of triangles, with the four vertices at least that MuJoCo asks for."""
        enough = np.concatenate([vertices, vertices[:1]]) if len(vertices) < 4 else vertices
        return self.files.add(name, "", enough, faces)


def _split(linear: Floats) -> tuple[Floats, Floats] | None:
    """A map as a rotation (3, 3) after scales (3,), the last negative for a reflection; None where it shears."""
    scale = np.linalg.norm(linear, axis=0)
    if not scale.all():
        return None
    plain = np.round(scale, 12)
    scale = np.where(np.abs(plain - scale) < _ROUNDING * scale, plain, scale)
    if np.linalg.det(linear) < 0:
        scale[2] = -scale[2]
    rotation = linear / scale
    if np.abs(rotation.T @ rotation - np.eye(3)).max() > _SHEAR:
        return None
    square = np.round(rotation)
    return (square if np.abs(rotation - square).max() < _ROUNDING else rotation), scale
