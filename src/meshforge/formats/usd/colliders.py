"""Which prims of a stage collide, the bodies they are part of, and the contact settings that a new prim inherits."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from meshforge.formats.collision_pieces import CollisionPiece
from meshforge.formats.libraries import pxr
from meshforge.formats.usd.stage import BODY, UsdStage
from meshforge.geometry import Pose
from meshforge.symbolic import Body, unique_names

COLLISION, MESH_COLLISION = "PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"
RIGID_BODY, TRIGGER = "PhysicsRigidBodyAPI", "PhysxTriggerAPI"
DRAWN = "meshforgeDrawn"
"""The custom data of a collider that a conversion shows, since the asset shows nothing."""
LABELS_SCHEMA, LABELS = "SemanticsLabelsAPI:", "semantics:labels:"
"""How USD says what a prim is, in a taxonomy: the schema, and the attribute, before its name."""
HULL_NAME = "meshforgeName"
"""The custom data of a collider: the name of its hull, where the prim has another one."""
FILTERED = "physics:filteredPairs"
"""The relationship of a body with those that it does not collide with."""

_CONTACT_PREFIXES = ("physxcollision", "physxconvexhull", "newton", "mjc")
_PHYSICS_MATERIAL = "material:binding:physics"

_INHERITED = ("physics:", "physx", "newton:", "mjc:", "material:binding:physics")
_NOT_INHERITED = (
    *("physics:mass", "physics:centerOfMass", "physics:diagonalInertia", "physics:principalAxes"),
    *("physics:velocity", "physics:angularVelocity", "physics:rigidBodyEnabled", "physics:kinematicEnabled"),
    *("physics:startsAsleep", "physics:approximation", FILTERED, "physxRigidBody", "physxArticulation"),
    *("physxConvexDecomposition", "physxSDFMesh", "physxSphereFill", "physxTriangleMesh", "physxMeshMerge"),
)
_INHERITED_SCHEMAS = ("PhysxCollisionAPI", "PhysxConvexHullCollisionAPI", "NewtonCollisionAPI", "MjcCollisionAPI")
_MATERIAL_BINDING = "material:binding"


@dataclass(frozen=True, eq=False, slots=True)
class PrimCollision:
    """A prim with collision: its pieces in the root frame."""

    prim: Any
    body: str
    parts: Sequence[CollisionPiece]

    @property
    def path(self) -> str:
        return str(self.prim.GetPath())


def has_schema(prim: Any, schema: str) -> bool:
    """Return whether an applied schema is on a prim, of a library that is not installed too."""
    return schema in prim.GetPrimTypeInfo().GetAppliedAPISchemas()


def is_collider(scene: UsdStage, prim: Any) -> bool:
    """Return whether a prim of a stage with physics collides: not switched off, and no trigger."""
    if not has_schema(prim, COLLISION) or has_schema(prim, TRIGGER):
        return False
    return scene.get(prim.GetAttribute("physics:collisionEnabled")) is not False


def is_drawn(prim: Any) -> bool:
    """Return whether a prim that renders is nothing but its own collision, drawn since nothing else was."""
    return bool(prim.GetCustomDataByKey(DRAWN))


def is_seen(scene: UsdStage, prim: Any) -> bool:
    """Return whether a prim is geometry that renders: visible, and of the default or the render purpose."""
    if not prim.IsA(pxr.UsdGeom.Gprim) or is_drawn(prim):
        return False
    image = pxr.UsdGeom.Imageable(prim)
    return image.ComputePurpose() in ("default", "render") and image.ComputeVisibility(scene.time) != "invisible"


def body_of(scene: UsdStage, prim: Any) -> Any:
    """Return the nearest rigid body at or above a prim, None where there is none that is switched on."""
    while prim and not prim.IsPseudoRoot():
        if has_schema(prim, RIGID_BODY):
            return prim if scene.get(prim.GetAttribute("physics:rigidBodyEnabled")) is not False else None
        prim = prim.GetParent()
    return None


class StageBodies:
    """The rigid bodies of a stage by path, in its order; used: whether the body of all else is needed."""

    def __init__(self, scene: UsdStage, physics: bool) -> None:
        self.scene = scene
        found = [prim for prim in scene.prims() if physics and prim == body_of(scene, prim)]
        self.prims: dict[str, Any] = {str(prim.GetPath()): prim for prim in found}
        names = unique_names([BODY, *(scene.shorten_path(path) for path in self.prims)])[1:]
        self.names = dict(zip(self.prims, names, strict=True))
        self.used = not self.prims

    def of(self, prim: Any) -> str:
        """Return the name of the body that a prim is part of."""
        name = self.of_joint(prim)
        self.used |= name == BODY
        return name

    def of_joint(self, prim: Any) -> str:
        """Return the name of the body that a joint holds by a prim; it does not count as used: it may show nothing."""
        own = body_of(self.scene, prim)
        return self.names.get(str(own.GetPath()), BODY) if own else BODY

    def list_bodies(self) -> tuple[Body, ...]:
        """Return the body of the root frame where something is part of it, then the rigid ones."""
        fixed = [Body(BODY, Pose.identity())] if self.used else []
        return (*fixed, *(Body(self.names[path], self.scene.pose(prim)) for path, prim in self.prims.items()))

    def hull_name(self, path: str, body: str) -> str:
        """Return the name of what a prim collides with, after the body's name where there are any bodies.

        It is the one that the prim says in its custom data, else its path below the body.
        """
        of_body = next((own for own, name in self.names.items() if name == body), "")
        prim = self.scene.stage.GetPrimAtPath(path)
        authored = prim.GetCustomDataByKey(HULL_NAME) if prim else None
        own = authored if isinstance(authored, str) and authored else self.scene.shorten_path(path, of_body)
        return f"{body}/{own}" if self.names else own


def contact_attributes(prim: Any) -> tuple[tuple[str, str], ...]:
    """Return names and values of what is authored on a prim, its physics material by path, in order of name."""
    values = {attribute.GetName(): attribute.Get() for attribute in prim.GetAuthoredAttributes()}
    if material := physics_material(prim):
        values[_PHYSICS_MATERIAL] = material.GetPath()
    wanted = (*_CONTACT_PREFIXES, _PHYSICS_MATERIAL)
    found = {name: str(v) for name, v in values.items() if name.lower().startswith(wanted) and v is not None}
    return tuple(sorted(found.items()))


def physics_material(prim: Any) -> Any:
    """Return the material that a prim is bound to for physics, itself or from above; None where it is bound to none."""
    material, relationship = pxr.UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")
    return material.GetPrim() if material and relationship else None


def inherit_contact(spec: Any, prim: Any) -> None:
    """Author on a new prim what another one says of its contacts."""
    names = [
        p for p in prim.GetAuthoredPropertyNames() if p.startswith(_INHERITED) and not p.startswith(_NOT_INHERITED)
    ]
    if _has_physics_material(prim):
        names.append(_MATERIAL_BINDING)
    schemas = [name for name in prim.GetPrimTypeInfo().GetAppliedAPISchemas() if name in _INHERITED_SCHEMAS]
    if "physics:density" in names:
        schemas.append("PhysicsMassAPI")
    if any(name.startswith(_MATERIAL_BINDING) for name in names):
        schemas.append("MaterialBindingAPI")
    for name in names:
        _copy_property(spec, prim.GetProperty(name))
    apply_schemas(spec, schemas)


def _has_physics_material(prim: Any) -> bool:
    targets = prim.GetRelationship(_MATERIAL_BINDING).GetTargets() if prim.HasRelationship(_MATERIAL_BINDING) else []
    materials = [prim.GetStage().GetPrimAtPath(path) for path in targets]
    return any(material and has_schema(material, "PhysicsMaterialAPI") for material in materials)


def _copy_property(spec: Any, source: Any) -> None:
    if isinstance(source, pxr.Usd.Relationship):
        made = pxr.Sdf.RelationshipSpec(spec, source.GetName(), source.IsCustom())
        made.targetPathList.explicitItems = source.GetTargets()
    elif source.Get() is not None:
        kind = source.GetTypeName()
        made = pxr.Sdf.AttributeSpec(spec, source.GetName(), kind, source.GetVariability(), source.IsCustom())
        made.default = source.Get()


def apply_schemas(spec: Any, names: Iterable[str]) -> None:
    """Put applied schemas before those that a spec prepends already."""
    old = spec.GetInfo("apiSchemas") if spec.HasInfo("apiSchemas") else pxr.Sdf.TokenListOp()
    wanted = [name for name in dict.fromkeys(names) if name not in old.GetAddedOrExplicitItems()]
    if old.isExplicit:
        old.explicitItems = [*old.explicitItems, *wanted]
    else:
        old.prependedItems = [*old.prependedItems, *wanted]
        old.deletedItems = [item for item in old.deletedItems if item not in wanted]
    if wanted:
        spec.SetInfo("apiSchemas", old)
