"""Reading a URDF: from its bytes to an asset."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from meshforge.asset import Asset, Body, Mentions
from meshforge.files import plain_path
from meshforge.formats.base import ReadOptions
from meshforge.formats.collision_meshes import CollisionMeshes, MeshUse, refuse_missing
from meshforge.formats.companions import companions
from meshforge.formats.element_names import piece_names
from meshforge.formats.element_pieces import geoms_of, opaque_of
from meshforge.formats.element_plan import Authored
from meshforge.formats.mesh_parts import MeshPart, mesh_parts
from meshforge.formats.references import Resolver
from meshforge.formats.triangles import contents
from meshforge.formats.urdf.document import UrdfDocument
from meshforge.formats.urdf.kinematics import Links, read_links
from meshforge.formats.urdf.mechanism import read_mechanism
from meshforge.formats.urdf.mentions import element_mentions
from meshforge.formats.urdf.notes import notes
from meshforge.formats.urdf.numbers import origin
from meshforge.formats.urdf.robot import collisions, references, robot_of
from meshforge.formats.urdf.shapes import geometry_of, mesh_scale, primitive
from meshforge.formats.urdf.visuals import read_visuals
from meshforge.formats.xml import Element, Text


def read_urdf(path: Path, options: ReadOptions) -> Asset:
    """The asset in a URDF file, its collision meshes included.

    Raises AssetError naming file, line, link and element: text that is not understood, links and joints that make no
    tree, a collision mesh that is not there.
    """
    where = str(path)
    source = contents(path)
    robot = robot_of(Text.of(source).data, where)
    links = read_links(robot, where)
    resolver = Resolver(plain_path(path).parent, tuple(map(plain_path, options.package_roots)))
    meshes = CollisionMeshes()
    found = list(collisions(robot))
    uses = _uses(found, resolver, where)
    refuse_missing(use for use in uses if use)
    parts = _parts(found, uses, links, meshes, where)
    authored = _authored(found, [len(own) for own in parts])
    told = _mentions(found, links, [meshes.groups(use) for use in uses], parts)
    files, missing = _files(robot, resolver)
    return Asset(
        path=path,
        format="urdf",
        bodies=tuple(Body(name, pose) for name, pose in links.poses.items()),
        geoms=geoms_of(authored, parts, told),
        document=UrdfDocument(source, authored, resolver, meshes.digests()),
        opaque=opaque_of(authored, parts, told),
        visuals=read_visuals(robot, links.elements, links.poses, resolver, where),
        files=files,
        missing=missing,
        notes=notes(robot, links, found),
        mechanism=read_mechanism(robot, links),
    )


def _authored(found: Sequence[tuple[str, Element]], pieces: Sequence[int]) -> tuple[Authored, ...]:
    """The collision elements with the names of their pieces, of which each has so many."""
    own = [(link, c.attributes.get("name"), count) for (link, c), count in zip(found, pieces, strict=True)]
    return tuple(Authored(link, names) for (link, _, _), names in zip(own, piece_names(own), strict=True))


def _uses(found: Sequence[tuple[str, Element]], resolver: Resolver, where: str) -> list[MeshUse | None]:
    """The mesh file of each collision element, None where it has another geometry or none."""
    uses: list[MeshUse | None] = []
    for element, (_, collision) in zip(_authored(found, [1] * len(found)), found, strict=True):
        kind = geometry_of(collision)
        is_mesh = kind is not None and kind.tag == "mesh"
        reference = kind.attributes.get("filename", "").strip() if kind else ""
        place = f"{where}:{kind.line}" if kind else where
        uses.append(MeshUse(element.names[0], reference, place, resolver) if is_mesh else None)
    return uses


def _parts(
    found: Sequence[tuple[str, Element]],
    uses: Sequence[MeshUse | None],
    links: Links,
    meshes: CollisionMeshes,
    where: str,
) -> list[list[MeshPart]]:
    """The pieces of each collision element, in the root frame; none where it has no geometry."""
    parts: list[list[MeshPart]] = []
    for (link, collision), use in zip(found, uses, strict=True):
        kind = geometry_of(collision)
        pose = links.poses[link] @ origin(collision, where)
        if kind is None:
            parts.append([])
        elif use is not None:
            linear = pose.rotation * mesh_scale(kind, where, use.label)
            parts.append(mesh_parts(meshes.pieces(use), linear, pose.translation))
        else:
            parts.append([primitive(kind, pose, where)])
    return parts


def _mentions(
    found: Sequence[tuple[str, Element]],
    links: Links,
    groups: Sequence[Sequence[str | None]],
    parts: Sequence[Sequence[MeshPart]],
) -> list[list[Mentions]]:
    """What else is said of each piece of each collision element."""
    told = []
    for (link, collision), named, own in zip(found, groups, parts, strict=True):
        common = element_mentions(links.elements[link], collision)
        told.append([(("group", group), *common) if group else common for group in named or [None] * len(own)])
    return told


def _files(robot: Element, resolver: Resolver) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """The referenced files that are there, with their companions, and the references that lead nowhere."""
    files: dict[Path, None] = {}
    missing = []
    for reference in references(robot):
        path = resolver.find(reference)
        if path is None:
            missing.append(reference)
        else:
            files |= dict.fromkeys([path, *companions(path).values()])
    return tuple(files), tuple(missing)
