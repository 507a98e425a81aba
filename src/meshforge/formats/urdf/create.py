"""Making a URDF from an asset of another format: a link for each body, an element for each hull."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from meshforge.asset import Asset, Body, Opaque
from meshforge.formats.base import Output
from meshforge.formats.hull_files import HullFiles
from meshforge.formats.mesh_parts import is_flat
from meshforge.formats.slots import Slot
from meshforge.formats.urdf.elements import fresh, mesh_tag, origin_tag
from meshforge.formats.urdf.made import Maker
from meshforge.formats.urdf.slots import settle
from meshforge.formats.xml import escaped
from meshforge.geometry import Pose

_LEAD = b"    "
_UNKNOWN = (
    "masses, joints and visuals are not carried over: links are joined rigidly; without masses PyBullet takes 1 kg a "
    "link and MuJoCo fixes the root to the world"
)


def create_urdf(asset: Asset, name: str) -> Output:
    """The files of an asset that came from another format.

    Bodies become links at their poses, hulls native shapes or mesh files. Opaque pieces with a surface become meshes
    as they are; what is left out is noted.
    """
    stem = Path(name).stem
    maker = Maker(b"", b"\n", HullFiles(stem))
    slots: dict[str, list[Slot]] = {body.name: [] for body in asset.bodies}
    for geom in asset.geoms:
        slots[geom.body].append(maker.slot(geom, asset.body_poses[geom.body], None, _LEAD))
    for opaque in asset.opaque:
        slots[opaque.body] += _opaque(opaque, asset.body_poses[opaque.body], maker)
    names = settle([slot for own in slots.values() for slot in own])
    root, joints = _joints(asset.bodies)
    links = [_link(link, slots.get(link, [])) for link in (slots if root in slots else [root, *slots])]
    head = [b'<?xml version="1.0"?>', b'<robot name="%s">' % escaped(stem)]
    main = b"\n".join([*head, *links, *joints, b"</robot>", b""])
    return Output(main, dict(maker.files.made), notes=(*maker.notes, _UNKNOWN), names=names)


def _opaque(opaque: Opaque, root_t_link: Pose, maker: Maker) -> list[Slot]:
    """The element of an opaque piece; none, with a note, where it has no surface, or a flat one that engines refuse."""
    surface = opaque.surface
    if surface is None or not len(surface.faces) or is_flat(surface.vertices):
        maker.notes.append(f"opaque {opaque.name!r} is left out: {opaque.reason}")
        return []
    vertices = root_t_link.inverse().apply(np.asarray(surface.vertices))
    tag = mesh_tag(maker.files.add(opaque.name, "", vertices, surface.faces))
    maker.notes.append(f"opaque {opaque.name!r} is written as a mesh, of which engines take the convex hull")
    return [Slot(opaque.body, (opaque.name,), text=fresh(Pose.identity(), tag, _LEAD, b"\n"))]


def _joints(bodies: Sequence[Body]) -> tuple[str, list[bytes]]:
    """The name of the root link, and fixed joints from it to all others.

    The root is the first body that is in the root frame, else a link of its own.
    """
    identity = [b.name for b in bodies if _is_identity(b.pose)]
    root = identity[0] if identity else _free_name({b.name for b in bodies})
    return root, [_joint(root, body) for body in bodies if body.name != root]


def _is_identity(pose: Pose) -> bool:
    return np.array_equal(pose.rotation, np.eye(3)) and not pose.translation.any()


def _free_name(taken: set[str]) -> str:
    name, number = "base", 2
    while name in taken:
        name, number = f"base_{number}", number + 1
    return name


def _joint(root: str, body: Body) -> bytes:
    name = escaped(body.name)
    lines = [
        b'  <joint name="%s_fixed" type="fixed">' % name,
        b"    " + origin_tag(body.pose),
        b'    <parent link="%s"/>' % escaped(root),
        b'    <child link="%s"/>' % name,
        b"  </joint>",
    ]
    return b"\n".join(lines)


def _link(name: str, slots: Sequence[Slot]) -> bytes:
    if not slots:
        return b'  <link name="%s"/>' % escaped(name)
    inside = [_LEAD + slot.written(b"") for slot in slots]
    return b"\n".join([b'  <link name="%s">' % escaped(name), *inside, b"  </link>"])
