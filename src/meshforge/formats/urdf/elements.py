"""XML text of collision elements: new ones, and copies of authored ones with another geometry."""

from __future__ import annotations

from typing import assert_never

from meshforge.formats.urdf.shapes import geometry_of
from meshforge.formats.xml import Element, Splice, attribute, escaped, indent, newline, shown
from meshforge.geometry import Box, Cylinder, Pose, Sphere

Native = Box | Cylinder | Sphere
"""The shapes that every reader of URDF knows."""


def native_tag(shape: Native) -> bytes:
    """The element of a native shape, without its pose."""
    match shape:
        case Box():
            return b'<box size="%s"/>' % _number(*2 * shape.half)
        case Cylinder():
            return b'<cylinder radius="%s" length="%s"/>' % (_number(shape.radius), _number(2 * shape.half_length))
        case Sphere():
            return b'<sphere radius="%s"/>' % _number(shape.radius)
        case _:
            assert_never(shape)


def mesh_tag(reference: str) -> bytes:
    """The element of a mesh file in metres."""
    return b'<mesh filename="%s"/>' % escaped(reference)


def origin_tag(pose: Pose) -> bytes:
    """The element of a pose, its numbers in full precision."""
    return b'<origin xyz="%s" rpy="%s"/>' % (_number(*pose.translation), _number(*pose.to_rpy()))


def fresh(pose: Pose, tag: bytes, lead: bytes, line_end: bytes) -> bytes:
    """A `<collision>` without a name, whose lines but the first are indented by `lead`."""
    lines = [
        b"<collision>",
        b"  " + origin_tag(pose),
        b"  <geometry>",
        b"    " + tag,
        b"  </geometry>",
        b"</collision>",
    ]
    return (line_end + lead).join(lines)


def reshaped(data: bytes, collision: Element, pose: Pose, tag: bytes) -> tuple[Splice, ...]:
    """The edits that give a copy of a collision element another pose and geometry, all else of it being inherited."""
    kind = geometry_of(collision)
    assert kind is not None  # only elements with pieces are copied
    return _moved(data, collision, pose), Splice(kind.start, kind.end, tag)


def remeshed(data: bytes, collision: Element, pose: Pose, reference: str) -> tuple[Splice, ...]:
    """The same for a hull in a mesh file in metres: where the element has a mesh, its other attributes stay."""
    kind = geometry_of(collision)
    if kind is None or kind.tag != "mesh":
        return reshaped(data, collision, pose, mesh_tag(reference))
    scale = [attribute(data, kind, "scale", None)] if "scale" in kind.attributes else []
    return (_moved(data, collision, pose), attribute(data, kind, "filename", reference), *scale)


def refiled(data: bytes, collision: Element, reference: str) -> tuple[Splice, ...]:
    """The edits that give a copy of a mesh collision another mesh file, of the same unit, scale and place."""
    kind = geometry_of(collision)
    assert kind is not None  # only meshes have pieces to be parted
    return (attribute(data, kind, "filename", reference),)


def _moved(data: bytes, collision: Element, pose: Pose) -> Splice:
    """The edit that gives an element another origin."""
    origin, geometry = collision.first("origin"), collision.first("geometry")
    if origin is not None:
        return Splice(origin.start, origin.end, origin_tag(pose))
    assert geometry is not None
    lead = indent(data, geometry.start)
    gap = newline(data) + lead if lead is not None else b""
    return Splice(geometry.start, geometry.start, origin_tag(pose) + gap)


def _number(*values: float) -> bytes:
    return shown(values).encode()
