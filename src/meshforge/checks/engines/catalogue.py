"""The engines, row by row; `docs/engines.md` shows this table, and a test holds the two together."""

from __future__ import annotations

from collections.abc import Callable
from types import MappingProxyType

from meshforge.checks.engines import measures
from meshforge.checks.engines.limit import Bound, Engine, Limit
from meshforge.checks.finding import Severity
from meshforge.geometry import Polytope

_SIMPLER = "Reduce it (check --fix), replace it by a primitive, or split it."
_THICKER = "Give it a thickness, replace it by a box, or merge it with a neighbour."
_SHORTER = "Split it along its length."
_KINDS: dict[str, tuple[Callable[[Polytope], float], str, Bound, str]] = {
    "vertices": (measures.vertices, "vertices", "most", _SIMPLER),
    "polygons": (measures.polygons, "flat faces", "most", _SIMPLER),
    "face-vertices": (measures.largest_polygon, "vertices on one flat face", "most", _SIMPLER),
    "vertex-faces": (measures.polygons_at_a_vertex, "flat faces at one vertex", "most", _SIMPLER),
    "oblong": (measures.slenderness, "times as long as the sphere inside has radius", "most", _SHORTER),
    "thin": (measures.thickness, "m thick", "least", _THICKER),
    "volume": (measures.volume, "m³", "least", _THICKER),
}


def _limit(rule: str, number: float, severity: Severity, problem: str, source: str) -> Limit:
    measure, what, bound, remedy = _KINDS[rule]
    return Limit(rule, measure, number, what, severity, problem, remedy, source, bound)


_COOKED = "PhysX leaves part of the hull out"
_NO_GPU = "contacts with it fall back to the CPU, or it is refused"
_DESC = "PhysX 5.6, PxConvexMeshDesc: "
_RESULT = "PhysX 5.6, PxConvexMeshCookingResult: "
_SHAPES = "PhysX 5.6, PxGeometryType: sphere, capsule, box, convex mesh"
_PHYSX = frozenset({"box", "sphere", "capsule"})
_ALL = frozenset({"box", "sphere", "capsule", "cylinder", "ellipsoid"})

_ENGINES = (
    Engine(
        "mujoco",
        "MuJoCo",
        (
            _limit(
                "face-vertices",
                20,
                "warning",
                "MJX leaves some of them out",
                "mujoco/mjx/_src/mesh.py: _MAX_HULL_FACE_VERTICES; MuJoCo itself has no limit",
            ),
            _limit(
                "volume",
                2e-15,
                "error",
                "MuJoCo refuses the mesh",
                "MuJoCo 4.0, `mesh volume is too small` below mjMINVAL, 1e-15; with margin for rounding",
            ),
        ),
        _ALL,
        "",
        "MuJoCo, XML reference, body/geom/type",
    ),
    Engine(
        "physx-cpu",
        "PhysX on the CPU",
        (
            _limit("vertices", 255, "error", _COOKED, _DESC + "vertexLimit, hard maximum 255"),
            _limit("polygons", 255, "error", _COOKED, _RESULT + "ePOLYGONS_LIMIT_REACHED, 255 polygons"),
            _limit(
                "thin",
                0.001,
                "warning",
                "Omniverse thickens it",
                "Omniverse, PhysxConvexHullCollisionAPI: minThickness, default 0.001; PhysX itself has no limit",
            ),
        ),
        _PHYSX,
        "PhysX has no such shape, a convex mesh stands for it",
        _SHAPES,
    ),
    Engine(
        "physx-gpu",
        "PhysX on the GPU (Isaac, SAPIEN)",
        (
            _limit("vertices", 64, "error", _NO_GPU, _DESC + "64 vertices in a GPU compatible convex mesh"),
            _limit("polygons", 64, "error", _NO_GPU, _DESC + "64 convex polygons in a GPU compatible convex mesh"),
            _limit("face-vertices", 32, "error", _NO_GPU, "PhysX 5.6, PxConvexMesh::isGpuCompatible: 32 in a polygon"),
            _limit("vertex-faces", 32, "error", _NO_GPU, _DESC + "32 faces per vertex"),
            _limit(
                "oblong",
                100,
                "warning",
                _NO_GPU,
                _RESULT + "eNON_GPU_COMPATIBLE, in-sphere radius 100 times below the largest extent",
            ),
            _limit(
                "thin",
                0.001,
                "warning",
                "Isaac thickens it",
                "Omniverse, PhysxConvexHullCollisionAPI: minThickness, default 0.001",
            ),
        ),
        _PHYSX,
        "PhysX has no such shape, a convex mesh stands for it",
        _SHAPES,
        64,
        "contacts of so many hulls overflow the buffers that simulators reserve",
        "no hard limit; practice in Isaac and SAPIEN",
    ),
    Engine(
        "unreal",
        "Unreal",
        (
            _limit(
                "vertices",
                32,
                "warning",
                "more than is practical in Unreal",
                "no hard limit; Max Hull Verts of the static mesh editor goes from 6 to 32",
            ),
        ),
        _PHYSX,
        "Unreal has no such shape, a convex hull stands for it",
        "Unreal, FBX static mesh pipeline: UBX, USP, UCP, UCX",
    ),
    Engine(
        "unity",
        "Unity",
        (
            _limit(
                "vertices", 255, "error", "Unity makes a partial hull of it", _DESC + "vertexLimit, hard maximum 255"
            ),
            _limit(
                "polygons",
                255,
                "error",
                "Unity makes a partial hull of it",
                "Unity, manual, Mesh Collider: convex ones are limited to 255",
            ),
        ),
        _PHYSX,
        "Unity has no such collider, a convex Mesh Collider stands for it",
        "Unity, manual: Box, Sphere, Capsule and Mesh Collider",
    ),
    Engine(
        "bullet",
        "Bullet",
        (
            _limit(
                "vertices",
                100,
                "warning",
                "more than is practical in Bullet",
                "no hard limit; Bullet user manual, advice",
            ),
            _limit(
                "thin",
                0.002,
                "warning",
                "its margin makes it twice as thick",
                "bullet3, URDF importer: gUrdfDefaultCollisionMargin, 0.001 on each side",
            ),
        ),
        _ALL - {"ellipsoid"},
        "Bullet's importers have no such shape, a convex hull stands for it",
        "bullet3, UrdfGeometry: sphere, box, cylinder, capsule, mesh",
    ),
    Engine(
        "godot",
        "Godot with Jolt",
        (
            _limit(
                "vertices",
                256,
                "error",
                "Jolt leaves part of the hull out",
                "Jolt, ConvexHullShape: cMaxPointsInHull, and ConvexHullBuilder: EResult::MaxVerticesReached",
            ),
            _limit(
                "thin",
                0.002,
                "warning",
                "Jolt leaves out what rises less than 1 mm above the rest",
                "Jolt, ConvexHullShapeSettings: mHullTolerance, 0.001 on each side",
            ),
        ),
        _ALL - {"ellipsoid"},
        "Godot has no such shape, a ConvexPolygonShape3D stands for it",
        "Godot 4, Shape3D: Box-, Sphere-, Capsule-, Cylinder- and ConvexPolygonShape3D",
    ),
)
ENGINES = MappingProxyType({engine.name: engine for engine in _ENGINES})
"""The engines whose limits are known, by the name that the command line takes."""
