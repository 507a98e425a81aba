"""What an asset shows: surfaces that are read only when they are asked for, so that batches do not wait for them, with
one base colour or picture a mesh as trimesh reads them."""

import io
from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Self, overload

import numpy as np

from meshforge.common import MeshForgeError
from meshforge.formats import base, collision_pieces, mesh_reader
from meshforge.formats.meshfile.surface import GAMMA, parts_of_surfaces
from meshforge.geometry import Floats, Ints, Pose, Shape
from meshforge.symbolic import Asset, FeatureKind, Rgba, Surface, Texture


@dataclass(frozen=True, eq=False, slots=True)
class Visual:
    """What a body shows, in the root frame: a shape, or a mesh file under x -> linear @ x + offset.

    rgba: its colour, four shares of 1; None where that is left to the mesh file.
    """

    body: str
    what: Shape | Path
    linear: Floats
    offset: Floats
    rgba: Rgba | None = None

    def move(self, pose: Pose) -> Self:
        """Return the visual in another root frame; pose: new_T_old."""
        if isinstance(self.what, Shape):
            return replace(self, what=self.what.move(pose))
        offset = pose.rotation @ self.offset + pose.translation
        return replace(self, linear=pose.rotation @ self.linear, offset=offset)

    def read(self) -> list[Surface]:
        """Return its surfaces. Raises MeshForgeError: the file cannot be read."""
        if isinstance(self.what, Shape):
            return [Surface(self.what.vertices, self.what.faces, self.body, self.rgba)]
        return [
            replace(self._place(s.vertices, s.faces), rgba=self.rgba, parts=parts_of_surfaces([s], self.what.stem))
            for s in mesh_reader.read_triangles(self.what)
        ]

    def surfaces(self) -> list[Surface]:
        """Return its surfaces; none where the file cannot be read."""
        try:
            return self.read()
        except MeshForgeError:
            return []

    def surfaces_with_materials(self) -> list[Surface]:
        """Return its surfaces with the base colours and pictures of their file, unless it has a colour itself."""
        if isinstance(self.what, Shape) or self.rgba is not None:
            return self.surfaces()
        try:
            read = read_materials(self.what)
        except MeshForgeError:
            return []
        return [replace(self._place(s.vertices, s.faces), rgba=s.rgba, texture=s.texture) for s in read]

    def _place(self, vertices: Floats, faces: Ints) -> Surface:
        return collision_pieces.place_surface(vertices, faces, self.linear, self.offset, self.body)


class LazySurfaces(Sequence[Surface], ABC):
    """Surfaces that are made at the first look; pickles without them."""

    _made: tuple[Surface, ...] | None = None

    @abstractmethod
    def _make(self) -> Iterable[Surface]:
        """The surfaces."""

    @property
    def _surfaces(self) -> tuple[Surface, ...]:
        if self._made is None:
            self._made = tuple(self._make())
        return self._made

    @overload
    def __getitem__(self, index: int) -> Surface: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Surface, ...]: ...
    def __getitem__(self, index: int | slice) -> Surface | tuple[Surface, ...]:
        return self._surfaces[index]

    def __len__(self) -> int:
        return len(self._surfaces)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in vars(self).items() if name != "_made"}


class VisualSurfaces(LazySurfaces):
    """The surfaces of visuals."""

    def __init__(self, visuals: tuple[Visual, ...]) -> None:
        self.visuals = visuals
        self._absent = list[tuple[str, str]]()

    def _make(self) -> Iterator[Surface]:
        self._absent = []
        for visual in self.visuals:
            own, why = list[Surface](), f"{visual.what}: it has no triangles"
            try:
                own = visual.read()
            except MeshForgeError as error:
                why = error.sentence
            self._absent += [] if any(len(surface.faces) for surface in own) else [(visual.body, why)]
            yield from own

    def explain_absent(self) -> list[tuple[str, str]]:
        """Return the body of each visual that shows nothing, and why."""
        assert self._surfaces is not None  # looked for now
        return self._absent


def visuals_of(asset: Asset) -> list[tuple[str, Visual | Surface]]:
    """Return what each body shows; what belongs to none is shown by the first."""
    first = asset.bodies[0].name if asset.bodies else ""
    found = asset.visuals.visuals if isinstance(asset.visuals, VisualSurfaces) else asset.visuals
    return [(visual.body or first, visual) for visual in found]


def read_visual_surfaces(asset: Asset) -> tuple[list[tuple[str, Surface]], list[base.Loss]]:
    """Return the surfaces of visuals with their bodies, colours and pictures, and what cannot be read."""
    found: list[tuple[str, Surface]] = []
    refused: list[str] = []
    for body, visual in visuals_of(asset):
        surfaces = visual.surfaces_with_materials() if isinstance(visual, Visual) else [visual]
        found += [(body, surface) for surface in surfaces if len(surface.faces)]
        if not surfaces:
            refused.append(body)
    return found, unreadable_visuals(refused)


def unreadable_visuals(bodies: Sequence[str]) -> list[base.Loss]:
    """Return the loss of the visuals of some bodies, named once each; none where there are no such bodies."""
    names = tuple(dict.fromkeys(bodies))
    return [base.Loss(FeatureKind.VISUALS, names, "their files cannot be read")] if names else []


def linear_color(rgba: Rgba) -> list[float]:
    """Return red, green and blue of a colour as glTF and USD have them."""
    return [round(float(share), 6) for share in np.clip(rgba[:3], 0, 1) ** GAMMA]


def screen_color(linear: Sequence[float], alpha: float) -> Rgba:
    """Return a colour as screens show it, of red, green and blue as glTF and USD have them."""
    red, green, blue = (round(float(share), 4) for share in np.clip(linear, 0, 1) ** (1 / GAMMA))
    return red, green, blue, round(float(np.clip(alpha, 0, 1)), 6)


MATERIAL_SUFFIXES = (".obj", ".dae", ".glb", ".gltf")
"""The mesh files whose base colours and pictures `read_materials` reads."""
_SLIGHT = 1e-4  # share of the size, by which single precision moves a box


def read_materials(path: Path) -> list[Surface]:
    """Return the surfaces of a mesh file with base colours or pictures; plain where trimesh reads others.

    Raises AssetError: the file cannot be read.
    """
    plain = [Surface(surface.vertices, surface.faces) for surface in mesh_reader.read_triangles(path)]
    if path.suffix.lower() not in MATERIAL_SUFFIXES or find_spec("trimesh") is None:
        return plain
    import trimesh  # lazy: 0.3 s, and optional

    try:
        scene = trimesh.load_scene(path, process=False)
        found = [_read_mesh(mesh, path.suffix.lower()) for mesh in scene.dump() if isinstance(mesh, trimesh.Trimesh)]
    except Exception:  # whatever it raises for a damaged file, whose shape is known
        return plain
    return found if _is_same(plain, found) else plain


def _read_mesh(mesh: Any, suffix: str) -> Surface:
    vertices, faces = np.array(mesh.vertices, dtype=np.float64), np.array(mesh.faces, dtype=np.int64)
    material, places = getattr(mesh.visual, "material", None), getattr(mesh.visual, "uv", None)
    image = getattr(material, "baseColorTexture", getattr(material, "image", None))
    if image and image.size == (2, 2) and not image.format:
        return Surface(vertices, faces)  # trimesh made it up, for want of a material
    if image and places is not None and len(places) == len(vertices) and np.isfinite(places).all():
        file = io.BytesIO()
        image.save(file, "PNG")
        return Surface(vertices, faces, texture=Texture(np.array(places, dtype=np.float64), file.getvalue()))
    color = None if image else getattr(material, "baseColorFactor", getattr(material, "diffuse", None))
    if color is None:
        return Surface(vertices, faces)
    red, green, blue, alpha = (np.asarray(color, dtype=np.float64) / 255).tolist()
    is_linear = suffix in (".glb", ".gltf")
    rgba = screen_color((red, green, blue), alpha) if is_linear else (red, green, blue, alpha)
    return Surface(vertices, faces, rgba=rgba)


def _is_same(plain: list[Surface], found: list[Surface]) -> bool:
    """Whether surfaces have as many triangles in the same box; trimesh obeys the `up_axis` of Collada."""
    if sum(len(s.faces) for s in plain) != sum(len(s.faces) for s in found) or not found:
        return False
    corners = [np.concatenate([s.vertices[s.faces.ravel()] for s in each]) for each in (plain, found)]
    one, other = (np.concatenate([points.min(axis=0), points.max(axis=0)]) for points in corners)
    return bool(np.allclose(one, other, atol=_SLIGHT * np.ptp(one)))
