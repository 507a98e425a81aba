"""Reading a URDF: from its bytes to an asset, with the shapes of its collisions, what its links show, other names of
its collisions, and notes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.common import MeshForgeError, join_names, plain_path, pluralize
from meshforge.formats import base, collision_pieces, mesh_reader, slots
from meshforge.formats.references import Resolver, find_all
from meshforge.formats.urdf import document
from meshforge.formats.urdf.document import UrdfLinks, read_links, read_mechanism
from meshforge.formats.visuals import Visual, VisualSurfaces
from meshforge.formats.xml import Element, XmlText
from meshforge.geometry import Floats, Pose
from meshforge.symbolic import Asset, Body, FileNote, Mentions, Rgba

_UP = (0.0, 0.0, 1.0)


def read_primitive(kind: Element, pose: Pose, where: str) -> collision_pieces.CollisionPiece:
    """The shape of an element that is no mesh; pose: root_T_geometry.

    Raises AssetError with `where:line` for a missing or unreadable attribute.
    """
    match kind.tag:
        case "box":
            sizes = document.read_floats(kind, "size", 3, where)
        case "sphere":
            sizes = document.read_floats(kind, "radius", 1, where)
        case "cylinder" | "capsule":
            sizes = np.concatenate([document.read_floats(kind, name, 1, where) for name in ("radius", "length")])
        case "plane":
            turn = collision_pieces.turn_z_to(document.read_floats(kind, "normal", 3, where, _UP))
            return collision_pieces.CollisionPiece(None, "a plane has no end", plane=pose @ turn)
        case _:
            return collision_pieces.CollisionPiece(None, f"<{kind.tag}> is no geometry that is known")
    return collision_pieces.build_primitive(kind.tag, sizes, pose)


def read_mesh_scale(mesh: Element, where: str, label: str) -> Floats:
    """The factors (3,) by which a `<mesh>` is scaled; one number stands for three, as in PyBullet.

    Raises AssetError naming `label`: a factor is zero.
    """
    single = len(mesh.attributes.get("scale", "").replace(",", " ").split()) == 1
    scale = document.read_floats(mesh, "scale", 1 if single else 3, where, (1.0, 1.0, 1.0))
    given = f"scale={mesh.attributes.get('scale')!r}"
    collision_pieces.refuse_zero_scale(scale, label, given, f"{where}:{mesh.line}")
    return np.broadcast_to(scale, (3,))


def read_parts(
    found: Sequence[tuple[str, Element]],
    uses: Sequence[collision_pieces.MeshUse | None],
    links: UrdfLinks,
    meshes: collision_pieces.CollisionMeshes,
    where: str,
) -> list[list[collision_pieces.CollisionPiece]]:
    """The pieces of each collision element, in the root frame; none where it has no geometry."""
    parts: list[list[collision_pieces.CollisionPiece]] = []
    for (link, collision), use in zip(found, uses, strict=True):
        kind = document.geometry_of(collision)
        pose = links.poses[link] @ document.read_origin(collision, where)
        if kind is None:
            parts.append([])
        elif use is not None:
            linear = pose.rotation * read_mesh_scale(kind, where, use.label)
            parts.append(
                collision_pieces.place_pieces(meshes.pieces(use), linear, pose.translation, meshes.surfaces(use))
            )
        else:
            parts.append([read_primitive(kind, pose, where)])
    return parts


LinkCollisions = Sequence[tuple[str, Element]]  # of each `<collision>` the name of its link, and the element


def read_urdf(path: Path, options: base.ReadOptions, source: bytes | None = None) -> Asset:
    """The asset in a URDF file, its collision meshes included; source: what counts instead of what the file holds.

    Raises AssetError naming file, line, link and element: text that is not understood, links and joints that make no
    tree, a collision mesh that is not there.
    """
    where = str(path)
    source = mesh_reader.read_content(path) if source is None else source
    robot = document.parse_robot(XmlText.of(source).data, where)
    links = read_links(robot, where)
    resolver = Resolver(plain_path(path).parent, tuple(map(plain_path, options.package_roots)))
    meshes = collision_pieces.CollisionMeshes()
    found = list(document.collisions(robot))
    uses = _mesh_uses(found, resolver, where)
    collision_pieces.refuse_missing(use for use in uses if use)
    parts = read_parts(found, uses, links, meshes, where)
    authored = slots.name_elements(found, [len(own) for own in parts])
    mentions = [
        meshes.mention_groups(use, mentions_of_element(links.elements[link], collision), len(own))
        for (link, collision), use, own in zip(found, uses, parts, strict=True)
    ]
    files, missing = find_all(document.references(robot), resolver)
    return Asset(
        path=path,
        format="urdf",
        bodies=tuple(Body(name, pose) for name, pose in links.poses.items()),
        geoms=collision_pieces.geoms_of(authored, parts, mentions),
        document=document.UrdfDocument(source, authored, resolver, meshes.digests()),
        non_convex=collision_pieces.non_convex_of(authored, parts, mentions),
        visuals=read_visuals(robot, links.elements, links.poses, resolver, where),
        files=files,
        missing=missing,
        notes=tuple(collect_notes(robot, links, found)),
        mechanism=read_mechanism(robot, links),
    )


def _mesh_uses(found: LinkCollisions, resolver: Resolver, where: str) -> list[collision_pieces.MeshUse | None]:
    """The mesh file of each collision element, None where it has another geometry or none."""
    uses: list[collision_pieces.MeshUse | None] = []
    for element, (_, collision) in zip(slots.name_elements(found, [1] * len(found)), found, strict=True):
        kind = document.geometry_of(collision)
        is_mesh = kind is not None and kind.tag == "mesh"
        reference = kind.attributes.get("filename", "").strip() if kind else ""
        place = f"{where}:{kind.line}" if kind else where
        uses.append(collision_pieces.MeshUse(element.names[0], reference, place, resolver) if is_mesh else None)
    return uses


def read_visuals(
    robot: Element, links: Mapping[str, Element], poses: Mapping[str, Pose], resolver: Resolver, where: str
) -> VisualSurfaces:
    """The visuals of all links; one that is not understood is left out, it never fails."""
    colors = _read_colors(robot, where)
    return VisualSurfaces(
        tuple(
            replace(visual, rgba=_read_color(element.first("material"), colors, where))
            for name, link in links.items()
            for element in link.each("visual")
            for visual in _read_visual(name, element, poses[name], resolver, where)
        )
    )


def _read_colors(robot: Element, where: str) -> dict[str, Rgba]:
    materials = (element for element in robot.walk() if element.tag == "material" and "name" in element.attributes)
    found = ((material.attributes["name"], _read_color(material, {}, where)) for material in materials)
    return {name: color for name, color in found if color is not None}


def _read_color(material: Element | None, named: Mapping[str, Rgba], where: str) -> Rgba | None:
    if material is None:
        return None
    color = material.first("color")
    if color is None:
        return named.get(material.attributes.get("name", ""))
    try:
        red, green, blue, alpha = document.read_floats(color, "rgba", 4, where).tolist()
    except MeshForgeError:
        return None
    return red, green, blue, alpha


def _read_visual(link: str, element: Element, pose: Pose, resolver: Resolver, where: str) -> Iterator[Visual]:
    kind = document.geometry_of(element)
    if kind is None:
        return
    try:
        at = pose @ document.read_origin(element, where)
        if kind.tag != "mesh":
            shape = read_primitive(kind, at, where).shape
            if shape is not None:
                yield Visual(link, shape, np.eye(3), np.zeros(3))
        elif path := resolver.find(kind.attributes.get("filename", "")):
            yield Visual(link, path, at.rotation * read_mesh_scale(kind, where, "visual"), at.translation)
    except MeshForgeError:
        return


def mentions_of_element(link: Element, collision: Element) -> Mentions:
    """What is said of a `<collision>` of a link."""
    return collision_pieces.collect_mentions(_names_of(collision), map(_names_of, link.each("visual")))


def _names_of(element: Element) -> collision_pieces.ShapeNames | None:
    """The names of a collision or visual element; of a collision without its own, which its hulls have."""
    kind = document.geometry_of(element)
    if kind is None:
        return None
    material = element.first("material")
    reference = kind.attributes.get("filename", "")
    origin = element.first("origin")
    place = tuple(sorted(origin.attributes.items())) if origin else ()
    shape = reference or (kind.tag, tuple(sorted(kind.attributes.items())), place)
    name = "" if element.tag == "collision" else element.attributes.get("name", "")
    return collision_pieces.ShapeNames(
        shape, name, collision_pieces.stem_of(reference), material.attributes.get("name", "") if material else ""
    )


def collect_notes(robot: Element, links: UrdfLinks, found: LinkCollisions) -> Iterator[str]:
    """Notes on links without a parent, xacro, and collision elements that engines pass over."""
    if len(links.roots) > 1:
        yield (
            f"{len(links.roots)} links have no parent joint ({join_names(links.roots)}): each is taken at the origin, "
            "as MuJoCo does; PyBullet cannot load such a file"
        )
    if xacro := [element.line for element in robot.walk() if element.tag.startswith("xacro:")]:
        yield f"{pluralize(len(xacro), 'xacro element')} not expanded, the first on line {xacro[0]}: passed over"
    known = {id(collision) for _, collision in found}
    if stray := [e.line for e in robot.walk() if e.tag.lower() == "collision" and id(e) not in known]:
        strays = f"{pluralize(len(stray), 'collision')} in no link"
        yield f"{strays}, the first on line {stray[0]}: passed over, as by engines"
    for link, collision in found:
        place = f"a collision of link {link!r} on line {collision.line} has"
        shapes = [len(geometry.children) for geometry in collision.each("geometry")]
        if not shapes or not shapes[0]:
            yield FileNote(f"{place} no geometry and is left as it is")
        elif sum(shapes) > 1:
            yield f"{place} {sum(shapes)} shapes, of which one counts, as for engines"
