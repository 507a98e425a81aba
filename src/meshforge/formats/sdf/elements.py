"""XML text of SDF elements: poses, shapes, collisions, and the edits that give a copy of one another geometry."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from meshforge.formats.sdf.files.elements import geometry_of
from meshforge.formats.xml import Element, Splice, escaped, indent, newline, removed, shown
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Floats, Pose, Sphere

Native = Box | Capsule | Cylinder | Ellipsoid | Sphere
"""The shapes that SDF has of its own and MeshForge knows, the round ones from 1.8 on."""
STEP = b"  "


def leaf(tag: str, text: str) -> bytes:
    """An element that holds a text."""
    return b"<%s>%s</%s>" % (tag.encode(), escaped(text), tag.encode())


def nested(tag: str, *inside: bytes) -> list[bytes]:
    """The lines of an element that holds others, each line of which is indented."""
    return [b"<%s>" % tag.encode(), *(STEP + line for line in inside), b"</%s>" % tag.encode()]


def pose_leaf(pose: Pose) -> bytes:
    """The element of a pose, its numbers in full precision."""
    return leaf("pose", shown([*pose.translation, *pose.to_rpy()]))


def native_lines(shape: Native) -> list[bytes]:
    """The lines of the element of a native shape, without its pose."""
    match shape:
        case Box():
            inside = [leaf("size", shown(2 * shape.half))]
        case Ellipsoid():
            inside = [leaf("radii", shown(shape.radii))]
        case Sphere():
            inside = [leaf("radius", shown([shape.radius]))]
        case Cylinder() | Capsule():
            inside = [leaf("radius", shown([shape.radius])), leaf("length", shown([2 * shape.half_length]))]
        case _:
            assert_never(shape)
    return nested(shape.kind, *inside)


def mesh_lines(reference: str, scale: Floats | None = None) -> list[bytes]:
    """The lines of the element of a mesh file in metres."""
    scaled = [] if scale is None else [leaf("scale", shown(scale))]
    return nested("mesh", leaf("uri", reference), *scaled)


def fresh(pose: Pose, kind: Sequence[bytes], lead: bytes, line_end: bytes) -> bytes:
    """A `<collision>` without a name, whose lines but the first are indented by `lead`."""
    return (line_end + lead).join(nested("collision", pose_leaf(pose), *nested("geometry", *kind)))


def reshaped(data: bytes, collision: Element, pose: Pose, kind: Sequence[bytes]) -> tuple[Splice, ...]:
    """The edits that give a copy of a collision another pose and geometry, all else of it being inherited."""
    geometry, old = collision.first("geometry"), geometry_of(collision)
    assert geometry is not None and old is not None  # only elements with pieces are copied
    lead = indent(data, old.start)
    gap = newline(data) + lead if lead is not None else b""
    others = (removed(data, child) for child in geometry.children if child.tag == "polyline" and child is not old)
    return (_moved(data, collision, geometry, pose), Splice(old.start, old.end, gap.join(kind)), *others)


def refiled(data: bytes, mesh: Element, reference: str) -> tuple[Splice, ...]:
    """The edits that give a copy of a mesh another file, of the same scale and place, which is used whole."""
    uri, submesh = mesh.first("uri") or mesh.first("filename"), mesh.first("submesh")
    assert uri is not None  # only meshes have pieces to be parted
    new = Splice(uri.start, uri.end, leaf(uri.tag, reference))
    return (new, removed(data, submesh)) if submesh else (new,)


def _moved(data: bytes, collision: Element, geometry: Element, pose: Pose) -> Splice:
    """The edit that gives a collision another pose in its link."""
    old = collision.first("pose")
    if old is not None:
        return Splice(old.start, old.end, pose_leaf(pose))
    lead = indent(data, geometry.start)
    gap = newline(data) + lead if lead is not None else b""
    return Splice(geometry.start, geometry.start, pose_leaf(pose) + gap)
