"""Which prims of a stage collide: by the physics schemas, or all that is seen where a stage has no physics."""

from __future__ import annotations

from typing import Any

from meshforge.formats.usd.reading.stage import Scene

COLLISION, MESH_COLLISION = "PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"
RIGID_BODY, TRIGGER = "PhysicsRigidBodyAPI", "PhysxTriggerAPI"
DRAWN = "meshforgeDrawn"
"""The custom data of a collider that a conversion shows, since the asset shows nothing."""


def has_physics(scene: Scene) -> bool:
    """Whether any prim says that it collides or is a rigid body, switched off or not."""
    return any(applies(prim, COLLISION) or applies(prim, RIGID_BODY) for prim in scene.prims())


def applies(prim: Any, schema: str) -> bool:
    """Whether an applied schema is on a prim, of a library that is not installed too."""
    return schema in prim.GetPrimTypeInfo().GetAppliedAPISchemas()


def collides(scene: Scene, prim: Any) -> bool:
    """Whether a prim of a stage with physics collides: not switched off, and no trigger."""
    if not applies(prim, COLLISION) or applies(prim, TRIGGER):
        return False
    enabled = scene.get(prim.GetAttribute("physics:collisionEnabled"))
    return enabled is not False


def is_drawn(prim: Any) -> bool:
    """Whether a prim that renders is nothing but its own collision, drawn since nothing else was."""
    return bool(prim.GetCustomDataByKey(DRAWN))


def is_seen(scene: Scene, prim: Any) -> bool:
    """Whether a prim is geometry that renders: visible, and of the default or the render purpose."""
    from pxr import UsdGeom

    if not prim.IsA(UsdGeom.Gprim) or is_drawn(prim):
        return False
    image = UsdGeom.Imageable(prim)
    return image.ComputePurpose() in ("default", "render") and image.ComputeVisibility(scene.time) != "invisible"


def body_of(scene: Scene, prim: Any) -> Any:
    """The nearest rigid body at or above a prim, None where there is none that is switched on."""
    while prim and not prim.IsPseudoRoot():
        if applies(prim, RIGID_BODY):
            return prim if scene.get(prim.GetAttribute("physics:rigidBodyEnabled")) is not False else None
        prim = prim.GetParent()
    return None


def instances_around(prim: Any) -> Any:
    """The instances that a prim is in, the outermost first, none where it is in none."""
    found = []
    prim = prim.GetParent()
    while prim and not prim.IsPseudoRoot():
        if prim.IsInstance():
            found.append(prim)
        prim = prim.GetParent()
    return found[::-1]
