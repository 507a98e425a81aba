"""Stages for tests: each a few files of text, made for one thing that USD can do."""

from __future__ import annotations

from pathlib import Path
from typing import Any

CUBE = """
            point3f[] points = [(-1,-1,-1),(1,-1,-1),(1,1,-1),(-1,1,-1),(-1,-1,1),(1,-1,1),(1,1,1),(-1,1,1)]
            int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
            int[] faceVertexIndices = [0,3,2,1, 4,5,6,7, 0,1,5,4, 1,2,6,5, 2,3,7,6, 3,0,4,7]
"""
"""The attributes of a Mesh that is a cube from -1 to 1."""

HEAD = """#usda 1.0
(
    defaultPrim = "{default}"
    metersPerUnit = {metres}
    upAxis = "{up}"
)
"""


def stage(body: str, *, default: str = "World", metres: float = 1.0, up: str = "Z") -> str:
    """The text of a stage around its prims."""
    return HEAD.format(default=default, metres=metres, up=up) + body


def written(folder: Path, text: str, name: str = "a.usda") -> Path:
    """A file of a text."""
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def mesh(name: str, *, api: str = "", more: str = "", points: str = CUBE) -> str:
    """A Mesh prim; api: applied schemas, quoted; more: further attributes."""
    applied = f"(\n prepend apiSchemas = [{api}]\n)" if api else ""
    return f'def Mesh "{name}" {applied}\n{{\n{points}\n{more}\n}}\n'


COLLIDES = '"PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"'
CONVEX = 'uniform token physics:approximation = "convexHull"'

CUP = stage(
    f"""
# the cup of the house
def Xform "World"
{{
    def Xform "Cup" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI"]
        doc = "drinks go here"
    )
    {{
        # stands a little above the floor
        double3 xformOp:translate = (0, 0, 10)
        uniform token[] xformOpOrder = ["xformOp:translate"]

        def Xform "collisions"
        {{
            def Cube "side" ( prepend apiSchemas = ["PhysicsCollisionAPI", "PhysxCollisionAPI"] )
            {{
                double size = 2  # in centimetres
                uniform token purpose = "guide"
                float physxCollision:contactOffset = 0.02
                custom string mine = "kept"
                rel material:binding:physics = </World/Rubber>
                double3 xformOp:scale = (1, 2, 3)
                uniform token[] xformOpOrder = ["xformOp:scale"]
            }}
            def Capsule "handle" ( prepend apiSchemas = ["PhysicsCollisionAPI"] )
            {{
                uniform token purpose = "guide"
                double radius = 0.5
                double height = 3
                uniform token axis = "X"
                double3 xformOp:translate = (3, 0, 0)
                uniform token[] xformOpOrder = ["xformOp:translate"]
            }}
            {mesh("bottom", api=COLLIDES, more=CONVEX + chr(10) + 'uniform token purpose = "guide"')}
        }}
        {mesh("visual", more="color3f[] primvars:displayColor = [(1, 0, 0)]")}
        {
        mesh(
            "both",
            api=COLLIDES,
            more=CONVEX
            + chr(10)
            + "double3 xformOp:translate = (9, 0, 0)"
            + chr(10)
            + 'uniform token[] xformOpOrder = ["xformOp:translate"]',
        )
    }
    }}
    def Material "Rubber" ( prepend apiSchemas = ["PhysicsMaterialAPI"] )
    {{
        float physics:dynamicFriction = 0.9
        float physics:density = 0.002
    }}
    def PhysicsCollisionGroup "Group" ( prepend apiSchemas = ["CollectionAPI:colliders"] )
    {{
        rel collection:colliders:includes = </World/Cup/collisions/side>
    }}
}}
""",
    metres=0.01,
)
"""A rigid body in centimetres: native and mesh colliders that are hidden, one that is seen, and a group."""

LEG = stage(
    f"""
def Xform "Leg"
{{
    {mesh("visual")}
    def Xform "collisions"
    {{
        {mesh("upper", api=COLLIDES, more=CONVEX + chr(10) + 'uniform token purpose = "guide"')}
        def Sphere "foot" ( prepend apiSchemas = ["PhysicsCollisionAPI"] )
        {{
            double radius = 0.5
            uniform token purpose = "guide"
            double3 xformOp:translate = (0, 0, -2)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }}
    }}
}}
""",
    default="Leg",
)


def table(folder: Path, *, instanceable: bool = False, arc: str = "references") -> Path:
    """A table of two legs out of another layer, one mirrored."""
    written(folder, LEG, "parts/leg.usda")
    shared = "\n instanceable = true" if instanceable else ""
    legs = "".join(
        f"""
    def Xform "leg{k}" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI"]
        prepend {arc} = @./parts/leg.usda@{shared}
    )
    {{
        double3 xformOp:translate = ({5 * k}, 0, 0)
        float3 xformOp:scale = ({1 - 2 * k}, 1, 2)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
    }}
"""
        for k in range(2)
    )
    return written(folder, stage(f'def Xform "World"\n{{{legs}\n}}\n'), "table.usda")


def layer(path: Path) -> Any:
    """The layer of a file, fresh."""
    from pxr import Sdf

    return Sdf.Layer.OpenAsAnonymous(str(path))


def specs(path: Path) -> dict[str, Any]:
    """All that the root layer of a file says: of each spec its fields as text, by its path."""
    found: dict[str, Any] = {}
    own = layer(path)

    def take(at: Any) -> None:
        spec = own.GetObjectAtPath(at)
        if spec:
            children = ("primChildren", "properties", "variantChildren", "variantSetChildren", "primOrder")
            found[str(at)] = {key: str(spec.GetInfo(key)) for key in spec.ListInfoKeys() if key not in children}

    own.Traverse("/", take)
    return found


def physics_shapes(path: Path) -> dict[str, Any]:
    """The collision shapes of a stage as USD's own reader hands them to engines, by path."""
    from pxr import Usd, UsdPhysics

    stage = Usd.Stage.Open(str(path))
    found = UsdPhysics.UsdPhysicsLoadStageFromPrimRange(stage, ["/"])
    return {
        str(prim): told
        for prims, each in found.values()
        for prim, told in zip(prims, each, strict=True)
        if hasattr(told, "localPos") and told.isValid
    }


def complaints(path: Path) -> list[str]:
    """What USD's own validators have against a file."""
    from pxr import Usd, UsdValidation

    context = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators())
    return [error.GetMessage() for error in context.Validate(Usd.Stage.Open(str(path)))]
