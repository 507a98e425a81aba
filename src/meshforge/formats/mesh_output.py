"""The mesh files that a written description gets: one OBJ a hull, and its visuals, copied or converted to OBJ."""

import os
import posixpath
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from types import UnionType

import numpy as np

from meshforge.common import MeshForgeError
from meshforge.formats import kinematic_tree, mesh_reader
from meshforge.formats.meshfile.surface import join_surfaces, stack_triangles
from meshforge.formats.plain.obj import format_obj_rows
from meshforge.formats.references import Resolver, find_companions, placement
from meshforge.formats.visuals import Visual
from meshforge.geometry import Floats, Ints, Pose, Shape
from meshforge.symbolic import Rgba, Surface

_LONGEST = 120  # letters of a made file name, well below the 255 bytes of file systems

_ROUNDING = 1e-14  # share that is lost when a rotation is taken off a scale, and back
_SHEAR = 1e-9


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
        stem = kinematic_tree.claim_name(safe, self.taken, fold=str.lower)
        reference = f"{folder}{stem}.obj"
        self.made[self._placement_of(reference) or f"{stem}.obj"] = format_obj_rows(vertices, faces)
        return reference

    def folder_of(self, reference: str | None) -> str:
        """Return the folder of a mesh reference as it is written, with a final slash, where hulls may join the mesh.

        Empty, which is the folder of the description, where the mesh lies outside of it or at an absolute place.
        """
        place = self._placement_of(reference) if reference else None
        if reference is None or place is None or place.startswith(".."):
            return ""
        return reference[: reference.replace("\\", "/").rfind("/") + 1].lstrip()

    def _placement_of(self, reference: str) -> str | None:
        return self.resolver.place(reference) if self.resolver else placement(reference)


@dataclass(frozen=True, eq=False, slots=True)
class LinkVisual:
    """A visual in the frame of its link: a shape, or a mesh file under a pose and scales (3,), one negative at most."""

    what: Shape | str
    pose: Pose
    scale: Floats
    rgba: Rgba | None


@dataclass(slots=True)
class VisualFiles:
    """Collects the files; takes: whether the format shows a mesh file as it is; native: the shapes that it has.

    copies: by their place beside the main file; refused: bodies whose visual cannot be read.
    """

    files: HullFiles
    takes: Callable[[Path], bool]
    native: UnionType
    copies: dict[str, Path] = field(default_factory=dict)
    refused: list[str] = field(default_factory=list)
    _base: Path | None = None
    _made: dict[Path, str | None] = field(default_factory=dict)

    def gather(self, visuals: Iterable[tuple[str, Visual | Surface]]) -> None:
        """Find the folder that holds all mesh files with what they need beside them; it becomes one of the output."""
        paths = {v.what for _, v in visuals if isinstance(v, Visual) and isinstance(v.what, Path)}
        beside = {path for mesh in paths for path in find_companions(mesh).values()}
        if paths:
            self._base = Path(os.path.commonpath([path.parent for path in (*paths, *beside)]))

    def add_visual(self, body: str, visual: Visual | Surface, root_t_link: Pose) -> LinkVisual | None:
        """Return a visual as it is to be written; None where its file cannot be read."""
        link_t_root = root_t_link.inverse()
        if isinstance(visual, Surface):
            reference = self._make_obj(f"{body}-visual", link_t_root.apply(visual.vertices), visual.faces)
            return LinkVisual(reference, Pose.identity(), np.ones(3), visual.rgba)
        moved = visual.move(link_t_root)
        if isinstance(moved.what, Shape):
            what, is_native = moved.what, isinstance(moved.what, self.native)
            own = what if is_native else self.files.add(f"{body}-visual", "", what.vertices, what.faces)
            return LinkVisual(own, Pose.identity(), np.ones(3), moved.rgba)
        split = _split_scale(moved.linear)
        if split is None:
            return self._bake(body, moved)
        file = self._place_file(moved.what)
        if file is None:
            self.refused.append(body)
            return None
        return LinkVisual(file, Pose(split[0], kinematic_tree.drop_rounding(moved.offset, 1.0)), split[1], moved.rgba)

    def _place_file(self, mesh: Path) -> str | None:
        if mesh not in self._made:
            self._made[mesh] = self._copy(mesh) if self.takes(mesh) else self._convert(mesh)
        return self._made[mesh]

    def _copy(self, mesh: Path) -> str:
        place = self._place_of(mesh)
        self.copies[place] = mesh
        for key, path in find_companions(mesh).items():
            self.copies.setdefault(posixpath.normpath(posixpath.join(posixpath.dirname(place), key)), path)
        return place

    def _place_of(self, mesh: Path) -> str:
        assert self._base is not None  # `gather` saw the file
        return f"{self.files.stem}--visuals/{mesh.relative_to(self._base).as_posix()}"

    def _convert(self, mesh: Path) -> str | None:
        """An OBJ of a file of another kind; None where it cannot be read."""
        try:
            soup = join_surfaces(mesh_reader.read_triangles(mesh))
        except MeshForgeError:
            return None
        return self._make_obj(f"{mesh.stem}-visual", soup.vertices, soup.faces)

    def _bake(self, body: str, visual: Visual) -> LinkVisual | None:
        surfaces = visual.surfaces()
        if not surfaces:
            self.refused.append(body)
            return None
        reference = self._make_obj(f"{body}-visual", *stack_triangles((s.vertices, s.faces) for s in surfaces))
        return LinkVisual(reference, Pose.identity(), np.ones(3), visual.rgba)

    def _make_obj(self, name: str, vertices: Floats, faces: Ints) -> str:
        """An OBJ of triangles, with the four vertices at least that MuJoCo asks for."""
        enough = np.concatenate([vertices, vertices[:1]]) if len(vertices) < 4 else vertices
        return self.files.add(name, "", enough, faces)


def _split_scale(linear: Floats) -> tuple[Floats, Floats] | None:
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
