"""Point instancers: what they collide with many times over is one opaque piece."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshforge.formats.mesh_parts import MeshPart, placed
from meshforge.formats.meshfile import RawSurface, joined
from meshforge.formats.usd.reading.colliders import COLLISION, applies
from meshforge.formats.usd.reading.shapes import parts_of
from meshforge.formats.usd.reading.stage import Scene

_MOST = 2_000_000  # triangles of all instances together; beyond, they are told and not shown
_REASON = "many at once by a point instancer, which is not edited"


def instanced_part(scene: Scene, instancer: Any, physics: bool, notes: list[str]) -> MeshPart | None:
    """All instances of the prototypes that collide; None where none does."""
    from pxr import Usd, UsdGeom

    kinds = UsdGeom.PointInstancer(instancer)
    roots = [scene.stage.GetPrimAtPath(path) for path in kinds.GetPrototypesRel().GetForwardedTargets()]
    predicate = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)
    shapes = [_surface(scene, root, Usd.PrimRange(root, predicate) if root else (), physics, notes) for root in roots]
    if all(shape is None for shape in shapes):
        return None
    at = np.asarray(kinds.ComputeInstanceTransformsAtTime(scene.time, scene.time), dtype=np.float64).reshape(-1, 4, 4)
    which = np.asarray(scene.get(kinds.GetProtoIndicesAttr()) or [], dtype=np.int64)
    shown = [(shapes[k], matrix) for k, matrix in zip(which, at, strict=False) if 0 <= k < len(shapes)]
    there = [(shape, matrix) for shape, matrix in shown if shape is not None]
    if not there or sum(len(shape.faces) for shape, _ in there) > _MOST:
        return MeshPart(None, _REASON)
    many = [RawSurface(None, s.vertices @ m[:3, :3] + m[3, :3], s.faces) for s, m in there]
    whole = joined(many)
    if not np.isfinite(whole.vertices).all():
        return MeshPart(None, _REASON)
    return MeshPart(None, _REASON, placed(whole.vertices, whole.faces, *scene.placement(instancer)))


def _surface(scene: Scene, root: Any, below: Any, physics: bool, notes: list[str]) -> RawSurface | None:
    """What collides of a prototype, where the instancer puts it, in units of the stage."""
    from pxr import UsdGeom

    if not root:
        return None
    linear, offset = scene.placement(root)
    own = np.array(UsdGeom.Xformable(root).GetLocalTransformation(scene.time), dtype=np.float64)
    inverse = np.linalg.pinv(linear)
    surfaces = []
    for prim in below:
        if prim.IsA(UsdGeom.Gprim) and (applies(prim, COLLISION) or not physics):
            for part in parts_of(scene, prim, notes):
                if shape := part.shape or part.surface:
                    local = (np.asarray(shape.vertices) - offset) @ inverse.T
                    surfaces.append(RawSurface(None, local @ own[:3, :3] + own[3, :3], shape.faces))
    if not surfaces:
        return None
    whole = joined(surfaces)
    return RawSurface(None, whole.vertices, whole.faces)
