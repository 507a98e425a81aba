"""The `<geometry>` of collisions and visuals as convex shapes and non-convex pieces in the root frame."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshforge.common import AssetError
from meshforge.formats.collision_meshes import CollisionMeshes, MeshUse
from meshforge.formats.collision_pieces import CollisionPiece, place_pieces, turn_z_to
from meshforge.formats.urdf.document import geometry_of, read_floats, read_origin
from meshforge.formats.urdf.mechanism import UrdfLinks
from meshforge.formats.xml import Element, format_numbers
from meshforge.geometry import Box, Capsule, Cylinder, Floats, Pose, Shape, Sphere

_LEAST_SCALE = 1e-12  # a factor that is taken for zero
_UP = (0.0, 0.0, 1.0)


def read_primitive(kind: Element, pose: Pose, where: str) -> CollisionPiece:
    """The shape of an element that is no mesh; pose: root_T_geometry.

    Raises AssetError with `where:line` for a missing or unreadable attribute.
    """
    match kind.tag:
        case "box":
            extent = read_floats(kind, "size", 3, where)
            shape: Shape = Box(pose, extent / 2)
        case "sphere":
            extent = read_floats(kind, "radius", 1, where)
            shape = Sphere(pose, float(extent[0]))
        case "cylinder" | "capsule":
            extent = np.concatenate([read_floats(kind, name, 1, where) for name in ("radius", "length")])
            make = Cylinder if kind.tag == "cylinder" else Capsule
            shape = make(pose, float(extent[0]), float(extent[1]) / 2)
        case "plane":
            return CollisionPiece(
                None, "a plane has no end", plane=pose @ turn_z_to(read_floats(kind, "normal", 3, where, _UP))
            )
        case _:
            return CollisionPiece(None, f"<{kind.tag}> is no geometry that is known")
    if extent.min() <= 0 or shape.volume == 0:
        return CollisionPiece(None, f"a {kind.tag} without volume: {format_numbers(extent)} m")
    return CollisionPiece(shape)


def read_mesh_scale(mesh: Element, where: str, label: str) -> Floats:
    """The factors (3,) by which a `<mesh>` is scaled; one number stands for three, as in PyBullet.

    Raises AssetError naming `label`: a factor is zero.
    """
    single = len(mesh.attributes.get("scale", "").replace(",", " ").split()) == 1
    scale = read_floats(mesh, "scale", 1 if single else 3, where, (1.0, 1.0, 1.0))
    if np.abs(scale).min() < _LEAST_SCALE:
        raise AssetError(
            f"collision {label!r} is scaled to nothing: scale={mesh.attributes['scale']!r}",
            where=f"{where}:{mesh.line}",
            remedy="Give every axis a factor that is not zero.",
        )
    return np.broadcast_to(scale, (3,))


def read_parts(
    found: Sequence[tuple[str, Element]],
    uses: Sequence[MeshUse | None],
    links: UrdfLinks,
    meshes: CollisionMeshes,
    where: str,
) -> list[list[CollisionPiece]]:
    """The pieces of each collision element, in the root frame; none where it has no geometry."""
    parts: list[list[CollisionPiece]] = []
    for (link, collision), use in zip(found, uses, strict=True):
        kind = geometry_of(collision)
        pose = links.poses[link] @ read_origin(collision, where)
        if kind is None:
            parts.append([])
        elif use is not None:
            linear = pose.rotation * read_mesh_scale(kind, where, use.label)
            parts.append(place_pieces(meshes.pieces(use), linear, pose.translation))
        else:
            parts.append([read_primitive(kind, pose, where)])
    return parts
