"""Read a URDF: from its text to an asset, with what its links show, other names of its collisions, and notes."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, join_names, plain_path, pluralize
from meshforge.formats import base, link_reader, mesh_reader
from meshforge.formats.references import Resolver, find_all
from meshforge.formats.urdf import document, srdf
from meshforge.formats.urdf.document import UrdfLinks, read_links, read_mechanism
from meshforge.formats.xml import Element, XmlText
from meshforge.geometry import Floats, Pose
from meshforge.symbolic import Asset, Body, FileNote, Rgba


def read_urdf(path: Path, options: base.ReadOptions, source: bytes | None = None) -> Asset:
    """Return the asset in a URDF file, its collision meshes included; source: counts instead of what the file holds.

    Raises AssetError naming file, line, link and element: text not understood, links in no tree, a missing mesh.
    """
    where = str(path)
    source = mesh_reader.read_content(path) if source is None else source
    robot = document.parse_robot(XmlText.of(source).data, where)
    placed = read_links(robot, where)
    resolver = Resolver(plain_path(path).parent, tuple(map(plain_path, options.package_roots)))
    links = [
        link_reader.Link(name, link, placed.poses[name], where, resolver) for name, link in placed.elements.items()
    ]
    reader = _UrdfReader(robot, where)
    collisions = reader.read_collisions(links)
    files, missing = find_all(document.references(robot), resolver)
    beside = srdf.srdf_beside(path)
    apart = tuple(pair for pair in srdf.read_pairs(beside) if placed.poses.keys() >= {*pair}) if beside else ()
    return Asset(
        path=path,
        format="urdf",
        bodies=tuple(Body(name, pose) for name, pose in placed.poses.items()),
        geoms=collisions.geoms,
        document=document.UrdfDocument(source, collisions.authored, resolver, collisions.digests),
        non_convex=collisions.non_convex,
        visuals=reader.read_visuals(links),
        files=(*files, beside) if beside else files,
        missing=missing,
        notes=tuple(_collect_notes(robot, placed, [(link.body, element) for link, element in collisions.found])),
        mechanism=replace(read_mechanism(robot, placed), apart=apart),
    )


class _UrdfReader(link_reader.LinkReader):
    kinds = ("box", "sphere", "cylinder", "capsule", "plane")

    def __init__(self, robot: Element, where: str) -> None:
        super().__init__(link_reader.CollisionMeshes())
        named = [e for e in robot.walk() if e.tag == "material" and "name" in e.attributes]
        found = ((material.attributes["name"], _read_rgba(material.first("color"), where)) for material in named)
        self.colors = {name: color for name, color in found if color is not None}

    def place(self, link: link_reader.Link, element: Element) -> Pose:
        return link.pose @ document.read_origin(element, link.where)

    def read_numbers(self, element: Element, name: str, where: str, default: tuple[float, ...]) -> Floats:
        """One factor stands for three, as in PyBullet."""
        single = name == "scale" and len(element.attributes.get(name, "").replace(",", " ").split()) == 1
        optional = default if name in ("scale", "normal") else None
        found = document.read_floats(element, name, 1 if single else len(default), where, optional)
        return np.broadcast_to(found, (len(default),))

    def read_color(self, visual: Element, where: str) -> Rgba | None:
        material = visual.first("material")
        color = material.first("color") if material else None
        return _read_rgba(color, where) if color else self.colors.get(link_reader.material_of(visual))


def _read_rgba(color: Element | None, where: str) -> Rgba | None:
    if color is None:
        return None
    try:
        red, green, blue, alpha = document.read_floats(color, "rgba", 4, where).tolist()
    except AssetError:
        return None
    return red, green, blue, alpha


def _collect_notes(robot: Element, links: UrdfLinks, found: list[tuple[str, Element]]) -> Iterator[str]:
    """Notes on links without a parent, xacro, and collision elements that engines pass over."""
    if len(links.roots) > 1:
        yield (
            f"{len(links.roots)} links have no parent joint ({join_names(links.roots)}): each is taken at the origin, "
            "as MuJoCo does; PyBullet cannot load such a file"
        )
    if xacro := [element.line for element in robot.walk() if element.tag.startswith("xacro:")]:
        yield f"{pluralize(len(xacro), 'xacro element')} not expanded, the first on line {xacro[0]}: passed over"
    for joint in robot.each("joint"):
        if (type_ := joint.attributes.get("type", "fixed")) not in document.JOINT_KINDS:
            yield f"joint {joint.attributes.get('name', '')!r} on line {joint.line} is {type_!r}: it is taken for fixed"
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
