"""Reading a URDF: from its bytes to an asset."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from meshforge.asset import Asset, Body, Geom, Opaque
from meshforge.errors import AssetError, MeshForgeError
from meshforge.formats.base import ReadOptions
from meshforge.formats.companions import companions
from meshforge.formats.triangles import pieces_of, read_triangles
from meshforge.formats.urdf.document import Authored, UrdfDocument, collisions, digest_of, piece_names
from meshforge.formats.urdf.kinematics import Links, read_links
from meshforge.formats.urdf.numbers import origin
from meshforge.formats.urdf.references import Resolver
from meshforge.formats.urdf.shapes import Part, geometry_of, mesh_parts, mesh_scale, primitive
from meshforge.formats.urdf.text import Text
from meshforge.formats.urdf.tree import Element, parsed
from meshforge.formats.urdf.visuals import read_visuals
from meshforge.geometry import Piece, Pose


def read_urdf(path: Path, options: ReadOptions) -> Asset:
    """The asset in a URDF file, its collision meshes included.

    Raises AssetError naming file, line, link and element: text that is not understood, links and joints that make no
    tree, a collision mesh that is not there.
    """
    try:
        source = path.read_bytes()
    except OSError as error:
        raise AssetError(f"cannot be read: {error.strerror}", where=str(path)) from error
    robot = robot_of(Text.of(source).data, str(path))
    links = read_links(robot, str(path))
    roots = tuple(_absolute(root) for root in options.package_roots)
    resolver = Resolver(_absolute(path).parent, roots)
    return _Reading(path, robot, links, resolver).asset(source)


def _absolute(path: Path) -> Path:
    return Path(os.path.normpath(path.absolute()))


def robot_of(data: bytes, where: str) -> Element:
    """The `<robot>` of a URDF text in UTF-8. Raises AssetError: not well formed, or of another kind."""
    root = parsed(data, where)
    if root.tag != "robot":
        raise AssetError(f"is no URDF: its root element is <{root.tag}>, not <robot>", where=f"{where}:{root.line}")
    return root


def references(robot: Element) -> list[str]:
    """Every mesh and texture reference of the document, in order of mention, each once."""
    found = (e.attributes.get("filename") for e in robot.walk() if e.tag in ("mesh", "texture"))
    return list(dict.fromkeys(reference for reference in found if reference))


class _Reading:
    """One file on its way to an asset; each mesh file is read once."""

    def __init__(self, path: Path, robot: Element, links: Links, resolver: Resolver) -> None:
        self.path, self.where = path, str(path)
        self.robot, self.links, self.resolver = robot, links, resolver
        self.pieces: dict[Path, list[Piece]] = {}
        self.notes: list[str] = []

    def asset(self, source: bytes) -> Asset:
        found = list(collisions(self.robot))
        labels = [names[0] for names in piece_names([(_link(a), _name(c), 1) for a, c in found])]
        self._refuse_missing(found, labels)
        parts = [self._parts(_link(a), c, label) for (a, c), label in zip(found, labels, strict=True)]
        names = piece_names([(_link(a), _name(c), len(p)) for (a, c), p in zip(found, parts, strict=True)])
        authored = tuple(Authored(_link(a), n) for (a, _), n in zip(found, names, strict=True))
        self._note_roots()
        files, missing = self._files()
        several = [path for path, pieces in self.pieces.items() if len(pieces) > 1]
        return Asset(
            path=self.path,
            format="urdf",
            bodies=tuple(Body(name, pose) for name, pose in self.links.poses.items()),
            geoms=_geoms(authored, parts),
            document=UrdfDocument(source, authored, self.resolver.roots, tuple((p, digest_of(p)) for p in several)),
            opaque=_opaque(authored, parts),
            visuals=read_visuals(self.links.elements, self.links.poses, self.resolver, self.where),
            files=files,
            missing=missing,
            notes=tuple(self.notes),
        )

    def _parts(self, link: str, collision: Element, label: str) -> list[Part]:
        kind = geometry_of(collision)
        if kind is None:
            self.notes.append(f"collision {label!r} on line {collision.line} has no geometry and is left as it is")
            return []
        pose = self.links.poses[link] @ origin(collision, self.where)
        return self._mesh(kind, pose, label) if kind.tag == "mesh" else [primitive(kind, pose, self.where)]

    def _mesh(self, mesh: Element, pose: Pose, label: str) -> list[Part]:
        scale = mesh_scale(mesh, self.where, label)
        path = self.resolver.find(mesh.attributes["filename"])
        assert path is not None  # `_refuse_missing` saw it
        if path not in self.pieces:
            try:
                self.pieces[path] = pieces_of(read_triangles(path), name=str(path))
            except MeshForgeError as error:
                place = f"{self.where}:{mesh.line}"
                raise AssetError(f"collision {label!r}: {error.message}", where=place) from error
        return mesh_parts(self.pieces[path], pose.rotation * scale, pose.translation)

    def _refuse_missing(self, found: Sequence[tuple[Element, Element]], labels: Sequence[str]) -> None:
        """Raise for collision meshes that are not there, naming the first and counting the others."""
        lost: list[tuple[Element, str, str]] = []
        for (_, collision), label in zip(found, labels, strict=True):
            mesh = geometry_of(collision)
            if mesh is not None and mesh.tag == "mesh":
                reference = mesh.attributes.get("filename", "")
                if not reference:
                    raise AssetError(f"collision {label!r} names no mesh file", where=f"{self.where}:{mesh.line}")
                if self.resolver.find(reference) is None:
                    lost.append((mesh, label, reference))
        if lost:
            mesh, label, reference = lost[0]
            others = f" (and {len(lost) - 1} more like it)" if len(lost) > 1 else ""
            raise AssetError(
                f"the mesh {reference!r} of collision {label!r} is not there{others}",
                where=f"{self.where}:{mesh.line}",
                remedy=self.resolver.advice(reference),
            )

    def _note_roots(self) -> None:
        roots = self.links.roots
        if len(roots) > 1:
            self.notes.append(
                f"{len(roots)} links have no parent joint ({', '.join(roots[:5])}{', ...' if len(roots) > 5 else ''}): "
                "each is taken at the origin, as MuJoCo does; PyBullet cannot load such a file"
            )

    def _files(self) -> tuple[tuple[Path, ...], tuple[str, ...]]:
        """The referenced files that are there, with their companions, and the references that lead nowhere."""
        files: dict[Path, None] = {}
        missing = []
        for reference in references(self.robot):
            path = self.resolver.find(reference)
            if path is None:
                missing.append(reference)
            else:
                files |= dict.fromkeys([path, *companions(path).values()])
        return tuple(files), tuple(missing)


def _link(element: Element) -> str:
    return element.attributes["name"]


def _name(element: Element) -> str | None:
    return element.attributes.get("name")


def _geoms(authored: Sequence[Authored], parts: Sequence[Sequence[Part]]) -> tuple[Geom, ...]:
    return tuple(
        Geom(name, element.link, part.shape)
        for element, own in zip(authored, parts, strict=True)
        for name, part in zip(element.names, own, strict=True)
        if part.shape is not None
    )


def _opaque(authored: Sequence[Authored], parts: Sequence[Sequence[Part]]) -> tuple[Opaque, ...]:
    return tuple(
        Opaque(name, element.link, part.reason, part.surface)
        for element, own in zip(authored, parts, strict=True)
        for name, part in zip(element.names, own, strict=True)
        if part.shape is None
    )
