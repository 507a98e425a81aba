"""A `<geometry>` of a URDF as convex shapes and opaque pieces in the root frame."""

from __future__ import annotations

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.mesh_parts import MeshPart, facing
from meshforge.formats.urdf.numbers import floats
from meshforge.formats.xml import Element, shown
from meshforge.geometry import Box, Capsule, Cylinder, Floats, Pose, Shape, Sphere

_LEAST = 1e-12  # a factor that is taken for zero
KINDS = ("box", "sphere", "cylinder", "capsule", "plane", "mesh")
"""The elements of a `<geometry>` that engines know."""
_UP = (0.0, 0.0, 1.0)


def geometry_of(element: Element) -> Element | None:
    """What the `<geometry>` of a collision or visual holds, None where there is nothing."""
    geometry = element.first("geometry")
    if geometry is None or not geometry.children:
        return None
    return next((child for child in geometry.children if child.tag in KINDS), geometry.children[0])


def primitive(kind: Element, pose: Pose, where: str) -> MeshPart:
    """The shape of an element that is no mesh; pose: root_T_geometry.

    Raises AssetError with `where:line` for a missing or unreadable attribute.
    """
    match kind.tag:
        case "box":
            extent = floats(kind, "size", 3, where)
            shape: Shape = Box(pose, extent / 2)
        case "sphere":
            extent = floats(kind, "radius", 1, where)
            shape = Sphere(pose, float(extent[0]))
        case "cylinder" | "capsule":
            extent = np.concatenate([floats(kind, name, 1, where) for name in ("radius", "length")])
            make = Cylinder if kind.tag == "cylinder" else Capsule
            shape = make(pose, float(extent[0]), float(extent[1]) / 2)
        case "plane":
            return MeshPart(None, "a plane has no end", plane=pose @ facing(floats(kind, "normal", 3, where, _UP)))
        case _:
            return MeshPart(None, f"<{kind.tag}> is no geometry that is known")
    if extent.min() <= 0 or shape.volume == 0:
        return MeshPart(None, f"a {kind.tag} without volume: {shown(extent)} m")
    return MeshPart(shape)


def mesh_scale(mesh: Element, where: str, label: str) -> Floats:
    """The factors (3,) by which a `<mesh>` is scaled; one number stands for three, as in PyBullet.

    Raises AssetError naming `label`: a factor is zero.
    """
    single = len(mesh.attributes.get("scale", "").replace(",", " ").split()) == 1
    scale = floats(mesh, "scale", 1 if single else 3, where, (1.0, 1.0, 1.0))
    if np.abs(scale).min() < _LEAST:
        raise AssetError(
            f"collision {label!r} is scaled to nothing: scale={mesh.attributes['scale']!r}",
            where=f"{where}:{mesh.line}",
            remedy="Give every axis a factor that is not zero.",
        )
    return np.broadcast_to(scale, (3,))
