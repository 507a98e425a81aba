"""Read the links of a URDF or SDF: collisions with their mesh files, each read and cut once, names, and visuals."""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, MeshForgeError, MissingFilesError, file_digest
from meshforge.formats import collision_pieces
from meshforge.formats.collision_pieces import CollisionElement, CollisionPiece, ShapeNames, name_elements
from meshforge.formats.mesh_reader import read_triangles, split_into_pieces
from meshforge.formats.meshfile.surface import RawSurface
from meshforge.formats.references import Resolver, reference_of
from meshforge.formats.visuals import Visual, VisualSurfaces
from meshforge.formats.xml import Element, format_numbers
from meshforge.geometry import Floats, Piece, Pose
from meshforge.symbolic import Geom, Mentions, NonConvexPiece, Rgba

_SHOWN = 120  # characters of a reference in a message
_LEAST_SCALE = 1e-12  # a factor that is taken for zero

_GEOMETRY_TAGS = (
    *("box", "sphere", "cylinder", "capsule", "ellipsoid", "cone"),
    *("plane", "mesh", "polyline", "heightmap", "image", "empty"),
)
"""The elements of a `<geometry>` that engines know."""


def geometry_of(element: Element) -> Element | None:
    """Return what the `<geometry>` of a collision or visual holds, None where there is nothing."""
    geometry = element.first("geometry")
    if geometry is None or not geometry.children:
        return None
    return next((child for child in geometry.children if child.tag in _GEOMETRY_TAGS), geometry.children[0])


@dataclass(frozen=True, eq=False, slots=True)
class Link:
    """A `<link>` as a body: its name in the asset, root_T_link, its file, and what finds the references of that."""

    body: str
    element: Element
    pose: Pose
    where: str
    resolver: Resolver


@dataclass(frozen=True, slots=True)
class LinkCollisions:
    """What collides; found: each `<collision>` with its link, as in authored; digests: see `CollisionMeshes`."""

    found: tuple[tuple[Link, Element], ...]
    authored: tuple[CollisionElement, ...]
    geoms: tuple[Geom, ...]
    non_convex: tuple[NonConvexPiece, ...]
    digests: tuple[tuple[Path, str], ...]


class CollisionMeshes:
    """The mesh files that collision elements refer to.

    digests: of files as they were when the asset was read, where they count; cut: the pieces of what was cut so far.
    """

    def __init__(self, digests: Iterable[tuple[Path, str]] | None = None) -> None:
        self._known = None if digests is None else dict(digests)
        self._files: dict[Path, Sequence[RawSurface]] = {}
        self._surfaces: dict[tuple[Path, tuple[str, ...]], Sequence[RawSurface]] = {}
        self.cut: dict[tuple[Path, tuple[str, ...]], list[Piece]] = {}

    def select(self, surfaces: Sequence[RawSurface], part: tuple[str, ...]) -> Sequence[RawSurface]:
        """Return what a part of a file stands for: all of it."""
        return surfaces

    def surfaces(self, path: Path, part: tuple[str, ...]) -> Sequence[RawSurface]:
        """Return what an element uses of a file. Raises MeshForgeError: it cannot be read, or has no such part."""
        if (path, part) not in self._surfaces:
            if path not in self._files:
                self._files[path] = read_triangles(path)
            self._surfaces[path, part] = self.select(self._files[path], part)
        return self._surfaces[path, part]

    def pieces(self, path: Path, part: tuple[str, ...]) -> list[Piece]:
        """Return the pieces of that, in the unit of the file. Raises AssetError also where it has changed."""
        if (path, part) not in self.cut:
            if self._known is not None and file_digest(path) != self._known.get(path):
                raise collision_pieces.change_error(f"the mesh {path.name!r}", str(path))
            self.cut[path, part] = split_into_pieces(self.surfaces(path, part), name=str(path))
        return self.cut[path, part]

    def digests(self) -> tuple[tuple[Path, str], ...]:
        """Return digests of the files that hold several pieces, which an edit may have to part."""
        several = dict.fromkeys(path for (path, _), pieces in self.cut.items() if len(pieces) > 1)
        return tuple((path, file_digest(path)) for path in several)


@dataclass(frozen=True, slots=True)
class _MeshUse:
    """A collision that refers to a mesh file; label: its name in messages; place: `file:line`; path: None if lost."""

    label: str
    reference: str
    place: str
    resolver: Resolver
    path: Path | None


class LinkReader(ABC):
    """A reader of links: how its format writes shapes; kinds: their elements; meshes: the mesh files so far."""

    kinds: tuple[str, ...]

    def __init__(self, meshes: CollisionMeshes) -> None:
        self.meshes = meshes

    @abstractmethod
    def place(self, link: Link, element: Element) -> Pose:
        """Return root_T_element of something in a link. Raises AssetError with `where:line`."""

    @abstractmethod
    def read_numbers(self, element: Element, name: str, where: str, default: tuple[float, ...]) -> Floats:
        """Return what an element says of a name, as long as the default of SDF. Raises AssetError with `where:line`."""

    @abstractmethod
    def read_color(self, visual: Element, where: str) -> Rgba | None:
        """Return the colour of a `<visual>`, None where that is left to its file."""

    def read_shape(self, element: Element, kind: Element, pose: Pose, where: str) -> CollisionPiece:
        """Return the shape of a collision or visual that is no mesh; pose: root_T_geometry. Raises AssetError."""
        if kind.tag not in self.kinds:
            return CollisionPiece(None, f"<{kind.tag}> is no geometry that is known")
        if kind.tag == "plane":
            turn = collision_pieces.turn_z_to(self.read_numbers(kind, "normal", where, (0.0, 0.0, 1.0)))
            return CollisionPiece(None, "a plane has no end", plane=pose @ turn)
        defaults: dict[str, tuple[float, ...]] = {"radius": (1.0 if kind.tag in ("sphere", "cylinder") else 0.5,)}
        if kind.tag in ("box", "ellipsoid"):
            defaults = {"size" if kind.tag == "box" else "radii": (1.0, 1.0, 1.0)}
        elif kind.tag != "sphere":
            defaults["length"] = (1.0,)
        sizes = [self.read_numbers(kind, name, where, default) for name, default in defaults.items()]
        return collision_pieces.build_primitive(kind.tag, np.concatenate(sizes), pose)

    def part_of(self, mesh: Element) -> tuple[str, ...]:
        """Return what of its file a `<mesh>` uses, see `CollisionMeshes.select`."""
        return ()

    def place_mesh(self, kind: Element, path: Path, linear: Floats, offset: Floats) -> list[CollisionPiece]:
        """Return the pieces of a mesh under x -> linear @ x + offset. Raises MeshForgeError: it cannot be read."""
        pieces, surfaces = self.meshes.pieces(path, self.part_of(kind)), self.meshes.surfaces(path, self.part_of(kind))
        return collision_pieces.place_pieces(pieces, linear, offset, surfaces)

    def unit_of(self, path: Path) -> float:
        """Return the metres of the unit that the file of a visual is in, where the format's engines obey it."""
        return 1.0

    def read_collisions(self, links: Iterable[Link]) -> LinkCollisions:
        """Return the collisions of all links.

        Raises AssetError naming file, line and element: what is not understood, a mesh that is not there.
        """
        found = tuple((link, element) for link in links for element in link.element.each("collision"))
        own = [(link.body, element) for link, element in found]
        labels = name_elements(own, [1] * len(own))
        uses = [self._find_mesh(*one, label.names[0]) for one, label in zip(found, labels, strict=True)]
        _refuse_missing([use for use in uses if use])
        parts = [self._read_pieces(*one, use) for one, use in zip(found, uses, strict=True)]
        authored = name_elements(own, map(len, parts))
        mentions = [self._list_mentions(*one, use, len(p)) for one, use, p in zip(found, uses, parts, strict=True)]
        pieces = collision_pieces.build_pieces(authored, parts, mentions)
        return LinkCollisions(found, authored, *pieces, self.meshes.digests())

    def read_visuals(self, links: Iterable[Link]) -> VisualSurfaces:
        """Return the visuals of all links; one that is not understood is left out, it never fails."""
        found = (self._read_visual(link, element) for link in links for element in link.element.each("visual"))
        return VisualSurfaces(tuple(visual for visual in found if visual))

    def _find_mesh(self, link: Link, element: Element, label: str) -> _MeshUse | None:
        kind = geometry_of(element)
        if kind is None or kind.tag != "mesh":
            return None
        reference = reference_of(kind)
        path = link.resolver.find(reference) if reference else None
        return _MeshUse(label, reference, f"{link.where}:{kind.line}", link.resolver, path)

    def _read_pieces(self, link: Link, element: Element, use: _MeshUse | None) -> list[CollisionPiece]:
        """The pieces of a collision in the root frame; none where it has no geometry."""
        kind = geometry_of(element)
        if kind is None:
            return []
        pose = self.place(link, element)
        if use is None or use.path is None:
            return [self.read_shape(element, kind, pose, link.where)]
        scale = self._scale_of(kind, link.where, use.label)
        try:
            return self.place_mesh(kind, use.path, pose.rotation * scale, pose.translation)
        except MeshForgeError as error:
            raise AssetError(f"collision {use.label!r}: {error.message}", where=use.place) from error

    def _scale_of(self, mesh: Element, where: str, label: str) -> Floats:
        scale = self.read_numbers(mesh, "scale", where, (1.0, 1.0, 1.0))
        if np.abs(scale).min() < _LEAST_SCALE:
            problem = f"collision {label!r} is scaled to nothing: scale {format_numbers(scale)}"
            remedy = "Give every axis a factor that is not zero."
            raise AssetError(problem, where=f"{where}:{mesh.line}", remedy=remedy)
        return scale

    def _list_mentions(self, link: Link, element: Element, use: _MeshUse | None, count: int) -> list[Mentions]:
        """What is said of each piece of an element, of those of a file also the name of its group or node."""
        shown, kind = map(self._names_of, link.element.each("visual")), geometry_of(element)
        common = collision_pieces.collect_mentions(self._names_of(element), shown)
        key = (use.path, self.part_of(kind)) if kind and use and use.path else None
        pieces = self.meshes.cut.get(key, []) if key else []
        if key is None or len(pieces) != count:
            return [common] * count
        groups = [self.meshes.surfaces(*key)[piece.group].name for piece in pieces]
        return [(("group", group), *common) if group else common for group in groups]

    def _names_of(self, element: Element) -> ShapeNames | None:
        """The names of a collision or visual element; of a collision without its own, which its hulls have."""
        kind = geometry_of(element)
        if kind is None:
            return None
        reference = reference_of(kind) if kind.tag == "mesh" else ""
        name = "" if element.tag == "collision" else element.attributes.get("name", "")
        shape = reference or tuple(map(_identify, (kind, element.first("origin"), element.first("pose"))))
        return ShapeNames(shape, name, collision_pieces.stem_of(reference), material_of(element))

    def _read_visual(self, link: Link, element: Element) -> Visual | None:
        kind = geometry_of(element)
        if kind is None:
            return None
        try:
            at = self.place(link, element)
            if kind.tag != "mesh":
                shape = self.read_shape(element, kind, at, link.where).shape
                found = Visual(link.body, shape, np.eye(3), np.zeros(3)) if shape else None
            elif path := link.resolver.find(reference_of(kind)):
                scale = self._scale_of(kind, link.where, "visual") * self.unit_of(path)
                found = Visual(link.body, path, at.rotation * scale, at.translation)
            else:
                found = None
        except MeshForgeError:
            return None
        return replace(found, rgba=self.read_color(element, link.where)) if found else None


def _identify(element: Element | None) -> object:
    """What tells an element from others."""
    if element is None:
        return None
    texts = [(part.tag, " ".join(part.text.split())) for part in (element, *element.children)]
    return tuple(sorted(element.attributes.items())), tuple(texts)


def material_of(element: Element) -> str:
    """Return the name of an element's material, of SDF that of its script; empty without one."""
    material = element.first("material")
    script = material.first("script") if material else None
    named = script.first("name") if script else None
    return named.text if named else material.attributes.get("name", "") if material else ""


def _refuse_missing(uses: Sequence[_MeshUse]) -> None:
    """Raise AssetError where files are not there: the first, and how many more."""
    for use in uses:
        if not use.reference:
            raise AssetError(f"collision {use.label!r} names no mesh file", where=use.place)
    if missing := [use for use in uses if use.path is None]:
        first, others = missing[0], f" (and {len(missing) - 1} more like it)" if len(missing) > 1 else ""
        shown = first.reference if len(first.reference) <= _SHOWN else f"{first.reference[:_SHOWN]}..."
        problem = f"the mesh {shown!r} of collision {first.label!r} is not there{others}"
        remedy, lost = first.resolver.advice(first.reference), dict.fromkeys(use.reference for use in missing)
        raise MissingFilesError(problem, missing=lost, where=first.place, remedy=remedy)
