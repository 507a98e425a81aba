"""What a made hull takes over from the prim that it stems from: all of its contact settings, none of its geometry."""

from __future__ import annotations

from typing import Any

from meshforge.formats.usd.writing.specs import apply_schemas

_OURS = ("physics:", "physx", "newton:", "mjc:", "material:binding:physics")
_NOT = (
    *("physics:mass", "physics:centerOfMass", "physics:diagonalInertia", "physics:principalAxes"),
    *("physics:velocity", "physics:angularVelocity", "physics:rigidBodyEnabled", "physics:kinematicEnabled"),
    *("physics:startsAsleep", "physics:approximation", "physics:filteredPairs", "physxRigidBody", "physxArticulation"),
    *("physxConvexDecomposition", "physxSDFMesh", "physxSphereFill", "physxTriangleMesh", "physxMeshMerge"),
)
_SCHEMAS = ("PhysxCollisionAPI", "PhysxConvexHullCollisionAPI", "NewtonCollisionAPI", "MjcCollisionAPI")
_MATERIAL = "material:binding"


def inherit(spec: Any, prim: Any) -> None:
    """Author on a new prim what another one says of its contacts."""
    names = [p for p in prim.GetAuthoredPropertyNames() if p.startswith(_OURS) and not p.startswith(_NOT)]
    if _binds_physics(prim):
        names.append(_MATERIAL)
    schemas = [name for name in prim.GetPrimTypeInfo().GetAppliedAPISchemas() if name in _SCHEMAS]
    if "physics:density" in names:
        schemas.append("PhysicsMassAPI")
    if any(name.startswith(_MATERIAL) for name in names):
        schemas.append("MaterialBindingAPI")
    for name in names:
        _copy(spec, prim.GetProperty(name))
    apply_schemas(spec, schemas)


def _binds_physics(prim: Any) -> bool:
    """Whether the plain material binding of a prim leads to a material with physics."""
    targets = prim.GetRelationship(_MATERIAL).GetTargets() if prim.HasRelationship(_MATERIAL) else []
    materials = [prim.GetStage().GetPrimAtPath(path) for path in targets]
    return any(m and "PhysicsMaterialAPI" in m.GetPrimTypeInfo().GetAppliedAPISchemas() for m in materials)


def _copy(spec: Any, source: Any) -> None:
    from pxr import Sdf, Usd

    if isinstance(source, Usd.Relationship):
        made = Sdf.RelationshipSpec(spec, source.GetName(), source.IsCustom())
        made.targetPathList.explicitItems = source.GetTargets()
    elif source.Get() is not None:
        kind = source.GetTypeName()
        made = Sdf.AttributeSpec(spec, source.GetName(), kind, source.GetVariability(), source.IsCustom())
        made.default = source.Get()
